//! The binary messages of Actisense's adapters to NMEA 2000 (NGT-1, NGW-1 in that mode, and what speaks as they do): whole messages of
//! the bus over a serial line of 115200 baud.
//!
//! ```text
//! 10 02                 DLE STX
//! command               93 a message of the bus, 94 one to be sent, A0 and A1 from and to the adapter itself
//! length                of what follows up to the check
//! contents
//! check                 the sum of command, length, contents and check is 0 modulo 256
//! 10 03                 DLE ETX
//!
//! contents of 93:
//! byte 0      priority, 0 to 7
//! bytes 1-3   number of the parameter group
//! byte 4      destination
//! byte 5      source
//! bytes 6-9   clock of the adapter, ms
//! byte 10     length of the data, 0 to 223
//! from 11     data
//! ```
//!
//! Little endian. Between DLE STX and DLE ETX a byte of 10 is sent twice.
//!
//! The adapter puts fast packets together itself, and passes on by default what its list of received groups holds. It is never written to
//! here: what it is to pass on is told it with the maker's program.
//!
//! Source: `actisense-serial` of canboat (Apache-2.0), which is its only public description; verified against its recordings in the tests.

use crate::binary::{BinaryFault, Reader, Writer};
use crate::stream::Look;

const DLE: u8 = 0x10;
const STX: u8 = 0x02;
const ETX: u8 = 0x03;
const RECEIVED: u8 = 0x93;
/// Commands that are known; two bytes of another format begin no frame.
const COMMANDS: [u8; 4] = [RECEIVED, 0x94, 0xA0, 0xA1];
/// Most bytes of a message of NMEA 2000.
const LONGEST: usize = 223;
/// Bytes of the contents before the data.
const HEAD: usize = 11;

/// What stands at the start of some bytes.
#[must_use]
pub fn look(bytes: &[u8]) -> Look {
    match bytes {
        [DLE] => Look::More(2),
        [DLE, STX, inner @ ..] => within(inner),
        _ => Look::Nothing,
    }
}

/// The same of the bytes behind DLE STX.
fn within(inner: &[u8]) -> Look {
    let mut plain = Plain::default();
    let mut rest = inner.iter().copied();
    let mut taken = 2;
    while let Some(byte) = rest.next() {
        taken += 1;
        if byte != DLE {
            if !plain.take(byte) {
                return Look::Nothing;
            }
            continue;
        }
        taken += 1;
        match rest.next() {
            None => return Look::More(taken),
            Some(DLE) if plain.take(DLE) => {}
            Some(ETX) if plain.is_whole() => {
                return if plain.sum == 0 { Look::Frame(taken) } else { Look::Damaged };
            }
            Some(_) => return Look::Nothing,
        }
    }
    Look::More(taken + plain.missing() + 2)
}

/// What has come of command, length, contents and check.
#[derive(Clone, Copy, Debug, Default)]
struct Plain {
    bytes: usize,
    length: u8,
    sum: u8,
}

impl Plain {
    /// Takes a byte; whether it can be one of a frame.
    fn take(&mut self, byte: u8) -> bool {
        match self.bytes {
            0 if !COMMANDS.contains(&byte) => return false,
            1 => self.length = byte,
            _ if self.bytes > 1 && self.missing() == 0 => return false,
            _ => {}
        }
        self.bytes += 1;
        self.sum = self.sum.wrapping_add(byte);
        true
    }

    /// How many are to come at the least.
    fn missing(self) -> usize {
        let whole = if self.bytes < 2 { 3 } else { usize::from(self.length) + 3 };
        whole - self.bytes
    }

    fn is_whole(self) -> bool {
        self.bytes > 1 && self.missing() == 0
    }
}

/// What an adapter sends.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NgtFrame {
    /// A message of the bus.
    Received(NgtMessage),
    /// Something of the adapter itself; only its command is told.
    Other(u8),
}

/// A message of the bus as an adapter passes it on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NgtMessage {
    /// 0, the highest, to 7.
    pub priority: u8,
    /// Number of the parameter group.
    pub pgn: u32,
    /// Address of the receiver, 255 for all.
    pub destination: u8,
    /// Address of the sender.
    pub source: u8,
    /// Clock of the adapter, ms.
    pub clock: u32,
    /// Its contents, at most 223 bytes.
    pub data: Vec<u8>,
}

impl NgtFrame {
    /// Reads a frame.
    ///
    /// # Errors
    /// [`BinaryFault::Frame`] if it is none, its check is wrong, or its data are not as long as they are said to be; [`BinaryFault::Short`];
    /// [`BinaryFault::Range`] of a priority or a group that no bus carries.
    pub fn read(bytes: &[u8]) -> Result<Self, BinaryFault> {
        let [DLE, STX, inner @ .., DLE, ETX] = bytes else { return Err(BinaryFault::Frame) };
        if look(bytes) != Look::Frame(bytes.len()) {
            return Err(BinaryFault::Frame);
        }
        let mut plain = Vec::with_capacity(inner.len());
        let mut rest = inner.iter().copied();
        while let Some(byte) = rest.next() {
            plain.push(byte);
            if byte == DLE {
                rest.next();
            }
        }
        match plain.as_slice() {
            [RECEIVED, _, contents @ .., _] => NgtMessage::read(contents).map(NgtFrame::Received),
            [command, ..] => Ok(NgtFrame::Other(*command)),
            [] => Err(BinaryFault::Frame),
        }
    }
}

impl NgtMessage {
    fn read(contents: &[u8]) -> Result<Self, BinaryFault> {
        let mut reader = Reader::new(contents);
        let priority = reader.u8()?;
        let [low, middle, high] = reader.array()?;
        let (destination, source) = (reader.u8()?, reader.u8()?);
        let clock = reader.le_u32()?;
        let length = reader.u8()?;
        let pgn = u32::from_le_bytes([low, middle, high, 0]);
        if priority > 7 {
            return Err(BinaryFault::Range { field: "priority" });
        }
        if pgn > 0x3_FFFF {
            return Err(BinaryFault::Range { field: "PGN" });
        }
        let data = reader.rest().to_vec();
        if data.len() != usize::from(length) || data.len() > LONGEST {
            return Err(BinaryFault::Frame);
        }
        Ok(NgtMessage { priority, pgn, destination, source, clock, data })
    }

    /// Writes the frame of a message; `None` if it has more data than a message of the bus.
    #[must_use]
    pub fn write(&self) -> Option<Vec<u8>> {
        let length = u8::try_from(self.data.len()).ok().filter(|_| self.data.len() <= LONGEST)?;
        let mut plain = Writer::new();
        plain.u8(RECEIVED).u8(HEAD as u8 + length).u8(self.priority);
        let [low, middle, high, _] = self.pgn.to_le_bytes();
        plain.put(&[low, middle, high]).u8(self.destination).u8(self.source);
        plain.le_u32(self.clock).u8(length).put(&self.data);
        let sum = plain.bytes().iter().fold(0_u8, |sum, byte| sum.wrapping_add(*byte));
        plain.u8(sum.wrapping_neg());
        let mut frame = vec![DLE, STX];
        for byte in plain.into_bytes() {
            frame.push(byte);
            if byte == DLE {
                frame.push(DLE);
            }
        }
        frame.extend([DLE, ETX]);
        Some(frame)
    }
}
