//! StdBin: the binary telegram of Exail (iXblue, IXSEA) inertial systems, protocol versions 2 to 5.
//!
//! ```text
//! 'I' 'X' version
//! navigation mask u32 [extended navigation mask u32, from version 3] external mask u32
//! [bytes of the navigation blocks u16, from version 4] bytes of the telegram u16
//! validity time u32, 0.1 ms   counter u32
//! one block for each bit of the masks, in the order of masks and bits
//! checksum u32: the sum of all bytes before it
//! ```
//!
//! All numbers are big endian. Axes of the maker: XV1 forward, XV2 to port, XV3 up; a rotation is
//! positive by the right hand, so that roll is positive when port goes up and pitch when the bow goes
//! down. Two pairs of blocks look alike and are not: rotation rates (bit 5) are freed from the Earth's
//! rotation and accelerations (bit 6) from gravity; only the raw rotation rates (extended bit 2) and
//! raw accelerations (bit 28) are what gyroscopes and accelerometers sense. A reading is made of the
//! raw pair, and of nothing else.
//!
//! The validity time counts from UTC midnight if the system is synchronised (bit 8 of the user
//! status), else from the system's start; the date is a default (2006-01-01) until then.
//!
//! Sources: the maker's open decoder `ixblue_stdbin_decoder` (MIT) for all layouts, sizes, units and
//! signs, and for the bits of the user status; its test logs for what an unsynchronised system sends.
//! The sign of the pitch angle is taken from that of the pitch rate. Not verified: that the logs' speeds
//! are positive along XV2 and XV3, and that an external block is there only when its sensor has sent
//! something new.
//!
//! In the maker's logs, of systems at rest, the raw pair reads 0 deg/s and 8.00 m/s^2 where the others
//! agree with 9.81, and no status says so: it seems that some systems do not fill these blocks. Such a
//! reading is not valid.

mod composer;
mod external;
mod reading;
mod sizes;
mod telegram;

pub use external::{EmLog, External, LogSpeed, UtcSync};
pub use telegram::{Navigation, Position, StdBinAttitude, StdBinHeave, Telegram};

use crate::stream::Look;

/// Longest telegram that is taken, bytes; all known blocks together have some 1250.
const LONGEST: usize = 2048;

/// Bytes of the checksum.
const SUM: usize = 4;

/// What stands at the start of some bytes: a telegram with its checksum verified.
#[must_use]
pub fn look(bytes: &[u8]) -> Look {
    if !bytes.iter().zip(b"IX").all(|(byte, expected)| byte == expected) {
        return Look::Nothing;
    }
    let Some(version) = bytes.get(2) else { return Look::More(3) };
    let Some(header) = header_length(*version) else { return Look::Nothing };
    let Some(length) = be_u16(bytes, header - 10) else { return Look::More(header) };
    match bytes.get(..length) {
        _ if !(header + SUM..=LONGEST).contains(&length) => Look::Nothing,
        None => Look::More(length),
        Some(frame) if is_sound(frame) => Look::Frame(length),
        Some(_) => Look::Damaged,
    }
}

/// Bytes before the blocks.
fn header_length(version: u8) -> Option<usize> {
    match version {
        2 => Some(21),
        3 => Some(25),
        4 | 5 => Some(27),
        _ => None,
    }
}

fn be_u16(bytes: &[u8], at: usize) -> Option<usize> {
    let pair = bytes.get(at..at + 2)?;
    Some(pair.iter().fold(0, |sum, byte| sum << 8 | usize::from(*byte)))
}

fn checksum(bytes: &[u8]) -> u32 {
    bytes.iter().map(|byte| u32::from(*byte)).sum()
}

fn is_sound(frame: &[u8]) -> bool {
    frame
        .split_last_chunk::<SUM>()
        .is_some_and(|(body, sum)| checksum(body) == u32::from_be_bytes(*sum))
}
