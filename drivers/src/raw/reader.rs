//! Reads a recording: a file, or all files of a folder.

use std::collections::VecDeque;
use std::fs::{self, File};
use std::io::{Cursor, Read};
use std::path::{Path, PathBuf};

use insd_base::Arrival;

use super::fault::RawFault;
use super::file::{Block, FileReader};
use super::header::FileHeader;
use super::names::{Member, members};
use super::record::Record;

/// Reads a recording from its first arrival to its last. What is wrong is told between them, in its
/// place, and reading goes on.
#[derive(Debug)]
pub struct RawReader {
    /// Files to be read.
    files: VecDeque<Member>,
    current: Option<FileReader>,
    header: Option<FileHeader>,
    /// Number and run of the file read last.
    last: Option<Place>,
    /// Records of the run that have passed, those told as missing included. `None`: not known.
    passed: Option<u64>,
    waiting: VecDeque<Result<Arrival, RawFault>>,
    counts: RawRead,
}

#[derive(Clone, Copy, Debug)]
struct Place {
    serial: u32,
    run: Option<u32>,
}

/// What a reader has met so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RawRead {
    /// Arrivals given.
    pub arrivals: u64,
    /// Faults given.
    pub faults: u64,
    /// Records that were written and are missing, as far as later blocks tell.
    pub missing: u64,
    /// Arrivals that were not recorded.
    pub not_recorded: u64,
}

impl RawReader {
    /// Opens a file, or a folder with the files of one series. In a folder, files that are not
    /// recordings after all are told in their place.
    ///
    /// # Errors
    /// The path cannot be read; a single file is empty, foreign or of a newer version; a folder has no
    /// file of a recording, or those of several.
    pub fn open(path: &Path) -> Result<Self, RawFault> {
        let guard = |source| RawFault::Unreadable { file: path.to_owned(), offset: 0, source };
        if !fs::metadata(path).map_err(guard)?.is_dir() {
            let file = File::open(path).map_err(guard)?;
            return Self::single(FileReader::new(path, Box::new(file))?);
        }
        let files = members(path).map_err(guard)?;
        let mut names: Vec<String> = files.iter().map(|member| member.name.clone()).collect();
        names.dedup();
        match names.len() {
            0 => Err(RawFault::NoFiles { folder: path.to_owned() }),
            1 => {
                let mut reader = Self::empty(files.into());
                reader.next_file();
                Ok(reader)
            }
            _ => Err(RawFault::SeveralSeries { folder: path.to_owned(), names }),
        }
    }

    /// Reads a file that is in memory. `name` is what faults call it.
    ///
    /// # Errors
    /// It is empty, foreign or of a newer version.
    pub fn from_bytes(name: &str, bytes: Vec<u8>) -> Result<Self, RawFault> {
        Self::from_read(name, Cursor::new(bytes))
    }

    /// Reads a file from a stream. `name` is what faults call it.
    ///
    /// # Errors
    /// It is empty, foreign or of a newer version, or the stream fails at its beginning.
    pub fn from_read(name: &str, input: impl Read + Send + 'static) -> Result<Self, RawFault> {
        Self::single(FileReader::new(&PathBuf::from(name), Box::new(input))?)
    }

    /// The last header that could be read, at first that of the first file: the configuration, the
    /// program, and the clocks at the beginning. `None` while every header was damaged.
    #[must_use]
    pub fn header(&self) -> Option<&FileHeader> {
        self.header.as_ref()
    }

    /// What has been met so far.
    #[must_use]
    pub fn counts(&self) -> RawRead {
        self.counts
    }

    fn empty(files: VecDeque<Member>) -> Self {
        RawReader {
            files,
            current: None,
            header: None,
            last: None,
            passed: None,
            waiting: VecDeque::new(),
            counts: RawRead::default(),
        }
    }

    fn single(file: FileReader) -> Result<Self, RawFault> {
        let mut reader = Self::empty(VecDeque::new());
        reader.header = file.header().cloned();
        reader.current = Some(file);
        Ok(reader)
    }

    /// Opens the next file of the folder; `false` if there is none.
    fn next_file(&mut self) -> bool {
        let Some(member) = self.files.pop_front() else { return false };
        let opened = File::open(&member.path)
            .map_err(|source| RawFault::Unreadable { file: member.path.clone(), offset: 0, source })
            .and_then(|file| FileReader::new(&member.path, Box::new(file)));
        let run = opened.as_ref().ok().and_then(|file| file.header().map(|header| header.run));
        self.compare(&member, run);
        match opened {
            Ok(file) => {
                if let Some(header) = file.header() {
                    self.header = Some(header.clone());
                }
                self.current = Some(file);
            }
            Err(fault) => self.waiting.push_back(Err(fault)),
        }
        true
    }

    /// Tells what is missing between the file before and this one, and whether the program started
    /// anew.
    fn compare(&mut self, member: &Member, run: Option<u32>) {
        let known = self.last.and_then(|last| last.run);
        let is_new_run = run.is_some() && run != known;
        let expected = match self.last {
            Some(last) => last.serial.saturating_add(1),
            None => run.unwrap_or(member.serial),
        };
        if expected < member.serial {
            let file = member.path.clone();
            let (from, to) = (expected, member.serial - 1);
            self.waiting.push_back(Err(RawFault::FilesMissing { file, from, to }));
        }
        if is_new_run {
            self.passed = Some(0);
            if known.is_some() {
                self.waiting.push_back(Err(RawFault::NewRun { file: member.path.clone() }));
            }
        }
        self.last = Some(Place { serial: member.serial, run: run.or(known) });
    }

    fn take(&mut self, block: Block, file: &Path) {
        let missing = self.passed.map_or(0, |passed| block.first.saturating_sub(passed));
        if missing > 0 {
            self.counts.missing = self.counts.missing.saturating_add(missing);
            let (file, offset) = (file.to_owned(), block.offset);
            self.waiting.push_back(Err(RawFault::Missing { file, offset, records: missing }));
        }
        self.passed = Some(block.first.saturating_add(block.records.len() as u64));
        for record in block.records {
            self.waiting.push_back(match record {
                Record::Arrival(arrival) => Ok(arrival),
                Record::Gap(arrivals) => {
                    self.counts.not_recorded = self.counts.not_recorded.saturating_add(arrivals);
                    Err(RawFault::NotRecorded { file: file.to_owned(), arrivals })
                }
            });
        }
    }
}

impl Iterator for RawReader {
    type Item = Result<Arrival, RawFault>;

    fn next(&mut self) -> Option<Self::Item> {
        while self.waiting.is_empty() {
            let Some(mut file) = self.current.take() else {
                if self.next_file() {
                    continue;
                }
                return None;
            };
            match file.next() {
                Some(Ok(block)) => self.take(block, file.path()),
                Some(Err(fault)) => self.waiting.push_back(Err(fault)),
                // the next file is opened when this one has been told to its end
                None => continue,
            }
            self.current = Some(file);
        }
        let next = self.waiting.pop_front();
        match &next {
            Some(Ok(_)) => self.counts.arrivals += 1,
            _ => self.counts.faults += 1,
        }
        next
    }
}
