//! Chunks of HTTP/1.1 (RFC 9112, section 7.1) into the bytes that they hold. Reads any bytes and never panics.

/// Longest line of a chunk's size with its extensions, bytes.
const LINE: usize = 256;
/// Largest chunk, bytes.
const LARGEST: usize = 1 << 20;

/// What comes next.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Next {
    /// The line with the size of a chunk, of which so much has come.
    Size(Vec<u8>),
    /// So many bytes of a chunk.
    Data(usize),
    /// The end of the line behind a chunk, of which so many bytes have come.
    End(u8),
    /// Nothing: the last chunk has come.
    Nothing,
}

/// Takes chunks apart, however they are split.
#[derive(Clone, Debug)]
pub(super) struct Chunks {
    next: Next,
}

impl Chunks {
    /// At the beginning of the first chunk.
    pub(super) fn new() -> Self {
        Chunks { next: Next::Size(Vec::new()) }
    }

    /// Whether the last chunk has come.
    pub(super) fn is_over(&self) -> bool {
        self.next == Next::Nothing
    }

    /// Adds what some bytes of the stream hold.
    ///
    /// # Errors
    /// They are no chunks.
    pub(super) fn take(&mut self, mut bytes: &[u8], out: &mut Vec<u8>) -> Result<(), String> {
        let damaged = || Err("the chunks of the stream are damaged".to_owned());
        while let Some(first) = bytes.first() {
            match &mut self.next {
                Next::Size(line) if *first != b'\n' => {
                    line.push(*first);
                    if line.len() > LINE {
                        return damaged();
                    }
                    bytes = &bytes[1..];
                }
                Next::Size(line) => {
                    let Some(size) = size(line) else { return damaged() };
                    self.next = if size == 0 { Next::Nothing } else { Next::Data(size) };
                    bytes = &bytes[1..];
                }
                Next::Data(left) => {
                    let (data, rest) = bytes.split_at(bytes.len().min(*left));
                    out.extend_from_slice(data);
                    bytes = rest;
                    *left -= data.len();
                    if *left == 0 {
                        self.next = Next::End(0);
                    }
                }
                Next::End(count) => {
                    let is_end = *first == b'\n';
                    if !is_end && (*first != b'\r' || *count > 0) {
                        return damaged();
                    }
                    self.next = if is_end { Next::Size(Vec::new()) } else { Next::End(1) };
                    bytes = &bytes[1..];
                }
                Next::Nothing => return Ok(()),
            }
        }
        Ok(())
    }
}

/// The size that a line tells, before its extensions.
fn size(line: &[u8]) -> Option<usize> {
    let text = std::str::from_utf8(line).ok()?;
    let digits = text.split(';').next()?.trim();
    let is_size = (1..=8).contains(&digits.len()) && digits.bytes().all(|d| d.is_ascii_hexdigit());
    let size = usize::from_str_radix(digits, 16).ok().filter(|_| is_size)?;
    (size <= LARGEST).then_some(size)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn taken(bytes: &[u8], step: usize) -> (Result<(), String>, Vec<u8>, bool) {
        let (mut chunks, mut out) = (Chunks::new(), Vec::new());
        let all = bytes.chunks(step).try_for_each(|part| chunks.take(part, &mut out));
        (all, out, chunks.is_over())
    }

    #[test]
    fn chunks_are_taken_apart_however_they_are_split() {
        let stream = b"4\r\nwave\r\n0A;name=x\r\n0123456789\r\n1\nZ\n0\r\n\r\n";
        for step in 1..=stream.len() {
            let (result, out, is_over) = taken(stream, step);
            assert!(result.is_ok() && is_over, "{step}");
            assert_eq!(out, b"wave0123456789Z", "{step}");
        }
    }

    #[test]
    fn what_is_no_chunk_is_told() {
        for wrong in [
            &b"\xD3\x00\x13\n"[..],
            b"\r\n",
            b"-1\r\n",
            b"+4\r\n",
            b"fffffffff\r\n",
            b"7fffffff\r\n",
            b"4\r\nwaveX",
            b"4\r\nwave\r\r",
            &[b'1'; LINE + 2],
        ] {
            assert!(taken(wrong, 1).0.is_err(), "{wrong:?}");
        }
        assert!(taken(b"4\r\nwa", 3).0.is_ok());
    }
}
