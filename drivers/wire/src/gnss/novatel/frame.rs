//! The frame: sync, header of one of two kinds, payload, CRC.

use crc::{Algorithm, Crc};

use crate::binary::{BinaryFault, Reader, Writer};
use crate::gnss::{EpochTime, gps_time};
use crate::stream::Look;

/// The CRC-32 of Ethernet that begins with zero and is not inverted.
const ALGORITHM: Algorithm<u32> = Algorithm {
    width: 32,
    poly: 0x04C1_1DB7,
    init: 0,
    refin: true,
    refout: true,
    xorout: 0,
    check: 0x2DFD_2D88,
    residue: 0,
};
const CRC: Crc<u32> = Crc::<u32>::new(&ALGORITHM);

/// Bytes of the long header as it is written; the frame tells it, as later receivers may append to it.
const LONG: usize = 28;

/// Bytes of the short header.
const SHORT: usize = 12;

/// Bytes of the CRC.
const SUM: usize = 4;

/// Longest payload that is taken, bytes: TRACKSTAT of a receiver with all its channels has 9,416.
const LONGEST: usize = 16 * 1024;

/// Nanoseconds of a millisecond.
const MILLI: i64 = 1_000_000;

/// Milliseconds of a week.
const WEEK: i32 = 604_800_000;

/// COARSE: from this time status on the time is known to a few milliseconds.
const COARSE: u8 = 100;

/// What stands at the start of some bytes.
#[must_use]
pub fn look(bytes: &[u8]) -> Look {
    match bytes {
        [0xAA] => Look::More(2),
        [0xAA, 0x44] => Look::More(3),
        [0xAA, 0x44, 0x12, header, _, _, _, _, low, high, ..] => {
            let header = usize::from(*header);
            let payload = usize::from(u16::from_le_bytes([*low, *high]));
            if header < LONG || payload > LONGEST {
                Look::Nothing
            } else {
                whole(bytes, header + payload)
            }
        }
        [0xAA, 0x44, 0x12, ..] => Look::More(10),
        [0xAA, 0x44, 0x13, length, ..] => whole(bytes, SHORT + usize::from(*length)),
        [0xAA, 0x44, 0x13] => Look::More(4),
        _ => Look::Nothing,
    }
}

fn whole(bytes: &[u8], summed: usize) -> Look {
    let length = summed + SUM;
    match bytes.get(..length).and_then(<[u8]>::split_last_chunk::<SUM>) {
        None => Look::More(length),
        Some((summed, sum)) if CRC.checksum(summed) == u32::from_le_bytes(*sum) => {
            Look::Frame(length)
        }
        Some(_) => Look::Damaged,
    }
}

/// Which log it is, and when.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Header {
    /// Number of the log: 42 for BESTPOS.
    pub id: u16,
    /// Whether the header is a short one, which tells no status of time.
    pub short: bool,
    /// Whether it answers a command.
    pub response: bool,
    /// How well the time is known: 20 unknown, 100 coarse, 160 fine, 180 fine and steered; zero of a short header.
    pub time_status: u8,
    /// GPS week, without rollover.
    pub week: u16,
    /// Time of the week, ms.
    pub milliseconds: i32,
}

impl Header {
    /// Opens one whole frame: its header and its payload.
    ///
    /// # Errors
    /// [`BinaryFault::Frame`] unless the bytes are one frame with a good checksum and nothing more.
    pub fn open(bytes: &[u8]) -> Result<(Self, &[u8]), BinaryFault> {
        if look(bytes) != Look::Frame(bytes.len()) {
            return Err(BinaryFault::Frame);
        }
        let mut reader = Reader::new(bytes);
        let [_, _, sync, length] = reader.array()?;
        let id = reader.le_u16()?;
        let short = sync == 0x13;
        let [kind, _, _, _, _, _, _, time_status] = if short { [0; 8] } else { reader.array()? };
        let (week, milliseconds) = (reader.le_u16()?, reader.le_i32()?);
        let response = kind & 0x80 != 0;
        let start = if short { SHORT } else { usize::from(length) };
        let payload =
            bytes.get(start..bytes.len().saturating_sub(SUM)).ok_or(BinaryFault::Frame)?;
        Ok((Header { id, short, response, time_status, week, milliseconds }, payload))
    }

    /// The frame of a payload, of the first port; what there is no room for is cut off.
    #[must_use]
    pub fn write(&self, payload: &[u8]) -> Vec<u8> {
        let longest = if self.short { usize::from(u8::MAX) } else { LONGEST };
        let payload = payload.get(..longest).unwrap_or(payload);
        let mut writer = Writer::new();
        if self.short {
            writer.put(&[0xAA, 0x44, 0x13, payload.len() as u8]).le_u16(self.id);
            writer.le_u16(self.week).le_i32(self.milliseconds);
        } else {
            let kind = u8::from(self.response) << 7;
            writer.put(&[0xAA, 0x44, 0x12, LONG as u8]).le_u16(self.id).put(&[kind, 0x20]);
            writer.le_u16(payload.len() as u16).le_u16(0).put(&[0, self.time_status]);
            writer.le_u16(self.week).le_i32(self.milliseconds).put(&[0; 8]);
        }
        writer.put(payload);
        let sum = CRC.checksum(writer.bytes());
        writer.le_u32(sum);
        writer.into_bytes()
    }

    /// The instant, if the receiver knows it to a few milliseconds at least.
    #[must_use]
    pub fn epoch(&self) -> Option<EpochTime> {
        let known = self.time_status >= COARSE && (0..WEEK).contains(&self.milliseconds);
        let time = gps_time(self.week, i64::from(self.milliseconds) * MILLI)?;
        known.then_some(EpochTime::Gps(time))
    }
}
