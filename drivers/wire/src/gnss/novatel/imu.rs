//! RAWIMU, RAWIMUS, RAWIMUX and RAWIMUSX: increments of a SPAN system's IMU.
//!
//! The logs without X do not tell which IMU it is and with that nothing of its units. Units: table "Raw IMU Scale Factors" of the
//! manual, compared with the maker's `novatel_oem7_driver` (MIT). The published sample of an Epson G320N senses gravity by them.

use insd_base::GpsTime;
use insd_base::units::DEG;

use super::as_body;
use crate::gnss::gps_time;
use crate::imu::{DeviceTime, ImuMotion, ImuReading, Wrapping};
use crate::layout::{Each, bit, layout, le};

/// Nanoseconds of a week.
const WEEK: f64 = 604_800e9;

/// Standard gravity, m/s^2.
const G: f64 = 9.806_65;

/// Metres of a foot.
const FOOT: f64 = 0.3048;

layout! {
    /// RAWIMU and RAWIMUS.
    RawImu, 40 bytes;
    /// GPS week, without rollover.
    0 week: u32 = le();
    /// Time of the week, s.
    4 time_of_week: Option<f64> = le::<f64>().unless(f64::NAN, 1.0);
    /// Status word of the IMU.
    12 status: u32 = le();
    /// Increments of velocity along z, against y, along x, counts.
    16 push: [i32; 3] = Each(le());
    /// Increments of angle about z, against y, about x, counts.
    28 turn: [i32; 3] = Each(le());
}
as_body!(RawImu);

layout! {
    /// RAWIMUX and RAWIMUSX.
    RawImuX, 40 bytes;
    /// The IMU has an error.
    0 error: bool = bit(0);
    /// The data are encrypted.
    0 encrypted: bool = bit(1);
    /// Whether the IMU was found out (bit 2).
    0 known: bool = bit(2);
    /// Type of the IMU: 41 Epson G320N.
    1 kind: u8 = le();
    /// GPS week, without rollover.
    2 week: u16 = le();
    /// Time of the week, s.
    4 time_of_week: Option<f64> = le::<f64>().unless(f64::NAN, 1.0);
    /// Status word of the IMU.
    12 status: u32 = le();
    /// Increments of velocity along z, against y, along x, counts.
    16 push: [i32; 3] = Each(le());
    /// Increments of angle about z, against y, about x, counts.
    28 turn: [i32; 3] = Each(le());
}
as_body!(RawImuX);

/// What a count of an IMU is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImuScale {
    /// Of angle, rad.
    pub angle: f64,
    /// Of velocity, m/s.
    pub velocity: f64,
}

impl ImuScale {
    /// By the number of an IMU's type; `None` of one that is not known.
    #[must_use]
    pub fn of_type(kind: u8) -> Option<Self> {
        let power = |exponent: i32| f64::from(exponent).exp2();
        let epson = |angle: f64, milli_g: f64, rate: f64| {
            (angle * DEG * power(-16) / rate, milli_g * 1e-3 * G * power(-16) / rate)
        };
        let (angle, velocity) = match kind {
            // HG1700 AG11 and AG58, HG1900 CA29 and CA50, HG1930 AA99 and CA50
            1 | 5 | 11 | 20 | 27 | 28 => (power(-33), FOOT * power(-27)),
            // HG1700 AG17 and AG62
            4 | 12 => (power(-33), FOOT * power(-26)),
            // LN-200
            8 => (power(-19), power(-14)),
            // iIMU-FSAS
            13 => (0.1 / 3600.0 * DEG * power(-8), 0.05 * power(-15)),
            // ISA-100C, µIMU
            26 | 52 => (1e-9, 2e-8),
            // ADIS16488
            31 => (720.0 * DEG * power(-31), 200.0 * power(-31)),
            // STIM300
            32 | 56 => (DEG * power(-21), power(-22)),
            // G320N at 125 and at 200 Hz
            41 => epson(0.008, 0.2, 125.0),
            62 => epson(0.008, 0.2, 200.0),
            // HG4930
            58 | 68 | 69 => (power(-33), power(-29)),
            // G370N
            61 => epson(0.015_151_5, 0.4, 200.0),
            _ => return None,
        };
        Some(ImuScale { angle, velocity })
    }

    /// Increments along x, y and z of counts along z, against y, along x.
    fn motion(&self, push: [i32; 3], turn: [i32; 3]) -> ImuMotion {
        let along = |[z, y, x]: [i32; 3], unit: f64| {
            [f64::from(x) * unit, 0.0 - f64::from(y) * unit, f64::from(z) * unit]
        };
        ImuMotion::Increments {
            delta_theta: along(turn, self.angle),
            delta_velocity: along(push, self.velocity),
        }
    }
}

impl RawImuX {
    /// The sample, if the IMU is one that is known.
    #[must_use]
    pub fn reading(&self) -> Option<ImuReading> {
        let motion = ImuScale::of_type(self.kind)?.motion(self.push, self.turn);
        let nanos = self.time_of_week.map(|seconds| (seconds * 1e9).round());
        let nanos = nanos.filter(|nanos| (0.0..WEEK).contains(nanos));
        let time = nanos.and_then(|nanos| gps_time(self.week, nanos as i64));
        let ticks = |nanos: f64| Wrapping { value: nanos as u64, modulus: WEEK as u64 };
        Some(ImuReading {
            device_time: nanos.map(|nanos| DeviceTime { ticks: ticks(nanos), tick: 1e-9 }),
            utc: time.map(|time: GpsTime| time.to_utc(None)),
            valid: !self.error && !self.encrypted,
            status: self.status,
            ..ImuReading::bare(motion)
        })
    }
}
