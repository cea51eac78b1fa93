//! The frame: sync, class, id, length, payload, two bytes of Fletcher's sum.

use crate::binary::{BinaryFault, Writer};
use crate::stream::Look;

/// First bytes of every frame.
const SYNC: [u8; 2] = [0xB5, 0x62];

/// Sync, class, id and length.
const HEADER: usize = 6;

/// Header and checksum.
const OVERHEAD: usize = HEADER + 2;

/// Longest payload that is taken, bytes: RXM-RAWX with 255 measurements has 8176.
const LONGEST: usize = 8192;

/// What stands at the start of some bytes.
#[must_use]
pub fn look(bytes: &[u8]) -> Look {
    match bytes {
        [b'\xB5'] => Look::More(2),
        [b'\xB5', b'\x62', _, _, low, high, ..] => {
            whole(bytes, usize::from(u16::from_le_bytes([*low, *high])))
        }
        [b'\xB5', b'\x62', ..] => Look::More(HEADER),
        _ => Look::Nothing,
    }
}

fn whole(bytes: &[u8], payload: usize) -> Look {
    let length = payload + OVERHEAD;
    if payload > LONGEST {
        return Look::Nothing;
    }
    match bytes.get(SYNC.len()..length).and_then(<[u8]>::split_last_chunk::<2>) {
        None => Look::More(length),
        Some((summed, sum)) if fletcher(summed) == *sum => Look::Frame(length),
        Some(_) => Look::Damaged,
    }
}

/// Fletcher's sum with eight bits over class, id, length and payload.
fn fletcher(bytes: &[u8]) -> [u8; 2] {
    bytes.iter().fold([0, 0], |[a, b]: [u8; 2], byte| {
        let a = a.wrapping_add(*byte);
        [a, b.wrapping_add(a)]
    })
}

/// A frame whose checksum is good.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frame<'a> {
    /// Class of the message: 1 for NAV.
    pub class: u8,
    /// The message within its class.
    pub id: u8,
    /// What it carries.
    pub payload: &'a [u8],
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
        let [_, _, class, id, _, _, rest @ ..] = bytes else { return Err(BinaryFault::Frame) };
        let payload = rest.get(..rest.len().saturating_sub(2)).ok_or(BinaryFault::Frame)?;
        Ok(Frame { class: *class, id: *id, payload })
    }

    /// The payload of a frame that must be a certain message.
    pub(super) fn payload_of(bytes: &'a [u8], name: (u8, u8)) -> Result<&'a [u8], BinaryFault> {
        let frame = Frame::open(bytes)?;
        if (frame.class, frame.id) == name {
            Ok(frame.payload)
        } else {
            Err(BinaryFault::OtherMessage)
        }
    }

    /// All bytes of the frame. A payload beyond the longest that is taken is cut off.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let payload = self.payload.get(..LONGEST).unwrap_or(self.payload);
        let mut writer = Writer::new();
        writer.u8(self.class).u8(self.id).le_u16(payload.len() as u16).put(payload);
        let sum = fletcher(writer.bytes());
        [&SYNC, writer.bytes(), &sum].concat()
    }
}

/// The frame of a message.
pub(super) fn framed((class, id): (u8, u8), payload: &Writer) -> Vec<u8> {
    Frame { class, id, payload: payload.bytes() }.write()
}

/// Reader and writer of a message that is one table.
macro_rules! as_message {
    ($message:ident, $name:expr) => {
        impl $message {
            /// Reads a frame.
            ///
            /// # Errors
            /// What is wrong with the bytes.
            pub fn read(frame: &[u8]) -> Result<Self, $crate::binary::BinaryFault> {
                Self::read_fields(super::frame::Frame::payload_of(frame, $name)?)
            }

            /// The frame.
            #[must_use]
            pub fn write(&self) -> Vec<u8> {
                let (class, id) = $name;
                super::frame::Frame { class, id, payload: &self.write_fields() }.write()
            }
        }
    };
}
pub(super) use as_message;
