//! BESTPOS, BESTGNSSPOS, BESTVEL, BESTGNSSVEL and TIME: an epoch of the receiver.

use insd_base::units::DEG;
use insd_base::{FixQuality, Geodetic};

use super::as_body;
use crate::gnss::GnssPart;
use crate::layout::{Each, layout, le};

layout! {
    /// BESTPOS and BESTGNSSPOS.
    BestPosition, 72 bytes;
    /// Solution status: 0 computed, else why not.
    0 status: u32 = le();
    /// Position type: 16 single, 50 fixed narrow lanes.
    4 kind: u32 = le();
    /// Latitude, rad.
    8 latitude: f64 = le::<f64>().steps(DEG).within(90.0 * DEG, "lat");
    /// Longitude, rad.
    16 longitude: f64 = le::<f64>().steps(DEG).within(180.0 * DEG, "lon");
    /// Height above mean sea level, m.
    24 height_msl: Option<f64> = le::<f64>().unless(f64::NAN, 1.0);
    /// Height of the geoid above the ellipsoid, m.
    32 undulation: Option<f64> = le::<f32>().unless(f32::NAN, 1.0);
    /// Datum: 61 WGS 84.
    36 datum: u32 = le();
    /// 1-sigma of latitude, longitude and height, m.
    40 std: [Option<f64>; 3] = Each(le::<f32>().unless(f32::NAN, 1.0));
    /// Characters of the base's number.
    52 base: [u8; 4] = Each(le());
    /// Age of corrections, s.
    56 correction_age: Option<f64> = le::<f32>().unless(f32::NAN, 1.0);
    /// Age of the solution, s.
    60 age: Option<f64> = le::<f32>().unless(f32::NAN, 1.0);
    /// Satellites tracked.
    64 tracked: u8 = le();
    /// Satellites used.
    65 satellites: u8 = le();
}
as_body!(BestPosition);

layout! {
    /// BESTVEL and BESTGNSSVEL.
    BestVelocity, 44 bytes;
    /// Solution status: 0 computed, else why not.
    0 status: u32 = le();
    /// Velocity type, as of positions: 8 by instantaneous Doppler shift.
    4 kind: u32 = le();
    /// By how much the velocity is older than its time tag, s.
    8 latency: Option<f64> = le::<f32>().unless(f32::NAN, 1.0);
    /// Age of corrections, s.
    12 correction_age: Option<f64> = le::<f32>().unless(f32::NAN, 1.0);
    /// Speed over ground, m/s.
    16 ground_speed: Option<f64> = le::<f64>().unless(f64::NAN, 1.0);
    /// Course over ground, rad from true north.
    24 course: Option<f64> = le::<f64>().unless(f64::NAN, DEG);
    /// Vertical speed, m/s, **up** positive.
    32 climb: Option<f64> = le::<f64>().unless(f64::NAN, 1.0);
}
as_body!(BestVelocity);

layout! {
    /// TIME.
    ReceiverClock, 44 bytes;
    /// Status of the clock model: 0 valid.
    0 status: u32 = le();
    /// Receiver clock less GPS time, s.
    4 offset: Option<f64> = le::<f64>().unless(f64::NAN, 1.0);
    /// 1-sigma of the offset, s.
    12 offset_std: Option<f64> = le::<f64>().unless(f64::NAN, 1.0);
    /// UTC less GPS time, s.
    20 utc_offset: Option<f64> = le::<f64>().unless(f64::NAN, 1.0);
    /// Year of UTC.
    28 year: u32 = le();
    /// Month, day, hour and minute of UTC.
    32 civil: [u8; 4] = Each(le());
    /// Milliseconds of the minute, 60000 to 60999 in a leap second.
    36 milliseconds: u32 = le();
    /// Status of UTC: 0 invalid, 1 valid, 2 by leap seconds of the almanac's default.
    40 utc_status: u32 = le();
}
as_body!(ReceiverClock);

/// Whether a solution comes of the receiver's own inertial filter.
fn is_inertial(kind: u32) -> bool {
    matches!(kind, 51..=59 | 73 | 74 | 76 | 79 | 80)
}

/// What a receiver says of its fix by solution status and type.
pub(super) fn quality(status: u32, kind: u32) -> FixQuality {
    match kind {
        _ if status != 0 => FixQuality::Invalid,
        8 | 16 => FixQuality::Autonomous,
        17 | 18 | 20 | 64..=66 | 68..=71 | 75 | 77 | 78 => FixQuality::Differential,
        4 | 32..=35 => FixQuality::RtkFloat,
        5 | 6 | 46..=50 => FixQuality::RtkFixed,
        1 => FixQuality::Manual,
        19 | 67 => FixQuality::Estimated,
        kind if is_inertial(kind) => FixQuality::Estimated,
        _ => FixQuality::Invalid,
    }
}

impl BestPosition {
    /// Whether the place comes of the receiver's own inertial filter.
    #[must_use]
    pub fn is_inertial(&self) -> bool {
        is_inertial(self.kind)
    }

    /// What it says of its epoch; nothing if it is inertial. Heights are taken above the ellipsoid.
    pub(super) fn part(&self) -> Option<GnssPart> {
        let quality = quality(self.status, self.kind);
        let usable = quality != FixQuality::Invalid;
        let height = self.height_msl.zip(self.undulation).map(|(height, geoid)| height + geoid);
        let (latitude, longitude) = (self.latitude, self.longitude);
        let place = height.map(|height| Geodetic { latitude, longitude, height });
        let std = self.std.map(|std| std.filter(|std| *std > 0.0 && usable));
        (!self.is_inertial()).then(|| GnssPart {
            position: place.filter(|_| usable),
            position_std: if place.is_some() { std } else { [None; 3] },
            satellites: Some(self.satellites.into()),
            quality: Some(quality),
            invalid: !usable,
            ..GnssPart::default()
        })
    }
}

impl BestVelocity {
    /// What it says of its epoch; nothing if it is inertial. Its latency is not taken off, so that it stays with the place of its epoch.
    pub(super) fn part(&self) -> Option<GnssPart> {
        let usable = quality(self.status, self.kind) != FixQuality::Invalid;
        let level = self.ground_speed.zip(self.course).filter(|_| usable);
        let (north, east) = level.map(|(speed, at)| (speed * at.cos(), speed * at.sin())).unzip();
        let down = self.climb.filter(|_| usable).map(|climb| 0.0 - climb);
        let velocity = [north, east, down];
        (!is_inertial(self.kind)).then(|| GnssPart { velocity, ..GnssPart::default() })
    }
}

impl ReceiverClock {
    /// GPS - UTC, s, as the receiver has it of satellites.
    #[must_use]
    pub fn leap_seconds(&self) -> Option<i8> {
        let told = self.utc_offset.filter(|offset| self.utc_status == 1 && offset.abs() < 100.0);
        told.map(|offset| (-offset).round() as i8)
    }

    /// What it says of its epoch.
    pub(super) fn part(&self) -> GnssPart {
        GnssPart {
            leap_seconds: self.leap_seconds(),
            time_std: self.offset_std.filter(|std| self.status == 0 && *std >= 0.0),
            ..GnssPart::default()
        }
    }
}
