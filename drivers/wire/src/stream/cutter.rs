//! The cutter: bytes in, frames out, everything else counted.

use super::{Look, Protocol};

/// Bytes that have been dealt with may stay in the buffer up to this many.
const COMPACT: usize = 16 * 1024;
/// Each of so many first bytes may say that a frame is none: what begins like a long one is looked at again with each of them.
const BEGIN: usize = 8;

/// Finds the frames of some protocols in a stream of bytes.
#[derive(Clone, Debug)]
pub struct Cutter {
    protocols: Vec<Protocol>,
    /// Which bytes can begin a frame.
    starts: [bool; 256],
    buffer: Vec<u8>,
    /// First byte of the buffer that is not dealt with.
    head: usize,
    /// No decision is possible before the buffer has this many bytes after `head`.
    wanted: usize,
    /// Bytes of the stream before `buffer[head]`.
    position: u64,
    skipped: u64,
    damaged: u64,
}

/// One frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cut<'a> {
    /// Whose.
    pub protocol: Protocol,
    /// All its bytes.
    pub bytes: &'a [u8],
    /// Bytes of the stream up to the frame's end.
    pub end: u64,
}

impl Cutter {
    /// A cutter at the beginning of its stream. Of two protocols that both see a frame the one that
    /// is named first has it.
    #[must_use]
    pub fn new(protocols: &[Protocol]) -> Self {
        let mut starts = [false; 256];
        for (byte, start) in (0..=u8::MAX).zip(&mut starts) {
            *start = protocols.iter().any(|protocol| protocol.may_start(byte));
        }
        Cutter {
            protocols: protocols.to_vec(),
            starts,
            buffer: Vec::new(),
            head: 0,
            wanted: 1,
            position: 0,
            skipped: 0,
            damaged: 0,
        }
    }

    /// Takes bytes in. [`Cutter::cut`] then gives the frames that they complete.
    pub fn push(&mut self, bytes: &[u8]) {
        if self.head >= COMPACT || self.head == self.buffer.len() {
            self.buffer.drain(..self.head);
            self.head = 0;
        }
        self.buffer.extend_from_slice(bytes);
    }

    /// The next frame, until there is none.
    pub fn cut(&mut self) -> Option<Cut<'_>> {
        while self.waiting() >= self.wanted {
            match self.look() {
                (protocol, Look::Frame(length)) => return Some(self.take(protocol, length)),
                (_, Look::Filler(length)) => self.advance(length),
                (_, Look::More(wanted)) => {
                    let next = self.waiting() + 1;
                    self.wanted = if next <= BEGIN { next } else { wanted.max(next) };
                    return None;
                }
                (_, Look::Damaged) => {
                    self.damaged += 1;
                    self.skip();
                }
                (_, Look::Nothing) => self.skip(),
            }
        }
        None
    }

    /// The stream has been silent for so long that what is waiting can not become a frame: its first
    /// byte is skipped, and frames behind it come to light. Does nothing if nothing is waiting.
    pub fn give_up(&mut self) {
        if self.waiting() > 0 {
            self.skip();
        }
    }

    /// Whether the beginning of a frame waits for its end.
    #[must_use]
    pub fn is_waiting(&self) -> bool {
        self.waiting() > 0
    }

    /// Bytes of the stream that are dealt with: in a frame that was handed over, or skipped.
    #[must_use]
    pub fn position(&self) -> u64 {
        self.position
    }

    /// Bytes that belonged to no frame.
    #[must_use]
    pub fn skipped(&self) -> u64 {
        self.skipped
    }

    /// Frames with a wrong checksum.
    #[must_use]
    pub fn damaged(&self) -> u64 {
        self.damaged
    }

    fn waiting(&self) -> usize {
        self.buffer.len() - self.head
    }

    /// What stands at the head: a frame if any protocol sees one, else whatever promises most.
    fn look(&self) -> (Protocol, Look) {
        let bytes = &self.buffer[self.head..];
        let mut best = (self.protocols.first().copied().unwrap_or(Protocol::Nmea), Look::Nothing);
        for protocol in &self.protocols {
            let look = protocol.look(bytes);
            if promise(look) > promise(best.1) {
                best = (*protocol, look);
            }
        }
        if let Look::Frame(length) | Look::Filler(length) = best.1 {
            debug_assert!((1..=bytes.len()).contains(&length));
        }
        best
    }

    fn take(&mut self, protocol: Protocol, length: usize) -> Cut<'_> {
        let from = self.head;
        self.advance(length);
        Cut { protocol, bytes: &self.buffer[from..self.head], end: self.position }
    }

    fn advance(&mut self, length: usize) {
        let length = length.clamp(1, self.waiting());
        self.head += length;
        self.position += length as u64;
        self.wanted = 1;
    }

    /// Past the first byte, and on to the next that can begin anything.
    fn skip(&mut self) {
        let rest = &self.buffer[self.head + 1..];
        let next = rest.iter().position(|byte| self.starts[usize::from(*byte)]);
        let length = 1 + next.unwrap_or(rest.len());
        self.skipped += length as u64;
        self.advance(length);
    }
}

/// Order in which looks are believed.
fn promise(look: Look) -> u8 {
    match look {
        Look::Nothing => 0,
        Look::Damaged => 1,
        Look::More(_) => 2,
        Look::Filler(_) => 3,
        Look::Frame(_) => 4,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frames(chunks: &[&[u8]]) -> (Vec<(Vec<u8>, u64)>, u64) {
        let mut cutter = Cutter::new(&Protocol::ALL);
        let mut found = Vec::new();
        for chunk in chunks {
            cutter.push(chunk);
            while let Some(cut) = cutter.cut() {
                found.push((cut.bytes.to_vec(), cut.end));
            }
        }
        (found, cutter.skipped())
    }

    #[test]
    fn frames_are_found_between_rubbish_and_the_rubbish_is_counted() {
        let (found, skipped) = frames(&[b"\xFF\x00x\r\n$A*41\r\n\r\n$B,cut$C*43\r\n"]);
        assert_eq!(found, [(b"$A*41".to_vec(), 10), (b"$C*43".to_vec(), 25)]);
        assert_eq!(skipped, 3 + 6);
    }

    #[test]
    fn the_chunks_do_not_matter() {
        let bytes = b"xx$HETHS,316.70,E*1A\r\ngarbage$$$\xB5\x62$HETHS,316.70,E*1A\r\n";
        let whole = frames(&[bytes]);
        for at in 0..bytes.len() {
            assert_eq!(frames(&[&bytes[..at], &bytes[at..]]), whole);
        }
        let single: Vec<&[u8]> = bytes.chunks(1).collect();
        assert_eq!(frames(&single), whole);
    }

    #[test]
    fn a_single_byte_that_could_begin_a_long_frame_keeps_nobody_waiting() {
        for first in 0..=u8::MAX {
            let bytes = [&[first], &b"$HETHS,316.70,E*1A\r\n"[..]].concat();
            let single: Vec<&[u8]> = bytes.chunks(1).collect();
            assert_eq!(frames(&single), frames(&[&bytes]), "{first:#x}");
        }
    }

    #[test]
    fn a_line_without_end_does_not_grow_for_ever() {
        let mut cutter = Cutter::new(&Protocol::ALL);
        for _ in 0..10_000 {
            cutter.push(b"$xxxxxxxxxxyyyyyyyyyyyyyyyyyyyyyyyyyy");
            assert_eq!(cutter.cut(), None);
        }
        assert!(cutter.buffer.len() < 4 * COMPACT);
    }

    #[test]
    fn after_a_silence_the_frame_behind_a_false_start_comes_to_light() {
        let mut cutter = Cutter::new(&Protocol::ALL);
        cutter.push(b"$HETHS,316");
        assert_eq!(cutter.cut(), None);
        assert!(cutter.is_waiting());
        cutter.give_up();
        assert!(!cutter.is_waiting());
        assert_eq!(cutter.skipped(), 10);
    }
}
