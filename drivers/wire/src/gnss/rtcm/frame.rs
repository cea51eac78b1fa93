//! The frame: D3, six zero bits, ten bits of length, the message, CRC-24Q. A message begins with twelve
//! bits of its number; one of no length is filler between messages.

use super::super::crc24q::crc24q;
use crate::binary::{BinaryFault, Writer};
use crate::stream::Look;

/// First byte of every frame.
const PREAMBLE: u8 = 0xD3;

/// Longest message that ten bits of length can tell.
const LONGEST: usize = 1023;

/// A frame whose checksum is good.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frame<'a> {
    /// The message, its number included.
    pub message: &'a [u8],
}

/// What stands at the start of some bytes.
#[must_use]
pub fn look(bytes: &[u8]) -> Look {
    match bytes {
        [PREAMBLE] => Look::More(2),
        [PREAMBLE, 0..=3] => Look::More(3),
        [PREAMBLE, high @ 0..=3, low, ..] => {
            whole(bytes, usize::from(u16::from_be_bytes([*high, *low])))
        }
        _ => Look::Nothing,
    }
}

fn whole(bytes: &[u8], message: usize) -> Look {
    let length = message + 6;
    match bytes.get(..length).and_then(<[u8]>::split_last_chunk::<3>) {
        // a single byte can not hold a number
        _ if message == 1 => Look::Nothing,
        None => Look::More(length),
        Some((summed, sum)) if crc(summed) == *sum => Look::Frame(length),
        Some(_) => Look::Damaged,
    }
}

fn crc(bytes: &[u8]) -> [u8; 3] {
    let [_, sum @ ..] = crc24q(bytes).to_be_bytes();
    sum
}

impl<'a> Frame<'a> {
    /// Opens one whole frame.
    ///
    /// # Errors
    /// [`BinaryFault::Frame`] unless the bytes are one frame with a good checksum and nothing more.
    pub fn open(bytes: &'a [u8]) -> Result<Self, BinaryFault> {
        if look(bytes) != Look::Frame(bytes.len()) {
            return Err(BinaryFault::Frame);
        }
        let message = bytes.get(3..bytes.len().saturating_sub(3)).ok_or(BinaryFault::Frame)?;
        Ok(Frame { message })
    }

    /// Number of the message: 1005, 1077; `None` for filler.
    #[must_use]
    pub fn number(&self) -> Option<u16> {
        match self.message {
            [high, low, ..] => Some(u16::from_be_bytes([*high, *low]) >> 4),
            _ => None,
        }
    }

    /// All bytes of the frame. A message beyond 1023 bytes is cut off.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let message = self.message.get(..LONGEST).unwrap_or(self.message);
        let mut writer = Writer::new();
        writer.u8(PREAMBLE).be_u16(message.len() as u16).put(message);
        let sum = crc(writer.bytes());
        writer.put(&sum);
        writer.into_bytes()
    }
}
