//! Where a line begins and ends in a stream.

use super::checksum::{checksum, stated_checksum};
use super::tag::{DATAGRAM_HEADER, TagBlock};
use crate::stream::Look;

/// Longest line that is taken, bytes. Makers' own sentences run to several hundred.
const LONGEST: usize = 512;

/// Longest TAG block that is taken, bytes. The standard allows 82.
const LONGEST_TAG: usize = 128;

/// What stands at the start of some bytes: a line from `$` or `!` to its checksum, or, if it has none,
/// to its end of line; a TAG block and the line behind it. CR and LF between lines, the header of a
/// datagram and a TAG block with no line behind it are filler.
///
/// A `$` inside a line starts a new one, so that a line cut short costs only itself. A line without a
/// checksum is a frame, as the port's [`super::ChecksumPolicy`] decides about it; one with a wrong
/// checksum is damaged. Behind a damaged TAG block the line is found bare.
#[must_use]
pub fn look(bytes: &[u8]) -> Look {
    match bytes.first() {
        Some(b'$' | b'!') => line(bytes),
        Some(b'\r' | b'\n') => Look::Filler(1),
        Some(b'\\') => tagged(bytes),
        Some(b'U') => header(bytes),
        _ => Look::Nothing,
    }
}

fn line(bytes: &[u8]) -> Look {
    for (at, byte) in bytes.iter().enumerate().skip(1) {
        match byte {
            b'*' => return checksum_at(bytes, at),
            b'\r' | b'\n' => return Look::Frame(at),
            b'$' => return Look::Nothing,
            // no sentence but a block of SBF, whose next bytes may look like an end of line
            b'@' if at == 1 => return Look::Nothing,
            b' '..=b'~' if at < LONGEST => {}
            _ => return Look::Nothing,
        }
    }
    Look::More(bytes.len() + 1)
}

fn checksum_at(bytes: &[u8], star: usize) -> Look {
    let Some(digits) = bytes.get(star + 1..star + 3) else {
        return Look::More(star + 3);
    };
    match stated_checksum(digits) {
        None => Look::Nothing,
        Some(stated) if bytes.get(1..star).map(checksum) == Some(stated) => Look::Frame(star + 3),
        Some(_) => Look::Damaged,
    }
}

fn header(bytes: &[u8]) -> Look {
    let length = DATAGRAM_HEADER.len();
    match bytes.get(..length) {
        Some(start) if start == DATAGRAM_HEADER => Look::Filler(length),
        None if DATAGRAM_HEADER.starts_with(bytes) => Look::More(bytes.len() + 1),
        _ => Look::Nothing,
    }
}

fn tagged(bytes: &[u8]) -> Look {
    let starts = |at: usize, good: fn(&u8) -> bool| bytes.get(at).is_none_or(good);
    if !starts(1, u8::is_ascii_alphabetic) || !starts(2, |byte| *byte == b':') {
        return Look::Nothing;
    }
    for (at, byte) in bytes.iter().enumerate().skip(1) {
        match byte {
            b'\\' => return behind_tag(bytes, at),
            b'$' | b'!' => return Look::Nothing,
            b' '..=b'~' if at < LONGEST_TAG => {}
            _ => return Look::Nothing,
        }
    }
    Look::More(bytes.len() + 1)
}

fn behind_tag(bytes: &[u8], end: usize) -> Look {
    let length = end + 1;
    if bytes.get(1..end).and_then(TagBlock::check).is_none() {
        return Look::Damaged;
    }
    let rest = bytes.get(length..).unwrap_or_default();
    match rest.first() {
        None => Look::More(length + 1),
        Some(b'$' | b'!') => match line(rest) {
            Look::Frame(line) => Look::Frame(length + line),
            Look::More(line) => Look::More(length + line),
            _ => Look::Filler(length),
        },
        Some(_) => Look::Filler(length),
    }
}
