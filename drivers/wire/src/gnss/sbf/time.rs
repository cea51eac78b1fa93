//! ReceiverTime and xPPSOffset: UTC, leap seconds, and the time of a pulse.
//!
//! Layout: PolaRx5TR Reference Guide 5.5.0, p. 424, and Septentrio's guide 4.10.1.

use super::field::{self, put_f32};
use super::frame::{SbfStamp, begun, body, framed};
use crate::binary::BinaryFault;
use crate::gnss::{EpochTime, GnssPart, PulseOrder, PulseTime};
use crate::nmea::{CivilTime, Date, TimeOfDay};

/// Number of ReceiverTime.
pub(super) const RECEIVER_TIME: u16 = 5914;

/// Number of xPPSOffset.
pub(super) const PULSE: u16 = 5911;

/// What ReceiverTime says instead of a number that is not known.
const UNKNOWN: i8 = -128;

/// ReceiverTime.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReceiverTime {
    /// When, by the receiver's clock, whole seconds.
    pub stamp: SbfStamp,
    /// `UTCYear` to `UTCSec`, the years 2000 to 2099.
    pub utc: Option<CivilTime>,
    /// `DeltaLS`: GPS - UTC, s.
    pub leap_seconds: Option<i8>,
    /// `SyncLevel`: bit 0 week set, bit 1 time of week set to 20 ms, bit 2 within the limit that the
    /// user has set.
    pub sync: u8,
}

impl ReceiverTime {
    /// Reads a block.
    ///
    /// # Errors
    /// What is wrong with the bytes.
    pub fn read(block: &[u8]) -> Result<Self, BinaryFault> {
        let (stamp, mut reader, _) = body(block, RECEIVER_TIME)?;
        let parts: [u8; 6] = reader.array()?;
        let (leap_seconds, sync) = (reader.i8()?, reader.u8()?);
        Ok(ReceiverTime {
            stamp,
            utc: civil(parts),
            leap_seconds: (leap_seconds != UNKNOWN).then_some(leap_seconds),
            sync,
        })
    }

    /// The block. UTC outside the years 2000 to 2099 can not be told.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let [unknown] = UNKNOWN.to_le_bytes();
        let parts = self.utc.and_then(|CivilTime { date, time }| {
            let year = date.year.checked_sub(2000).and_then(|year| u8::try_from(year).ok())?;
            let clock = [time.hour, time.minute, time.second];
            (year < 100).then_some([year, date.month, date.day, clock[0], clock[1], clock[2]])
        });
        let mut writer = begun(self.stamp);
        writer.put(&parts.unwrap_or([unknown; 6]));
        writer.put(&self.leap_seconds.unwrap_or(UNKNOWN).to_le_bytes()).u8(self.sync);
        framed((RECEIVER_TIME, 0), &writer)
    }

    /// What the message says of its epoch: nothing of the time before week and time of week are set.
    #[must_use]
    pub fn part(&self) -> GnssPart {
        let synchronized = self.sync & 0b11 == 0b11;
        GnssPart {
            kind: "ReceiverTime",
            epoch: self.stamp.epoch().filter(|_| synchronized),
            leap_seconds: self.leap_seconds,
            ..GnssPart::default()
        }
    }
}

/// Date and time of day of six numbers, if each is in its range.
fn civil([year, month, day, hour, minute, second]: [u8; 6]) -> Option<CivilTime> {
    let date = Date { year: 2000 + u16::from(year), month, day };
    let time = TimeOfDay { hour, minute, second, nanosecond: 0 };
    (year < 100 && date.is_valid() && time.is_valid()).then_some(CivilTime { date, time })
}

/// xPPSOffset: sent right after each pulse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct XppsOffset {
    /// The instant that the pulse marks.
    pub stamp: SbfStamp,
    /// `SyncAge`: since the pulse was last set by satellites, s, at most 255.
    pub age: u8,
    /// `TimeScale` whose second the pulse marks: 1 GPS, 2 UTC, 3 receiver, 4 GLONASS, 5 Galileo,
    /// 6 `BeiDou`.
    pub scale: u8,
    /// `Offset`: how late the pulse was, s; negative if it came early.
    pub offset: Option<f64>,
}

impl XppsOffset {
    /// Reads a block.
    ///
    /// # Errors
    /// What is wrong with the bytes.
    pub fn read(block: &[u8]) -> Result<Self, BinaryFault> {
        let (stamp, mut reader, _) = body(block, PULSE)?;
        let [age, scale] = reader.array()?;
        let offset = field::f32(&mut reader)?.map(|nanos| f64::from(nanos) * 1e-9);
        Ok(XppsOffset { stamp, age, scale, offset })
    }

    /// The block.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let mut writer = begun(self.stamp);
        writer.u8(self.age).u8(self.scale);
        put_f32(&mut writer, self.offset.map(|seconds| (seconds / 1e-9) as f32));
        framed((PULSE, 0), &writer)
    }

    /// When the last pulse was: the stamp counts GPS time whatever second the pulse marks. That it is
    /// the pulse's own time is from Septentrio's documentation of the `PolaRx2`.
    #[must_use]
    pub fn pulse(&self) -> Option<PulseTime> {
        let instant = EpochTime::Gps(self.stamp.gps()?);
        Some(PulseTime { kind: "xPPSOffset", instant, order: PulseOrder::Last })
    }
}
