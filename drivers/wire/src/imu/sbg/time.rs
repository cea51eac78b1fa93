//! UTC_TIME: what the device's clock read at an instant of UTC, and how well it is known.

use insd_base::UtcTime;

use super::{UTC_TIME, appended, device_time, put_appended, seal};
use crate::binary::{BinaryFault, Reader, Writer};
use crate::imu::DeviceTime;
use crate::nmea::{CivilTime, Date, TimeOfDay};

const HAS_PPS: u16 = 1;
const ACCURATE: u16 = 1 << 5;
/// Nanoseconds in a millisecond.
const MILLISECOND: i64 = 1_000_000;

/// State of the device's clock.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ClockState {
    /// The estimation of the clock has failed.
    Error,
    /// On the crystal, with the last known corrections.
    FreeRunning,
    /// A pulse per second is there; the clock converges to it.
    Steering,
    /// Converged, or still accurate after the pulse was lost.
    Valid,
    /// A value that the protocol does not define.
    Other(u8),
}

/// What the device knows of UTC.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum UtcStatus {
    /// Nothing: date and time are defaults.
    Invalid,
    /// UTC with the leap seconds of the firmware, which may be outdated.
    NoLeapSecond,
    /// UTC with known leap seconds. From release 4 of the protocol on it stays so without GNSS.
    Initialized,
    /// A value that the protocol does not define.
    Other(u8),
}

/// UTC_TIME, 33 bytes (21 before release 4 of the protocol).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeReference {
    /// Microseconds since power-up.
    pub time_stamp: u32,
    /// Whether a pulse per second comes in.
    pub has_pps: bool,
    /// State of the device's clock.
    pub clock: ClockState,
    /// Whether UTC is aligned with the pulse.
    pub accurate: bool,
    /// What the device knows of UTC.
    pub utc_status: UtcStatus,
    /// Date and time of day, UTC, as on the wire; see [`TimeReference::utc`].
    pub civil: CivilTime,
    /// Time of the GPS week, ns, in steps of a millisecond.
    pub gps_tow: i64,
    /// 1-sigma of the clock's bias, s.
    pub bias_std: Option<f64>,
    /// 1-sigma of the clock's scale factor, as a ratio; percent on the wire by the maker's document.
    pub scale_std: Option<f64>,
    /// Last difference of pulse and clock, s.
    pub residual: Option<f64>,
}

impl TimeReference {
    pub(super) fn parse(fields: &mut Reader<'_>) -> Result<Self, BinaryFault> {
        let time_stamp = fields.le_u32()?;
        let status = fields.le_u16()?;
        Ok(TimeReference {
            time_stamp,
            has_pps: status & HAS_PPS != 0,
            clock: ClockState::from_bits((status >> 1 & 0xF) as u8),
            accurate: status & ACCURATE != 0,
            utc_status: UtcStatus::from_bits((status >> 6 & 0xF) as u8),
            civil: civil(fields)?,
            gps_tow: i64::from(fields.le_u32()?) * MILLISECOND,
            bias_std: appended(fields),
            scale_std: appended(fields).map(|percent| percent / 100.0),
            residual: appended(fields),
        })
    }

    /// The whole frame.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let Date { year, month, day } = self.civil.date;
        let TimeOfDay { hour, minute, second, nanosecond } = self.civil.time;
        let tow = (self.gps_tow / MILLISECOND).clamp(0, u32::MAX.into()) as u32;
        let mut fields = Writer::new();
        fields.le_u32(self.time_stamp).le_u16(self.status()).le_u16(year);
        fields.put(&[month, day, hour, minute, second]).le_u32(nanosecond).le_u32(tow);
        put_appended(&mut fields, self.bias_std);
        put_appended(&mut fields, self.scale_std.map(|ratio| ratio * 100.0));
        put_appended(&mut fields, self.residual);
        seal(UTC_TIME, &fields)
    }

    fn status(&self) -> u16 {
        let flag = |set: bool, bit: u16| if set { bit } else { 0 };
        let clock = u16::from(self.clock.bits()) << 1;
        let utc = u16::from(self.utc_status.bits()) << 6;
        flag(self.has_pps, HAS_PPS) | clock | flag(self.accurate, ACCURATE) | utc
    }

    /// The device's clock at the instant.
    #[must_use]
    pub fn device_time(&self) -> DeviceTime {
        device_time(self.time_stamp)
    }

    /// UTC of the instant; `None` while the device does not know it to the second. Whether it is as
    /// good as a pulse per second makes it stands in [`TimeReference::accurate`].
    #[must_use]
    pub fn utc(&self) -> Option<UtcTime> {
        let known = self.utc_status == UtcStatus::Initialized && self.clock != ClockState::Error;
        self.civil.to_utc().filter(|_| known)
    }
}

fn civil(fields: &mut Reader<'_>) -> Result<CivilTime, BinaryFault> {
    let date = Date { year: fields.le_u16()?, month: fields.u8()?, day: fields.u8()? };
    let [hour, minute, second] = fields.array()?;
    let time = TimeOfDay { hour, minute, second, nanosecond: fields.le_u32()? };
    Ok(CivilTime { date, time })
}

impl ClockState {
    fn from_bits(bits: u8) -> Self {
        match bits {
            0 => ClockState::Error,
            1 => ClockState::FreeRunning,
            2 => ClockState::Steering,
            3 => ClockState::Valid,
            other => ClockState::Other(other),
        }
    }

    /// Four bits.
    fn bits(self) -> u8 {
        match self {
            ClockState::Error => 0,
            ClockState::FreeRunning => 1,
            ClockState::Steering => 2,
            ClockState::Valid => 3,
            ClockState::Other(other) => other & 0xF,
        }
    }
}

impl UtcStatus {
    fn from_bits(bits: u8) -> Self {
        match bits {
            0 => UtcStatus::Invalid,
            1 => UtcStatus::NoLeapSecond,
            2 => UtcStatus::Initialized,
            other => UtcStatus::Other(other),
        }
    }

    /// Four bits.
    fn bits(self) -> u8 {
        match self {
            UtcStatus::Invalid => 0,
            UtcStatus::NoLeapSecond => 1,
            UtcStatus::Initialized => 2,
            UtcStatus::Other(other) => other & 0xF,
        }
    }
}
