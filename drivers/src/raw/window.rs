//! A stream seen through a window that is moved along it.

use std::fmt;
use std::io::{self, Read};

/// Least read from the system, bytes.
const READ: usize = 64 * 1024;

/// A stream seen through a window.
pub(crate) struct Window {
    input: Box<dyn Read + Send>,
    buffer: Vec<u8>,
    /// First byte of the buffer that is in the window.
    head: usize,
    offset: u64,
    ended: bool,
    fault: Option<io::Error>,
}

impl fmt::Debug for Window {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Window").field("offset", &self.offset).finish_non_exhaustive()
    }
}

impl Window {
    /// A window at the beginning of a stream.
    pub(crate) fn new(input: Box<dyn Read + Send>) -> Self {
        Window { input, buffer: Vec::new(), head: 0, offset: 0, ended: false, fault: None }
    }

    /// The bytes in the window: at least so many, fewer only at the end of the stream.
    pub(crate) fn see(&mut self, least: usize) -> &[u8] {
        if self.buffer.len() - self.head < least && !self.ended {
            self.buffer.drain(..self.head);
            self.head = 0;
            self.fill(least);
        }
        self.buffer.get(self.head..).unwrap_or_default()
    }

    /// Moves the window on by at most as many bytes as are in it.
    pub(crate) fn advance(&mut self, bytes: usize) {
        let bytes = bytes.min(self.buffer.len() - self.head);
        self.head += bytes;
        self.offset += bytes as u64;
    }

    /// Bytes of the stream before the window.
    pub(crate) fn offset(&self) -> u64 {
        self.offset
    }

    /// Why the stream ended, if not by its end. Told once.
    pub(crate) fn take_fault(&mut self) -> Option<io::Error> {
        self.fault.take()
    }

    fn fill(&mut self, least: usize) {
        while self.buffer.len() < least && !self.ended {
            let before = self.buffer.len();
            let wanted = (least - before).max(READ) as u64;
            match self.input.by_ref().take(wanted).read_to_end(&mut self.buffer) {
                Ok(read) => self.ended = (read as u64) < wanted,
                Err(fault) => {
                    self.ended = true;
                    self.fault = Some(fault);
                }
            }
        }
    }
}
