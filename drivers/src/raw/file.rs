//! Reads one file of a recording.

use std::collections::VecDeque;
use std::io::Read;
use std::path::{Path, PathBuf};

use memchr::memmem;

use super::block::{HEAD, Head, MARKER};
use super::fault::RawFault;
use super::header::{Beginning, FileHeader, MAGIC, PREFIX};
use super::record::Record;
use super::window::Window;

/// How far the search for the next block looks at a time, bytes.
const SEARCH: usize = 64 * 1024;

/// A good block.
#[derive(Debug)]
pub(crate) struct Block {
    /// Where it begins in the file.
    pub(crate) offset: u64,
    /// Records of the run before it.
    pub(crate) first: u64,
    /// What it holds.
    pub(crate) records: Vec<Record>,
}

/// What stands next in a file.
#[derive(Debug)]
enum Next {
    /// A good block, with its bytes in the file.
    Block(Block, usize),
    /// A head whose body is not all there.
    CutShort,
    /// Nothing good.
    Damage,
    /// Nothing at all.
    End,
}

/// Reads one file.
#[derive(Debug)]
pub(crate) struct FileReader {
    path: PathBuf,
    window: Window,
    header: Option<FileHeader>,
    waiting: VecDeque<Result<Block, RawFault>>,
}

impl FileReader {
    /// Reads the header. A damaged one is told by [`FileReader::next`].
    pub(crate) fn new(path: &Path, input: Box<dyn Read + Send>) -> Result<Self, RawFault> {
        let file = path.to_owned();
        let mut window = Window::new(input);
        let mut waiting = VecDeque::new();
        let length = FileHeader::length(window.see(PREFIX));
        let beginning = FileHeader::read(window.see(length));
        let is_empty = window.see(1).is_empty();
        if let Some(source) = window.take_fault() {
            return Err(RawFault::Unreadable { file, offset: 0, source });
        }
        let header = match beginning {
            _ if is_empty => return Err(RawFault::Empty { file }),
            Beginning::Foreign => return Err(RawFault::Foreign { file }),
            Beginning::Newer(version) => return Err(RawFault::Newer { file, version }),
            Beginning::Damaged => {
                window.advance(MAGIC.len());
                to_marker(&mut window);
                waiting.push_back(Err(RawFault::Header { file }));
                None
            }
            Beginning::Good(header, length) => {
                window.advance(length);
                Some(*header)
            }
        };
        Ok(FileReader { path: path.to_owned(), window, header, waiting })
    }

    /// The header, if it is good.
    pub(crate) fn header(&self) -> Option<&FileHeader> {
        self.header.as_ref()
    }

    /// Where it is.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// The next block or fault.
    pub(crate) fn next(&mut self) -> Option<Result<Block, RawFault>> {
        if let Some(waiting) = self.waiting.pop_front() {
            return Some(waiting);
        }
        let next = self.look();
        if let Some(source) = self.window.take_fault() {
            return Some(Err(self.unreadable(source)));
        }
        let offset = self.window.offset();
        let file = self.path.clone();
        match next {
            Next::End => None,
            Next::Block(block, length) => {
                self.window.advance(length);
                Some(Ok(block))
            }
            Next::CutShort | Next::Damage => {
                self.window.advance(1);
                let is_end = !to_marker(&mut self.window);
                if let Some(source) = self.window.take_fault() {
                    let fault = self.unreadable(source);
                    self.waiting.push_back(Err(fault));
                }
                let bytes = self.window.offset() - offset;
                Some(Err(match next {
                    Next::CutShort if is_end => RawFault::CutShort { file, offset, bytes },
                    _ => RawFault::Damaged { file, offset, bytes },
                }))
            }
        }
    }

    fn unreadable(&self, source: std::io::Error) -> RawFault {
        RawFault::Unreadable { file: self.path.clone(), offset: self.window.offset(), source }
    }

    fn look(&mut self) -> Next {
        let offset = self.window.offset();
        let bytes = self.window.see(HEAD);
        if bytes.is_empty() {
            return Next::End;
        }
        let Some(head) = Head::read(bytes) else {
            let shown = bytes.get(..MARKER.len()).unwrap_or(bytes);
            let is_start = bytes.len() < HEAD && MARKER.starts_with(shown);
            return if is_start { Next::CutShort } else { Next::Damage };
        };
        let length = HEAD + head.stored;
        let Some(body) = self.window.see(length).get(HEAD..length) else { return Next::CutShort };
        match head.open(body) {
            Some(records) => Next::Block(Block { offset, first: head.first, records }, length),
            None => Next::Damage,
        }
    }
}

/// Moves the window on to the next good head of a block; `false` if there is none and the stream is
/// at its end.
fn to_marker(window: &mut Window) -> bool {
    loop {
        let bytes = window.see(SEARCH);
        match memmem::find(bytes, &MARKER) {
            Some(at) => {
                window.advance(at);
                let bytes = window.see(HEAD);
                if Head::read(bytes).is_some() || bytes.len() < HEAD {
                    return bytes.len() >= HEAD;
                }
                window.advance(1);
            }
            None => {
                // a marker may begin in the last bytes and end in those to come
                let length = bytes.len();
                let is_end = length < SEARCH;
                window.advance(if is_end { length } else { length - (MARKER.len() - 1) });
                if is_end {
                    return false;
                }
            }
        }
    }
}
