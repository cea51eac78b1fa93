//! The block: sync, CRC, id with revision, length, time stamp, body, padding to a multiple of four.

use crc::{CRC_16_XMODEM, Crc, Table};
use insd_base::GpsTime;

use crate::binary::{BinaryFault, Reader, Writer};
use crate::gnss::{EpochTime, gps_time};
use crate::stream::Look;

/// CRC-CCITT that begins with zero.
const CRC: Crc<u16, Table<16>> = Crc::<u16, Table<16>>::new(&CRC_16_XMODEM);

/// First bytes of every block.
const SYNC: [u8; 2] = *b"$@";

/// Sync, CRC, id and length.
const HEADER: usize = 8;

/// Header and time stamp, padded.
const SHORTEST: usize = 16;

/// Longest block that is taken, bytes: MeasEpoch of 80 satellites with six signals each has 6.4 kB.
const LONGEST: usize = 8192;

/// Nanoseconds of a millisecond.
const MILLI: i64 = 1_000_000;

/// Milliseconds of a week.
const WEEK: u32 = 604_800_000;

/// What stands at the start of some bytes.
#[must_use]
pub fn look(bytes: &[u8]) -> Look {
    match bytes {
        [b'$'] => Look::More(2),
        [b'$', b'@', _, _, _, _, low, high, ..] => {
            whole(bytes, usize::from(u16::from_le_bytes([*low, *high])))
        }
        [b'$', b'@', ..] => Look::More(HEADER),
        _ => Look::Nothing,
    }
}

fn whole(bytes: &[u8], length: usize) -> Look {
    if !length.is_multiple_of(4) || !(SHORTEST..=LONGEST).contains(&length) {
        return Look::Nothing;
    }
    match bytes.get(SYNC.len()..length).and_then(<[u8]>::split_first_chunk::<2>) {
        None => Look::More(length),
        Some((sum, summed)) if CRC.checksum(summed) == u16::from_le_bytes(*sum) => {
            Look::Frame(length)
        }
        Some(_) => Look::Damaged,
    }
}

/// A block whose checksum is good.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frame<'a> {
    /// Number of the block, 13 bits: 4007 for PVTGeodetic.
    pub id: u16,
    /// Revision of its layout, 0 to 7; each keeps the fields of those before it.
    pub revision: u8,
    /// What follows the header: time stamp, body, padding.
    pub payload: &'a [u8],
}

impl<'a> Frame<'a> {
    /// Opens one whole block.
    ///
    /// # Errors
    /// [`BinaryFault::Frame`] unless the bytes are one block with a good checksum and nothing more.
    pub fn open(bytes: &'a [u8]) -> Result<Self, BinaryFault> {
        if look(bytes) != Look::Frame(bytes.len()) {
            return Err(BinaryFault::Frame);
        }
        let [_, _, _, _, low, high, _, _, payload @ ..] = bytes else {
            return Err(BinaryFault::Frame);
        };
        let id = u16::from_le_bytes([*low, *high]);
        Ok(Frame { id: id & 0x1FFF, revision: (id >> 13) as u8, payload })
    }

    /// All bytes of the block, with padding. A payload beyond the longest that is taken is cut off.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let payload = self.payload.get(..LONGEST - HEADER).unwrap_or(self.payload);
        let length = (HEADER + payload.len()).next_multiple_of(4).max(SHORTEST);
        let mut writer = Writer::new();
        writer.le_u16(u16::from(self.revision) << 13 | self.id & 0x1FFF).le_u16(length as u16);
        writer.put(payload);
        let mut summed = writer.into_bytes();
        summed.resize(length - 4, 0);
        let sum = CRC.checksum(&summed).to_le_bytes();
        [&SYNC[..], &sum, &summed].concat()
    }
}

/// The time stamp at the head of every block, by the receiver's clock, which keeps GPS time to half a
/// millisecond or better (PVTGeodetic tells the difference).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct SbfStamp {
    /// `TOW`: time of the GPS week, whole milliseconds, in ns.
    pub time_of_week: Option<i64>,
    /// `WNc`: GPS week, without rollover.
    pub week: Option<u16>,
}

impl SbfStamp {
    /// The stamp of an instant, to the nearest millisecond.
    #[must_use]
    pub fn of(time: GpsTime) -> Self {
        let rounded = GpsTime::from_nanos(time.as_nanos().saturating_add(MILLI / 2));
        let (week, time_of_week) = rounded.to_week();
        let time_of_week = time_of_week.div_euclid(MILLI) * MILLI;
        SbfStamp { time_of_week: Some(time_of_week), week: u16::try_from(week).ok() }
    }

    /// The instant, if week and time of week are known.
    #[must_use]
    pub fn gps(&self) -> Option<GpsTime> {
        gps_time(self.week?, self.time_of_week?)
    }

    /// The instant as far as it is known.
    #[must_use]
    pub fn epoch(&self) -> Option<EpochTime> {
        let gps = self.gps().map(EpochTime::Gps);
        gps.or(self.time_of_week.map(EpochTime::TimeOfWeek))
    }

    fn read(reader: &mut Reader<'_>) -> Result<Self, BinaryFault> {
        let (time_of_week, week) = (reader.le_u32()?, reader.le_u16()?);
        Ok(SbfStamp {
            time_of_week: (time_of_week < WEEK).then(|| i64::from(time_of_week) * MILLI),
            week: (week != u16::MAX).then_some(week),
        })
    }

    fn write(self, writer: &mut Writer) {
        let milliseconds = self.time_of_week.map(|nanos| nanos.div_euclid(MILLI));
        let milliseconds = milliseconds.and_then(|count| u32::try_from(count).ok());
        writer.le_u32(milliseconds.unwrap_or(u32::MAX)).le_u16(self.week.unwrap_or(u16::MAX));
    }
}

/// A reader behind the time stamp of a block that must have a certain number, and its revision.
pub(super) fn body(bytes: &[u8], id: u16) -> Result<(SbfStamp, Reader<'_>, u8), BinaryFault> {
    let frame = Frame::open(bytes)?;
    if frame.id != id {
        return Err(BinaryFault::OtherMessage);
    }
    let mut reader = Reader::new(frame.payload);
    Ok((SbfStamp::read(&mut reader)?, reader, frame.revision))
}

/// A writer that has written the time stamp.
pub(super) fn begun(stamp: SbfStamp) -> Writer {
    let mut writer = Writer::new();
    stamp.write(&mut writer);
    writer
}

/// The block of a payload.
pub(super) fn framed((id, revision): (u16, u8), payload: &Writer) -> Vec<u8> {
    Frame { id, revision, payload: payload.bytes() }.write()
}
