//! Lines of a byte stream, in bounded memory.
//!
//! The `csv` crate is not used for reading: a quote mark or a line without end would make it
//! collect the rest of the file in memory, and the format knows no quotes.

use std::io::{self, Read};

/// Longest line that is read, bytes; a row of any file of the format has less than 400.
pub const MAX_LINE: usize = 64 * 1024;

const BUFFER: usize = 4 * MAX_LINE;

/// Why there is no next line.
#[derive(Debug)]
pub(super) enum LineFault {
    /// No end within [`MAX_LINE`].
    TooLong,
    /// The source gave up.
    Io(io::Error),
}

/// Splits a stream at line feeds; carriage returns before them are dropped.
pub(super) struct Lines<R> {
    source: R,
    buffer: Vec<u8>,
    start: usize,
    end: usize,
    number: u64,
}

impl<R: Read> Lines<R> {
    pub(super) fn new(source: R) -> Self {
        Lines { source, buffer: vec![0; BUFFER], start: 0, end: 0, number: 0 }
    }

    /// Number of the line that was returned last, counted from 1.
    pub(super) fn number(&self) -> u64 {
        self.number
    }

    /// The next line without its end; the last one needs none. `None` at the end of the stream.
    pub(super) fn next_line(&mut self) -> Result<Option<&[u8]>, LineFault> {
        let mut searched = 0;
        loop {
            let unread = &self.buffer[self.start + searched..self.end];
            if let Some(offset) = memchr::memchr(b'\n', unread) {
                let length = searched + offset;
                if length > MAX_LINE {
                    return Err(LineFault::TooLong);
                }
                return Ok(Some(self.take(length, 1)));
            }
            searched = self.end - self.start;
            if searched > MAX_LINE {
                return Err(LineFault::TooLong);
            }
            if self.fill().map_err(LineFault::Io)? == 0 {
                return Ok((searched > 0).then(|| self.take(searched, 0)));
            }
        }
    }

    fn take(&mut self, length: usize, ending: usize) -> &[u8] {
        let line = self.start..self.start + length;
        self.start = line.end + ending;
        self.number += 1;
        let line = &self.buffer[line];
        line.strip_suffix(b"\r").unwrap_or(line)
    }

    fn fill(&mut self) -> io::Result<usize> {
        self.buffer.copy_within(self.start..self.end, 0);
        self.end -= self.start;
        self.start = 0;
        loop {
            match self.source.read(&mut self.buffer[self.end..]) {
                Err(fault) if fault.kind() == io::ErrorKind::Interrupted => {}
                Err(fault) => return Err(fault),
                Ok(count) => {
                    self.end += count;
                    return Ok(count);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    struct Endless;
    impl Read for Endless {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            buffer.fill(b'7');
            Ok(buffer.len())
        }
    }

    /// Hands out a few bytes at a time.
    struct Drops<'a>(&'a [u8], usize);
    impl Read for Drops<'_> {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            let count = self.1.min(self.0.len()).min(buffer.len());
            buffer[..count].copy_from_slice(&self.0[..count]);
            self.0 = &self.0[count..];
            Ok(count)
        }
    }

    #[test]
    fn a_line_without_end_is_refused_in_bounded_memory() {
        assert!(matches!(Lines::new(Endless).next_line(), Err(LineFault::TooLong)));
    }

    #[test]
    fn carriage_returns_and_a_missing_last_line_feed_do_not_matter() {
        let mut lines = Lines::new(&b"a\r\n\nb"[..]);
        assert_eq!(lines.next_line().unwrap().unwrap(), b"a");
        assert_eq!(lines.next_line().unwrap().unwrap(), b"");
        assert_eq!(lines.next_line().unwrap().unwrap(), b"b");
        assert_eq!(lines.number(), 3);
        assert!(lines.next_line().unwrap().is_none());
    }

    proptest! {
        #[test]
        fn lines_do_not_depend_on_how_the_bytes_arrive(text in "[a-c\n]{0,200}", size in 1..50_usize) {
            let mut lines = Lines::new(Drops(text.as_bytes(), size));
            for expected in text.lines() {
                prop_assert_eq!(lines.next_line().unwrap().unwrap(), expected.as_bytes());
            }
            prop_assert!(lines.next_line().unwrap().is_none());
        }
    }
}
