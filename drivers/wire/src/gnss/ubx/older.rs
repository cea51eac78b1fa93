//! NAV-POSLLH, NAV-VELNED, NAV-SOL, NAV-STATUS and NAV-TIMEUTC: an epoch of receivers that have no NAV-PVT.
//!
//! Layouts: u-blox 6 Receiver Description (GPS.G6-SW-10018) and u-blox 8 (UBX-13003221), compared with pyubx2 on logs of receivers.
//! NAV-POSLLH and NAV-VELNED do not tell whether there is a fix: NAV-SOL or NAV-STATUS does, and one of them must be sent besides.

use insd_base::units::DEG;
use insd_base::{FixQuality, Geodetic, GpsTime};

use super::field::epoch;
use super::frame::as_message;
use super::pvt::{Carrier, FixType, PvtTime};
use crate::gnss::{EpochTime, GnssPart, cartesian, gps_time};
use crate::layout::{Each, bit, bits, layout, le};
use crate::nmea::Date;

/// Class and id of NAV-POSLLH.
pub(super) const POSLLH: (u8, u8) = (0x01, 0x02);

/// Class and id of NAV-STATUS.
pub(super) const STATUS: (u8, u8) = (0x01, 0x03);

/// Class and id of NAV-SOL.
pub(super) const SOL: (u8, u8) = (0x01, 0x06);

/// Class and id of NAV-VELNED.
pub(super) const VELNED: (u8, u8) = (0x01, 0x12);

/// Class and id of NAV-TIMEUTC.
pub(super) const TIMEUTC: (u8, u8) = (0x01, 0x21);

/// Radians in one step of latitude and longitude.
const ANGLE: f64 = 1e-7 * DEG;

/// Radians in one step of a course.
const COURSE: f64 = 1e-5 * DEG;

layout! {
    /// NAV-POSLLH.
    NavPosLlh, 28 bytes;
    /// `iTOW`: time of the GPS week, whole milliseconds, in ns.
    0 time_of_week: i64 = le::<u32>().nanos(1_000_000);
    /// `lon`, rad.
    4 longitude: f64 = le::<i32>().steps(ANGLE).within(180.0 * DEG, "lon");
    /// `lat`, rad.
    8 latitude: f64 = le::<i32>().steps(ANGLE).within(90.0 * DEG, "lat");
    /// `height` above the ellipsoid, m.
    12 height: f64 = le::<i32>().steps(1e-3);
    /// `hMSL`: height above mean sea level, m.
    16 height_msl: f64 = le::<i32>().steps(1e-3);
    /// `hAcc`, m, as in NAV-PVT.
    20 horizontal_accuracy: Option<f64> = le::<u32>().unless(u32::MAX, 1e-3);
    /// `vAcc`, m.
    24 vertical_accuracy: Option<f64> = le::<u32>().unless(u32::MAX, 1e-3);
}
as_message!(NavPosLlh, POSLLH);

layout! {
    /// NAV-VELNED.
    NavVelNed, 36 bytes;
    /// `iTOW`: time of the GPS week, whole milliseconds, in ns.
    0 time_of_week: i64 = le::<u32>().nanos(1_000_000);
    /// `velN`, `velE`, `velD`, m/s.
    4 velocity: [f64; 3] = Each(le::<i32>().steps(1e-2));
    /// `speed`, m/s.
    16 speed: f64 = le::<u32>().steps(1e-2);
    /// `gSpeed`: over ground, m/s.
    20 ground_speed: f64 = le::<u32>().steps(1e-2);
    /// `heading`: course over ground, rad, as it stands.
    24 course: f64 = le::<i32>().steps(COURSE);
    /// `sAcc`, m/s, as in NAV-PVT.
    28 speed_accuracy: Option<f64> = le::<u32>().unless(u32::MAX, 1e-2);
    /// `cAcc`, rad.
    32 course_accuracy: Option<f64> = le::<u32>().unless(u32::MAX, COURSE);
}
as_message!(NavVelNed, VELNED);

layout! {
    /// NAV-SOL.
    NavSol, 52 bytes;
    /// `iTOW`: time of the GPS week, whole milliseconds, in ns.
    0 time_of_week: i64 = le::<u32>().nanos(1_000_000);
    /// `fTOW`: what is to be added, ns.
    4 fraction: i32 = le();
    /// `week`: all of it, without rollover.
    8 week: i16 = le();
    /// `gpsFix`.
    10 fix: FixType = le().codes(FixType::from_raw, |fix| fix.raw());
    /// `GPSfixOK`: within the masks for dilution and accuracy.
    11 fix_ok: bool = bit(0);
    /// `DiffSoln`.
    11 differential: bool = bit(1);
    /// `WKNSET`: the week is valid.
    11 week_valid: bool = bit(2);
    /// `TOWSET`: the time of week is valid.
    11 time_of_week_valid: bool = bit(3);
    /// `ecefX`, `ecefY`, `ecefZ`, m.
    12 position: [f64; 3] = Each(le::<i32>().steps(1e-2));
    /// `pAcc`: of the position in space, m.
    24 position_accuracy: Option<f64> = le::<u32>().unless(u32::MAX, 1e-2);
    /// `ecefVX`, `ecefVY`, `ecefVZ`, m/s.
    28 velocity: [f64; 3] = Each(le::<i32>().steps(1e-2));
    /// `sAcc`, m/s.
    40 speed_accuracy: Option<f64> = le::<u32>().unless(u32::MAX, 1e-2);
    /// `pDOP`.
    44 pdop: f64 = le::<u16>().steps(1e-2);
    /// `numSV`.
    47 satellites: u8 = le();
}
as_message!(NavSol, SOL);

layout! {
    /// NAV-STATUS.
    NavStatus, 16 bytes;
    /// `iTOW`: time of the GPS week, whole milliseconds, in ns.
    0 time_of_week: i64 = le::<u32>().nanos(1_000_000);
    /// `gpsFix`.
    4 fix: FixType = le().codes(FixType::from_raw, |fix| fix.raw());
    /// `gpsFixOk`: within the masks for dilution and accuracy.
    5 fix_ok: bool = bit(0);
    /// `diffSoln`.
    5 differential: bool = bit(1);
    /// `wknSet`: the week is valid.
    5 week_valid: bool = bit(2);
    /// `towSet`: the time of week is valid.
    5 time_of_week_valid: bool = bit(3);
    /// `spoofDetState`: 0 unknown or off, 1 none, 2 indicated, 3 indicated more than once.
    7 spoofing: u8 = bits(3, 2);
    /// `carrSoln`; zero on receivers older than generation 9.
    7 carrier: Carrier = bits(6, 2).codes(Carrier::of_raw, |carrier| carrier.raw());
    /// `ttff`: time to the first fix, ns.
    8 to_first_fix: i64 = le::<u32>().nanos(1_000_000);
    /// `msss`: since it was switched on, ns.
    12 since_start: i64 = le::<u32>().nanos(1_000_000);
}
as_message!(NavStatus, STATUS);

layout! {
    /// NAV-TIMEUTC.
    NavTimeUtc, 20 bytes;
    /// `iTOW`: time of the GPS week, whole milliseconds, in ns.
    0 time_of_week: i64 = le::<u32>().nanos(1_000_000);
    /// `tAcc`, s.
    4 accuracy: Option<f64> = le::<u32>().unless(u32::MAX, 1e-9);
    /// `nano`: what is to be added to the second, ns.
    8 nanosecond: i32 = le();
    /// `year`.
    12 year: u16 = le();
    /// `month`, `day`.
    14 month_day: [u8; 2] = Each(le());
    /// `hour`, `min`, `sec` (60 in a leap second).
    16 clock: [u8; 3] = Each(le());
    /// `validTOW`.
    19 time_of_week_valid: bool = bit(0);
    /// `validWKN`.
    19 week_valid: bool = bit(1);
    /// `validUTC`: leap seconds are known.
    19 valid: bool = bit(2);
    /// `utcStandard`: whose UTC.
    19 standard: u8 = bits(4, 4);
}
as_message!(NavTimeUtc, TIMEUTC);

impl NavPosLlh {
    /// What the message says of its epoch; the accuracies are shared out as in NAV-PVT. A receiver that knows no accuracy knows no place.
    #[must_use]
    pub fn part(&self) -> GnssPart {
        let component = self.horizontal_accuracy.map(|both| both / std::f64::consts::SQRT_2);
        let (latitude, longitude, height) = (self.latitude, self.longitude, self.height);
        GnssPart {
            kind: "NAV-POSLLH",
            epoch: epoch(self.time_of_week),
            position: component.map(|_| Geodetic { latitude, longitude, height }),
            position_std: component
                .map_or([None; 3], |own| [Some(own), Some(own), self.vertical_accuracy]),
            ..GnssPart::default()
        }
    }
}

impl NavVelNed {
    /// What the message says of its epoch; the accuracy as in NAV-PVT.
    #[must_use]
    pub fn part(&self) -> GnssPart {
        let known = self.speed_accuracy.is_some();
        GnssPart {
            kind: "NAV-VELNED",
            epoch: epoch(self.time_of_week),
            velocity: self.velocity.map(|component| known.then_some(component)),
            velocity_std: [self.speed_accuracy; 3],
            ..GnssPart::default()
        }
    }
}

impl NavSol {
    /// The instant, if week and time of week are valid.
    #[must_use]
    pub fn gps(&self) -> Option<GpsTime> {
        let known = self.time_of_week_valid && self.week_valid;
        let week = u16::try_from(self.week).ok().filter(|_| known)?;
        epoch(self.time_of_week)?;
        gps_time(week, self.time_of_week.saturating_add(self.fraction.into()))
    }

    /// What the receiver says of its fix.
    #[must_use]
    pub fn quality(&self) -> FixQuality {
        self.fix.quality(self.fix_ok, Carrier::None, self.differential)
    }

    /// What the message says of its epoch. Each component has the whole accuracy, which is never too little.
    #[must_use]
    pub fn part(&self) -> GnssPart {
        let quality = self.quality();
        let usable = self.fix.has_position() && self.position_accuracy.is_some();
        let place = cartesian::place(self.position).filter(|_| usable);
        let velocity = place.as_ref().map(|place| cartesian::velocity(place, self.velocity));
        let velocity = velocity.filter(|_| self.speed_accuracy.is_some());
        let std = |known: bool, own: Option<f64>| if known { [own; 3] } else { [None; 3] };
        GnssPart {
            kind: "NAV-SOL",
            epoch: self.gps().map(EpochTime::Gps).or_else(|| epoch(self.time_of_week)),
            position: place,
            position_std: std(place.is_some(), self.position_accuracy),
            velocity: velocity.map_or([None; 3], |velocity| velocity.map(Some)),
            velocity_std: std(velocity.is_some(), self.speed_accuracy),
            satellites: Some(self.satellites.into()),
            quality: Some(quality),
            invalid: quality == FixQuality::Invalid,
            ..GnssPart::default()
        }
    }
}

impl NavStatus {
    /// What the receiver says of its fix.
    #[must_use]
    pub fn quality(&self) -> FixQuality {
        self.fix.quality(self.fix_ok, self.carrier, self.differential)
    }

    /// What the message says of its epoch.
    #[must_use]
    pub fn part(&self) -> GnssPart {
        let quality = self.quality();
        GnssPart {
            kind: "NAV-STATUS",
            epoch: epoch(self.time_of_week),
            quality: Some(quality),
            invalid: quality == FixQuality::Invalid,
            ..GnssPart::default()
        }
    }
}

impl NavTimeUtc {
    /// Date and time of day, with the receiver's word on them.
    #[must_use]
    pub fn time(&self) -> PvtTime {
        let ([month, day], [hour, minute, second]) = (self.month_day, self.clock);
        PvtTime {
            date: Date { year: self.year, month, day },
            clock: (hour, minute, second),
            nanosecond: self.nanosecond,
            date_valid: self.week_valid,
            clock_valid: self.time_of_week_valid,
            resolved: self.valid,
            accuracy: self.accuracy,
        }
    }

    /// What the message says of its epoch.
    #[must_use]
    pub fn part(&self) -> GnssPart {
        GnssPart {
            kind: "NAV-TIMEUTC",
            epoch: self.time().epoch().or_else(|| epoch(self.time_of_week)),
            time_std: self.accuracy,
            ..GnssPart::default()
        }
    }
}
