//! The records of a report that are read, big endian.

use insd_base::units::wrap_two_pi;
use insd_base::{FixQuality, Geodetic};

use crate::gnss::{EpochTime, GnssPart, gps_time};
use crate::layout::{Each, be, layout, le};

/// Nanoseconds of a millisecond.
const MILLI: i64 = 1_000_000;

/// Milliseconds of a week.
const WEEK: u32 = 604_800_000;

/// GPS - UTC that is believed, s.
const LEAPS: std::ops::RangeInclusive<i16> = 0..=100;

layout! {
    /// Record 1: when the position was, and of which kind it is.
    PositionTime, 10 bytes;
    /// Time of the GPS week, ms.
    0 milliseconds: u32 = be();
    /// GPS week, without rollover.
    4 week: u16 = be();
    /// Satellites used.
    6 satellites: u8 = le();
    /// Bit 0 a new position, 1 clock, 2 horizontal place and 3 height calculated, 5 by least squares, 7 by smoothed L1 ranges.
    7 calculated: u8 = le();
    /// Bit 0 differential, 1 of phases, 2 fixed integers (SBAS if bit 0 is not set), 3 OmniSTAR, 4 static, 5 network, 6 RTK without its
    /// full accuracy, 7 beacon.
    8 corrected: u8 = le();
    /// Number of the last initialisation.
    9 initialisation: u8 = le();
}

layout! {
    /// Record 2: where the antenna is.
    Place, 24 bytes;
    /// Latitude, rad.
    0 latitude: f64 = be::<f64>().steps(1.0).within(std::f64::consts::FRAC_PI_2, "LATITUDE");
    /// Longitude, rad.
    8 longitude: f64 = be::<f64>().steps(1.0).within(std::f64::consts::PI, "LONGITUDE");
    /// Height above the ellipsoid, m.
    16 height: Option<f64> = be::<f64>().unless(f64::NAN, 1.0);
}

layout! {
    /// Record 8: how the antenna moves. A local heading behind it, which is told where a local grid is loaded, is not read.
    Movement, 13 bytes;
    /// Bit 0 valid, 1 from consecutive positions and not by Doppler shift, 2 heading valid (newer receivers).
    0 flags: u8 = le();
    /// Speed over ground, m/s.
    1 speed: Option<f64> = be::<f32>().unless(f32::NAN, 1.0);
    /// Course over ground, rad from true north.
    5 course: Option<f64> = be::<f32>().unless(f32::NAN, 1.0);
    /// Vertical velocity, m/s, **up** positive.
    9 climb: Option<f64> = be::<f32>().unless(f32::NAN, 1.0);
}

layout! {
    /// Record 9: dilutions of precision: of position, horizontal, vertical, of time.
    Dilutions, 16 bytes;
    /// All four.
    0 dilutions: [Option<f64>; 4] = Each(be::<f32>().unless(f32::NAN, 1.0));
}

layout! {
    /// Record 12: how well the position is known.
    PositionSigma, 38 bytes;
    /// Root mean square of the ranges' residuals.
    0 rms: Option<f64> = be::<f32>().unless(f32::NAN, 1.0);
    /// 1-sigma to the east, m.
    4 east: Option<f64> = be::<f32>().unless(f32::NAN, 1.0);
    /// 1-sigma to the north, m.
    8 north: Option<f64> = be::<f32>().unless(f32::NAN, 1.0);
    /// Covariance of east and north, m^2.
    12 covariance: Option<f64> = be::<f32>().unless(f32::NAN, 1.0);
    /// 1-sigma upwards, m.
    16 up: Option<f64> = be::<f32>().unless(f32::NAN, 1.0);
    /// Semi-major and semi-minor axis of the error ellipse, m; direction of the first, deg.
    20 ellipse: [Option<f64>; 3] = Each(be::<f32>().unless(f32::NAN, 1.0));
    /// Unit variance.
    32 unit_variance: Option<f64> = be::<f32>().unless(f32::NAN, 1.0);
    /// Epochs that it is made of.
    36 epochs: u16 = be();
}

layout! {
    /// Record 16: the time now, which is not that of the position.
    CurrentTime, 9 bytes;
    /// Time of the GPS week, ms.
    0 milliseconds: u32 = be();
    /// GPS week, without rollover.
    4 week: u16 = be();
    /// GPS - UTC, s.
    6 utc_offset: i16 = be();
    /// Bit 0 the time is valid, 1 the offset is.
    8 flags: u8 = le();
}

layout! {
    /// Record 27: the line from one antenna of the ship to another.
    AntennaLine, 42 bytes;
    /// Time of the GPS week, ms.
    0 milliseconds: u32 = be();
    /// Bit 0 calibrated, 1 pitch, 2 yaw, 3 roll, 4 length valid.
    4 flags: u8 = le();
    /// Satellites used.
    5 satellites: u8 = le();
    /// 0 none, 1 autonomous, 2 float, 3 fixed, 4 by code differences.
    6 mode: u8 = le();
    /// Pitch, yaw from true north, and roll, rad, as they stand.
    8 angles: [Option<f64>; 3] = Each(be::<f64>().unless(f64::NAN, 1.0));
    /// Length of the line, m.
    32 length: Option<f64> = be::<f64>().unless(f64::NAN, 1.0);
    /// Dilution of precision, tenths.
    40 dilution: u16 = be();
}

layout! {
    /// What newer receivers have behind record 27.
    LineVariances, 28 bytes;
    /// Variances of pitch, yaw and roll, rad^2; covariances of pitch and yaw, pitch and roll, yaw and roll; variance of the length, m^2.
    0 variances: [Option<f64>; 7] = Each(be::<f32>().unless(f32::NAN, 1.0));
}

/// One record.
#[derive(Clone, Debug, PartialEq)]
pub enum GsofRecord {
    /// 1.
    Time(PositionTime),
    /// 2.
    Place(Place),
    /// 8.
    Movement(Movement),
    /// 9.
    Dilutions(Dilutions),
    /// 12.
    Sigma(PositionSigma),
    /// 16.
    Now(CurrentTime),
    /// 27, its second part where the receiver tells it.
    Line(AntennaLine, Option<LineVariances>),
    /// A record that is not read here: its type and its bytes.
    Other(u8, Vec<u8>),
}

impl GsofRecord {
    pub(super) fn read(kind: u8, bytes: &[u8]) -> Result<Self, crate::binary::BinaryFault> {
        Ok(match kind {
            1 => GsofRecord::Time(PositionTime::read_fields(bytes)?),
            2 => GsofRecord::Place(Place::read_fields(bytes)?),
            8 => GsofRecord::Movement(Movement::read_fields(bytes)?),
            9 => GsofRecord::Dilutions(Dilutions::read_fields(bytes)?),
            12 => GsofRecord::Sigma(PositionSigma::read_fields(bytes)?),
            16 => GsofRecord::Now(CurrentTime::read_fields(bytes)?),
            27 => {
                let behind = bytes.get(42..).unwrap_or_default();
                let line = AntennaLine::read_fields(bytes)?;
                GsofRecord::Line(line, LineVariances::read_fields(behind).ok())
            }
            _ => GsofRecord::Other(kind, bytes.to_vec()),
        })
    }

    /// Its type and its bytes.
    pub(super) fn write(&self) -> (u8, Vec<u8>) {
        match self {
            GsofRecord::Time(record) => (1, record.write_fields()),
            GsofRecord::Place(record) => (2, record.write_fields()),
            GsofRecord::Movement(record) => (8, record.write_fields()),
            GsofRecord::Dilutions(record) => (9, record.write_fields()),
            GsofRecord::Sigma(record) => (12, record.write_fields()),
            GsofRecord::Now(record) => (16, record.write_fields()),
            GsofRecord::Line(record, behind) => {
                let behind = behind.map_or_else(Vec::new, |behind| behind.write_fields());
                (27, [record.write_fields(), behind].concat())
            }
            GsofRecord::Other(kind, bytes) => (*kind, bytes.clone()),
        }
    }

    /// Puts what it says of the report's epoch into what the others say.
    pub(super) fn tell(&self, part: &mut GnssPart) {
        match self {
            GsofRecord::Time(record) => record.tell(part),
            GsofRecord::Place(record) => {
                let (latitude, longitude) = (record.latitude, record.longitude);
                part.position =
                    record.height.map(|height| Geodetic { latitude, longitude, height });
            }
            GsofRecord::Movement(record) => part.velocity = record.velocity(),
            GsofRecord::Dilutions(record) => part.hdop = record.dilutions[1],
            GsofRecord::Sigma(record) => {
                let sigmas = [record.north, record.east, record.up];
                part.position_std = sigmas.map(|sigma| sigma.filter(|sigma| *sigma > 0.0));
            }
            GsofRecord::Now(record) => part.leap_seconds = record.leap_seconds(),
            GsofRecord::Line(..) | GsofRecord::Other(..) => {}
        }
    }
}

impl PositionTime {
    /// The instant; `None` if it is none.
    #[must_use]
    pub fn epoch(&self) -> Option<EpochTime> {
        let time = gps_time(self.week, i64::from(self.milliseconds) * MILLI)?;
        (self.milliseconds < WEEK).then_some(EpochTime::Gps(time))
    }

    /// What the receiver says of its fix: an old position is none.
    #[must_use]
    pub fn quality(&self) -> FixQuality {
        let has = |bits: u8| self.corrected & bits == bits;
        match (self.calculated & 0b101 == 0b101, has(0b001)) {
            (false, _) => FixQuality::Invalid,
            (true, false) if has(0b100) => FixQuality::Differential,
            (true, false) => FixQuality::Autonomous,
            (true, true) if has(0b110) => FixQuality::RtkFixed,
            (true, true) if has(0b010) => FixQuality::RtkFloat,
            (true, true) => FixQuality::Differential,
        }
    }

    fn tell(&self, part: &mut GnssPart) {
        let quality = self.quality();
        part.epoch = self.epoch();
        part.satellites = Some(self.satellites.into());
        part.quality = Some(quality);
        part.invalid = quality == FixQuality::Invalid;
    }

    /// Whether the height was calculated, and not held.
    #[must_use]
    pub fn has_height(&self) -> bool {
        self.calculated & 0b1000 != 0
    }
}

impl Movement {
    /// North, east and down, m/s.
    #[must_use]
    pub fn velocity(&self) -> [Option<f64>; 3] {
        let valid = self.flags & 1 != 0;
        let level = self.speed.zip(self.course).filter(|_| valid);
        let (north, east) = level.map(|(speed, at)| (speed * at.cos(), speed * at.sin())).unzip();
        [north, east, self.climb.filter(|_| valid).map(|climb| 0.0 - climb)]
    }
}

impl CurrentTime {
    /// GPS - UTC, s.
    #[must_use]
    pub fn leap_seconds(&self) -> Option<i8> {
        let told =
            (self.flags & 0b10 != 0 && LEAPS.contains(&self.utc_offset)).then_some(self.utc_offset);
        told.and_then(|offset| i8::try_from(offset).ok())
    }
}

impl AntennaLine {
    /// Direction of the line from true north, rad, where its integers are fixed: with float ambiguities it is wrong by more than is claimed.
    #[must_use]
    pub fn heading(&self) -> Option<f64> {
        let valid = self.flags & 0b100 != 0 && self.mode == 3;
        self.angles[1].filter(|_| valid).map(wrap_two_pi)
    }
}

impl LineVariances {
    /// 1-sigma of the direction, rad.
    #[must_use]
    pub fn heading_std(&self) -> Option<f64> {
        self.variances[1].filter(|variance| *variance > 0.0).map(f64::sqrt)
    }
}
