//! NAV-TIMEGPS, NAV-TIMELS and TIM-TP: the receiver's time, leap seconds, and the time of a pulse.
//!
//! Layouts: u-blox ZED-F9P Interface Description (UBX-18010854) and, for the bits of TIM-TP, pyubx2.

use insd_base::{GpsTime, Span, UtcTime};

use super::field::{accuracy, accuracy_raw, bit, epoch, milliseconds, time_of_week};
use super::frame::{Frame, framed};
use crate::binary::{BinaryFault, Reader, Writer};
use crate::gnss::{EpochTime, GnssPart, PulseOrder, PulseTime, gps_time};

/// Class and id of NAV-TIMEGPS.
pub(super) const TIME_GPS: (u8, u8) = (0x01, 0x20);

/// Class and id of NAV-TIMELS.
pub(super) const TIME_LS: (u8, u8) = (0x01, 0x26);

/// Class and id of TIM-TP.
pub(super) const TIM_TP: (u8, u8) = (0x0D, 0x01);

/// Nanoseconds of a week.
const WEEK: i64 = 604_800_000_000_000;

/// NAV-TIMEGPS: GPS time of an epoch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NavTimeGps {
    /// `iTOW`: time of the GPS week, whole milliseconds, in ns.
    pub time_of_week: i64,
    /// `fTOW`: what is to be added, ns.
    pub fraction: i32,
    /// `week`: all of it, without rollover.
    pub week: i16,
    /// `leapS`: GPS - UTC, s; `None` unless `leapSValid`.
    pub leap_seconds: Option<i8>,
    /// `towValid`.
    pub time_of_week_valid: bool,
    /// `weekValid`.
    pub week_valid: bool,
    /// `tAcc`, s.
    pub accuracy: Option<f64>,
}

impl NavTimeGps {
    /// Reads a frame.
    ///
    /// # Errors
    /// What is wrong with the bytes.
    pub fn read(frame: &[u8]) -> Result<Self, BinaryFault> {
        let mut reader = Reader::new(Frame::payload_of(frame, TIME_GPS)?);
        let time_of_week = time_of_week(&mut reader)?;
        let (fraction, week) = (reader.le_i32()?, reader.le_i16()?);
        let (leap_seconds, valid) = (reader.i8()?, reader.u8()?);
        Ok(NavTimeGps {
            time_of_week,
            fraction,
            week,
            leap_seconds: bit(valid, 2).then_some(leap_seconds),
            time_of_week_valid: bit(valid, 0),
            week_valid: bit(valid, 1),
            accuracy: accuracy(reader.le_u32()?, 1e-9),
        })
    }

    /// The frame.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let mut writer = Writer::new();
        let valid = u8::from(self.time_of_week_valid)
            | u8::from(self.week_valid) << 1
            | u8::from(self.leap_seconds.is_some()) << 2;
        writer.le_u32(milliseconds(self.time_of_week)).le_i32(self.fraction).le_i16(self.week);
        writer.put(&self.leap_seconds.unwrap_or_default().to_le_bytes()).u8(valid);
        writer.le_u32(accuracy_raw(self.accuracy, 1e-9));
        framed(TIME_GPS, &writer)
    }

    /// The instant, if week and time of week are valid.
    #[must_use]
    pub fn gps(&self) -> Option<GpsTime> {
        let known = self.time_of_week_valid && self.week_valid;
        let week = u16::try_from(self.week).ok().filter(|_| known)?;
        let of_week = (0..WEEK).contains(&self.time_of_week).then_some(self.time_of_week)?;
        gps_time(week, of_week.saturating_add(self.fraction.into()))
    }

    /// What the message says of its epoch.
    #[must_use]
    pub fn part(&self) -> GnssPart {
        GnssPart {
            kind: "NAV-TIMEGPS",
            epoch: self.gps().map(EpochTime::Gps).or_else(|| epoch(self.time_of_week)),
            leap_seconds: self.leap_seconds,
            time_std: self.accuracy,
            ..GnssPart::default()
        }
    }
}

/// A change of the leap seconds, to come or the last one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LeapEvent {
    /// `lsChange`: 1, 0 (none scheduled) or -1 s.
    pub change: i8,
    /// `srcOfLsChange`: who says so.
    pub source: u8,
    /// `timeToLsEvent`: until it, s; negative once it has passed.
    pub wait: i32,
    /// `dateOfLsGpsWn`: GPS week.
    pub week: u16,
    /// `dateOfLsGpsDn`: day of that week, 1 = Sunday; at its end the event is.
    pub day: u16,
}

/// NAV-TIMELS: leap seconds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NavTimeLs {
    /// `iTOW`: time of the GPS week, whole milliseconds, in ns.
    pub time_of_week: i64,
    /// `currLs`: GPS - UTC, s; `None` unless `validCurrLs`.
    pub leap_seconds: Option<i8>,
    /// `srcOfCurrLs`: who says so. 0 is the firmware's own table, which may be out of date.
    pub source: u8,
    /// The next or last change; `None` unless `validTimeToLsEvent`.
    pub event: Option<LeapEvent>,
}

impl NavTimeLs {
    /// Reads a frame of version 0.
    ///
    /// # Errors
    /// What is wrong with the bytes.
    pub fn read(frame: &[u8]) -> Result<Self, BinaryFault> {
        let mut reader = Reader::new(Frame::payload_of(frame, TIME_LS)?);
        let time_of_week = time_of_week(&mut reader)?;
        let [version, _, _, _] = reader.array()?;
        if version != 0 {
            return Err(BinaryFault::Range { field: "version" });
        }
        let (source, leap_seconds) = (reader.u8()?, reader.i8()?);
        let (event_source, change) = (reader.u8()?, reader.i8()?);
        let (wait, week, day) = (reader.le_i32()?, reader.le_u16()?, reader.le_u16()?);
        let event = LeapEvent { change, source: event_source, wait, week, day };
        let [_, _, _, valid] = reader.array()?;
        Ok(NavTimeLs {
            time_of_week,
            leap_seconds: bit(valid, 0).then_some(leap_seconds),
            source,
            event: bit(valid, 1).then_some(event),
        })
    }

    /// The frame.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let nothing = LeapEvent { change: 0, source: 0, wait: 0, week: 0, day: 0 };
        let event = self.event.unwrap_or(nothing);
        let valid = u8::from(self.leap_seconds.is_some()) | u8::from(self.event.is_some()) << 1;
        let [leap_seconds] = self.leap_seconds.unwrap_or_default().to_le_bytes();
        let [change] = event.change.to_le_bytes();
        let mut writer = Writer::new();
        writer.le_u32(milliseconds(self.time_of_week)).put(&[0; 4]);
        writer.u8(self.source).u8(leap_seconds).u8(event.source).u8(change);
        writer.le_i32(event.wait).le_u16(event.week).le_u16(event.day);
        writer.put(&[0, 0, 0, valid]);
        framed(TIME_LS, &writer)
    }

    /// What the message says of its epoch. Leap seconds from the firmware's own table, or from nobody
    /// knows where (255), are not passed on.
    #[must_use]
    pub fn part(&self) -> GnssPart {
        let told = !matches!(self.source, 0 | 255);
        GnssPart {
            kind: "NAV-TIMELS",
            epoch: epoch(self.time_of_week),
            leap_seconds: self.leap_seconds.filter(|_| told),
            ..GnssPart::default()
        }
    }
}

/// TIM-TP: when the next pulse will be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimTp {
    /// `towMS`: time of the week of the time base, whole milliseconds, in ns.
    pub time_of_week: i64,
    /// `towSubMS`: what is to be added, s.
    pub fraction: f64,
    /// `qErr`: quantization error of the pulse, s, with the receiver's sign; `None` if it is marked
    /// invalid. Receivers older than generation 9 do not mark it.
    pub quantization: Option<f64>,
    /// `week` of the time base.
    pub week: u16,
    /// `timeBase`: UTC, and not the time of a satellite system.
    pub utc_base: bool,
    /// `utc`: whether UTC is available.
    pub utc_available: bool,
    /// `raim`: 0 no information, 1 not active, 2 active.
    pub raim: u8,
    /// `timeRefGnss`: 0 GPS, 1 GLONASS, 2 `BeiDou`, 3 Galileo, 15 unknown.
    pub system: u8,
    /// `utcStandard`: whose UTC.
    pub utc_standard: u8,
}

impl TimTp {
    /// Reads a frame.
    ///
    /// # Errors
    /// What is wrong with the bytes.
    pub fn read(frame: &[u8]) -> Result<Self, BinaryFault> {
        let mut reader = Reader::new(Frame::payload_of(frame, TIM_TP)?);
        let time_of_week = time_of_week(&mut reader)?;
        let fraction = f64::from(reader.le_u32()?) * SUB_MILLISECOND;
        let quantization = f64::from(reader.le_i32()?) * 1e-12;
        let week = reader.le_u16()?;
        let [flags, reference] = reader.array()?;
        Ok(TimTp {
            time_of_week,
            fraction,
            quantization: (!bit(flags, 4)).then_some(quantization),
            week,
            utc_base: bit(flags, 0),
            utc_available: bit(flags, 1),
            raim: flags >> 2 & 3,
            system: reference & 15,
            utc_standard: reference >> 4,
        })
    }

    /// The frame.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let flags = u8::from(self.utc_base)
            | u8::from(self.utc_available) << 1
            | (self.raim & 3) << 2
            | u8::from(self.quantization.is_none()) << 4;
        let mut writer = Writer::new();
        writer.le_u32(milliseconds(self.time_of_week));
        writer.le_u32((self.fraction / SUB_MILLISECOND).round() as u32);
        writer.le_i32((self.quantization.unwrap_or_default() / 1e-12).round() as i32);
        writer.le_u16(self.week).u8(flags).u8(self.utc_standard << 4 | self.system & 15);
        framed(TIM_TP, &writer)
    }

    /// When the next pulse will be, to the nanosecond. `None` if the time base is UTC and UTC is not
    /// available, or if it is the time of another system than GPS, whose weeks the document does not
    /// define.
    #[must_use]
    pub fn pulse(&self) -> Option<PulseTime> {
        let fraction = Span::from_seconds(self.fraction).as_nanos();
        let of_week = self.time_of_week.checked_add(fraction);
        let of_week = of_week.filter(|_| (0..WEEK).contains(&self.time_of_week))?;
        let counted = gps_time(self.week, of_week)?;
        let instant = match (self.utc_base, self.utc_available, self.system) {
            (true, true, _) => EpochTime::Utc(as_utc(counted)),
            (false, _, 0) => EpochTime::Gps(counted),
            _ => return None,
        };
        Some(PulseTime { kind: "TIM-TP", instant, order: PulseOrder::Next })
    }
}

/// Seconds in one step of `towSubMS`.
const SUB_MILLISECOND: f64 = 1e-3 / 4_294_967_296.0;

/// UTC that is written as week and time of week: the same count from 1980, leap seconds left out.
fn as_utc(counted: GpsTime) -> UtcTime {
    counted.to_utc(Some(0))
}
