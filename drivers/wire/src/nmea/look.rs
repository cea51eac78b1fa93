//! Where a line begins and ends in a stream.

use crate::stream::Look;

/// Longest line that is taken, bytes. Makers' own sentences run to several hundred.
const LONGEST: usize = 512;

/// What stands at the start of some bytes: a line from `$` or `!` to its checksum, or, if it has none,
/// to its end of line. CR and LF between lines are filler.
///
/// A `$` inside a line starts a new one, so that a line cut short costs only itself.
#[must_use]
pub fn look(bytes: &[u8]) -> Look {
    match bytes.first() {
        Some(b'$' | b'!') => line(bytes),
        Some(b'\r' | b'\n') => Look::Filler(1),
        _ => Look::Nothing,
    }
}

fn line(bytes: &[u8]) -> Look {
    for (at, byte) in bytes.iter().enumerate().skip(1) {
        match byte {
            b'*' => return checksum_at(bytes, at),
            b'\r' | b'\n' => return Look::Frame(at),
            b'$' => return Look::Nothing,
            b' '..=b'~' if at < LONGEST => {}
            _ => return Look::Nothing,
        }
    }
    Look::More(bytes.len() + 1)
}

fn checksum_at(bytes: &[u8], star: usize) -> Look {
    match bytes.get(star + 1..star + 3) {
        None => Look::More(star + 3),
        Some(digits) if digits.iter().all(u8::is_ascii_hexdigit) => Look::Frame(star + 3),
        Some(_) => Look::Nothing,
    }
}
