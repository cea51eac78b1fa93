//! Cuts a stream of bytes into lines.

/// Longest line that is kept, bytes. Makers' own sentences run to about 130.
const LONGEST: usize = 256;

/// Collects bytes from `$` to line feed, whatever the chunks they come in.
///
/// A `$` always starts a new line, so that a line cut short costs only itself.
#[derive(Clone, Debug, Default)]
pub struct Framer {
    line: Vec<u8>,
    complete: bool,
    skipped: u64,
}

impl Framer {
    /// A framer that waits for its first `$`.
    #[must_use]
    pub fn new() -> Self {
        Framer::default()
    }

    /// Takes one byte and gives back the line that it completes, `$` to line feed.
    pub fn push(&mut self, byte: u8) -> Option<&[u8]> {
        if self.complete {
            self.complete = false;
            self.line.clear();
        }
        match byte {
            b'$' => {
                self.drop_line();
                self.line.push(byte);
            }
            _ if self.line.is_empty() => self.skipped += 1,
            _ if self.line.len() == LONGEST => {
                self.drop_line();
                self.skipped += 1;
            }
            _ => self.line.push(byte),
        }
        self.complete = byte == b'\n' && !self.line.is_empty();
        self.complete.then_some(&self.line)
    }

    /// Bytes that belonged to no complete line.
    #[must_use]
    pub fn skipped(&self) -> u64 {
        self.skipped
    }

    fn drop_line(&mut self) {
        self.skipped += self.line.len() as u64;
        self.line.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(bytes: &[u8]) -> (Vec<Vec<u8>>, u64) {
        let mut framer = Framer::new();
        let lines = bytes.iter().filter_map(|b| framer.push(*b).map(<[u8]>::to_vec)).collect();
        (lines, framer.skipped())
    }

    #[test]
    fn lines_are_found_between_rubbish_and_the_rubbish_is_counted() {
        let (found, skipped) = lines(b"\xFF\x00x\r\n$A*00\r\n\r\n$B,cut$C*00\r\n");
        assert_eq!(found, [b"$A*00\r\n".to_vec(), b"$C*00\r\n".to_vec()]);
        assert_eq!(skipped, 5 + 2 + 6);
    }

    #[test]
    fn a_line_without_end_does_not_grow_for_ever() {
        let mut framer = Framer::new();
        for _ in 0..100_000 {
            assert_eq!(framer.push(b'$'), None);
            for _ in 0..10 {
                assert_eq!(framer.push(b'x'), None);
            }
        }
        for _ in 0..100_000 {
            assert_eq!(framer.push(b'y'), None);
        }
        assert!(framer.line.len() <= LONGEST);
    }
}
