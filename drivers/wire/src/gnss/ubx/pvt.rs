//! NAV-PVT: position, velocity and time of an epoch.
//!
//! Layout: u-blox ZED-F9P Interface Description (UBX-18010854), 92 bytes. Receivers of generation 7
//! (GPS.G7-SW-12001) end after 84, without heading of the vehicle and magnetic declination.

use insd_base::units::wrap_two_pi;
use insd_base::{FixQuality, Geodetic, Span, UtcTime};

use super::field::{
    accuracy, accuracy_raw, bit, dilution, dilution_raw, epoch, milliseconds, position,
    put_position, signed, time_of_week,
};
use super::frame::{Frame, framed};
use crate::binary::{BinaryFault, Reader, Writer};
use crate::gnss::{EpochTime, GnssEpoch, GnssPart};
use crate::nmea::{CivilTime, Date, TimeOfDay};

/// Class and id.
pub(super) const NAME: (u8, u8) = (0x01, 0x07);

/// Radians in one step of a heading.
const HEADING: f64 = 1e-5 * insd_base::units::DEG;

/// Radians in one step of the declination.
const DECLINATION: f64 = 1e-2 * insd_base::units::DEG;

/// `fixType`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FixType {
    /// No fix (0).
    None,
    /// Dead reckoning only (1).
    DeadReckoning,
    /// Satellites, height held (2).
    TwoDimensional,
    /// Satellites (3).
    ThreeDimensional,
    /// Satellites and dead reckoning (4).
    Combined,
    /// Time only (5).
    TimeOnly,
    /// A value that the document does not define.
    Other(u8),
}

/// `carrSoln`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Carrier {
    /// No solution with carrier phase ranges (0).
    None,
    /// Float ambiguities (1).
    Float,
    /// Fixed ambiguities (2).
    Fixed,
    /// The value that the document does not define (3).
    Reserved,
}

/// Date and time of day with the receiver's word on them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PvtTime {
    /// `year`, `month`, `day`.
    pub date: Date,
    /// `hour`, `min`, `sec` (60 in a leap second).
    pub clock: (u8, u8, u8),
    /// `nano`: what is to be added, ns; negative if the second was rounded up.
    pub nanosecond: i32,
    /// `validDate`.
    pub date_valid: bool,
    /// `validTime`.
    pub clock_valid: bool,
    /// `fullyResolved`: no doubt about whole seconds.
    pub resolved: bool,
    /// `tAcc`, s.
    pub accuracy: Option<f64>,
}

/// NAV-PVT.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NavPvt {
    /// `iTOW`: time of the GPS week, whole milliseconds, in ns.
    pub time_of_week: i64,
    /// UTC.
    pub time: PvtTime,
    /// `fixType`.
    pub fix: FixType,
    /// `gnssFixOK`: within the masks for dilution and accuracy.
    pub fix_ok: bool,
    /// `diffSoln`.
    pub differential: bool,
    /// `carrSoln`.
    pub carrier: Carrier,
    /// `numSV`.
    pub satellites: u8,
    /// `lat`, `lon`, `height` above the ellipsoid; `None` if `invalidLlh` is set.
    pub position: Option<Geodetic>,
    /// `hMSL`: height above mean sea level, m.
    pub height_msl: f64,
    /// `hAcc`, m: root of the sum of the variances of north and east.
    pub horizontal_accuracy: Option<f64>,
    /// `vAcc`, m.
    pub vertical_accuracy: Option<f64>,
    /// `velN`, `velE`, `velD`, m/s.
    pub velocity: [f64; 3],
    /// `gSpeed`: over ground, m/s.
    pub ground_speed: f64,
    /// `headMot`: course over ground, rad.
    pub course: f64,
    /// `sAcc`, m/s.
    pub speed_accuracy: Option<f64>,
    /// `headAcc`: of course and heading, rad.
    pub heading_accuracy: Option<f64>,
    /// `pDOP`.
    pub pdop: Option<f64>,
    /// `headVeh`: true heading of the vehicle, rad; `None` unless `headVehValid`.
    pub heading: Option<f64>,
    /// `magDec` and `magAcc`, rad; `None` unless `validMag`.
    pub declination: Option<(f64, f64)>,
}

impl FixType {
    pub(super) fn from_raw(raw: u8) -> Self {
        match raw {
            0 => FixType::None,
            1 => FixType::DeadReckoning,
            2 => FixType::TwoDimensional,
            3 => FixType::ThreeDimensional,
            4 => FixType::Combined,
            5 => FixType::TimeOnly,
            other => FixType::Other(other),
        }
    }

    /// The value on the wire.
    #[must_use]
    pub fn raw(self) -> u8 {
        match self {
            FixType::None => 0,
            FixType::DeadReckoning => 1,
            FixType::TwoDimensional => 2,
            FixType::ThreeDimensional => 3,
            FixType::Combined => 4,
            FixType::TimeOnly => 5,
            FixType::Other(raw) => raw,
        }
    }

    /// Whether position and velocity mean anything.
    #[must_use]
    pub fn has_position(self) -> bool {
        matches!(
            self,
            FixType::DeadReckoning
                | FixType::TwoDimensional
                | FixType::ThreeDimensional
                | FixType::Combined
        )
    }

    /// What a receiver says of its fix by this, whether it is within its limits, and by what it was helped.
    pub(super) fn quality(self, is_ok: bool, carrier: Carrier, differential: bool) -> FixQuality {
        match (self, carrier) {
            _ if !is_ok || !self.has_position() => FixQuality::Invalid,
            (FixType::DeadReckoning, _) => FixQuality::Estimated,
            (_, Carrier::Fixed) => FixQuality::RtkFixed,
            (_, Carrier::Float) => FixQuality::RtkFloat,
            _ if differential => FixQuality::Differential,
            _ => FixQuality::Autonomous,
        }
    }
}

impl Carrier {
    /// By the value on the wire, two bits.
    pub(super) fn of_raw(raw: u8) -> Self {
        match raw {
            0 => Carrier::None,
            1 => Carrier::Float,
            2 => Carrier::Fixed,
            _ => Carrier::Reserved,
        }
    }

    /// The value on the wire.
    #[must_use]
    pub fn raw(self) -> u8 {
        match self {
            Carrier::None => 0,
            Carrier::Float => 1,
            Carrier::Fixed => 2,
            Carrier::Reserved => 3,
        }
    }
}

impl PvtTime {
    /// UTC, if date and time of day are valid and no whole second is in doubt.
    #[must_use]
    pub fn utc(&self) -> Option<UtcTime> {
        let known = self.date_valid && self.clock_valid && self.resolved;
        let sane = self.nanosecond.unsigned_abs() <= 1_000_000_000;
        let (hour, minute, second) = self.clock;
        let time = TimeOfDay { hour, minute, second, nanosecond: 0 };
        let whole = CivilTime { date: self.date, time }.to_utc().filter(|_| known && sane)?;
        Some(whole.plus(Span::from_nanos(self.nanosecond.into())))
    }

    /// The instant for whoever puts the epoch together: a leap second is told as a time of day, as it
    /// has no place in a count of seconds without them.
    pub(super) fn epoch(&self) -> Option<EpochTime> {
        let utc = self.utc()?;
        let (hour, minute, second) = self.clock;
        let nanosecond = u32::try_from(self.nanosecond).ok().filter(|_| second == 60);
        let leaping = |nanosecond| TimeOfDay { hour, minute, second, nanosecond };
        Some(nanosecond.map_or(EpochTime::Utc(utc), |own| EpochTime::TimeOfDay(leaping(own))))
    }

    /// A time that is known to the nanosecond.
    fn of(utc: UtcTime, accuracy: f64) -> Self {
        let unknown = Date { year: 0, month: 1, day: 1 };
        let civil = CivilTime::from_utc(utc);
        let date = civil.map_or(unknown, |civil| civil.date);
        let time = civil.map_or_else(TimeOfDay::default, |civil| civil.time);
        PvtTime {
            date,
            clock: (time.hour, time.minute, time.second),
            nanosecond: time.nanosecond as i32,
            date_valid: civil.is_some(),
            clock_valid: civil.is_some(),
            resolved: civil.is_some(),
            accuracy: Some(accuracy),
        }
    }

    fn read(reader: &mut Reader<'_>) -> Result<(Self, u8), BinaryFault> {
        let date = Date { year: reader.le_u16()?, month: reader.u8()?, day: reader.u8()? };
        let clock = (reader.u8()?, reader.u8()?, reader.u8()?);
        let valid = reader.u8()?;
        let accuracy = accuracy(reader.le_u32()?, 1e-9);
        let nanosecond = reader.le_i32()?;
        let (date_valid, clock_valid, resolved) = (bit(valid, 0), bit(valid, 1), bit(valid, 2));
        let time = PvtTime { date, clock, nanosecond, date_valid, clock_valid, resolved, accuracy };
        Ok((time, valid))
    }

    fn write(&self, writer: &mut Writer, declination: bool) {
        let valid = u8::from(self.date_valid)
            | u8::from(self.clock_valid) << 1
            | u8::from(self.resolved) << 2
            | u8::from(declination) << 3;
        writer.le_u16(self.date.year).u8(self.date.month).u8(self.date.day);
        writer.u8(self.clock.0).u8(self.clock.1).u8(self.clock.2).u8(valid);
        writer.le_u32(accuracy_raw(self.accuracy, 1e-9)).le_i32(self.nanosecond);
    }
}

impl NavPvt {
    /// Reads a frame of either length.
    ///
    /// # Errors
    /// What is wrong with the bytes.
    pub fn read(frame: &[u8]) -> Result<Self, BinaryFault> {
        let mut reader = Reader::new(Frame::payload_of(frame, NAME)?);
        let time_of_week = time_of_week(&mut reader)?;
        let (time, valid) = PvtTime::read(&mut reader)?;
        let fix = FixType::from_raw(reader.u8()?);
        let flags = reader.u8()?;
        let [_, satellites] = reader.array()?;
        let place = [reader.le_i32()?, reader.le_i32()?, reader.le_i32()?];
        let height_msl = f64::from(reader.le_i32()?) * 1e-3;
        let horizontal_accuracy = accuracy(reader.le_u32()?, 1e-3);
        let vertical_accuracy = accuracy(reader.le_u32()?, 1e-3);
        let mut speed = || Ok(f64::from(reader.le_i32()?) * 1e-3);
        let velocity = [speed()?, speed()?, speed()?];
        let ground_speed = speed()?;
        let course = wrap_two_pi(f64::from(reader.le_i32()?) * HEADING);
        let speed_accuracy = accuracy(reader.le_u32()?, 1e-3);
        let heading_accuracy = accuracy(reader.le_u32()?, HEADING);
        let pdop = dilution(reader.le_u16()?);
        let [more_flags, _, _, _, _, _] = reader.array()?;
        let located = !bit(more_flags, 0);
        let vehicle = Vehicle::read(&mut reader)?;
        Ok(NavPvt {
            time_of_week,
            time,
            fix,
            fix_ok: bit(flags, 0),
            differential: bit(flags, 1),
            carrier: Carrier::of_raw(flags >> 6),
            satellites,
            position: located.then(|| position(place, [0; 3])).transpose()?,
            height_msl,
            horizontal_accuracy,
            vertical_accuracy,
            velocity,
            ground_speed,
            course,
            speed_accuracy,
            heading_accuracy,
            pdop,
            heading: vehicle.heading.filter(|_| bit(flags, 5)),
            declination: vehicle.declination.filter(|_| bit(valid, 3)),
        })
    }

    /// The frame, of 92 bytes of payload. Angles are wrapped into their range.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let mut writer = Writer::new();
        writer.le_u32(milliseconds(self.time_of_week));
        self.time.write(&mut writer, self.declination.is_some());
        let flags = u8::from(self.fix_ok)
            | u8::from(self.differential) << 1
            | u8::from(self.heading.is_some()) << 5
            | self.carrier.raw() << 6;
        writer.u8(self.fix.raw()).u8(flags).u8(0).u8(self.satellites);
        put_position(&mut writer, self.position.unwrap_or_default());
        writer.le_i32(signed(self.height_msl, 1e-3));
        writer.le_u32(accuracy_raw(self.horizontal_accuracy, 1e-3));
        writer.le_u32(accuracy_raw(self.vertical_accuracy, 1e-3));
        for speed in self.velocity {
            writer.le_i32(signed(speed, 1e-3));
        }
        writer.le_i32(signed(self.ground_speed, 1e-3));
        writer.le_i32(signed(wrap_two_pi(self.course), HEADING));
        writer.le_u32(accuracy_raw(self.speed_accuracy, 1e-3));
        writer.le_u32(accuracy_raw(self.heading_accuracy, HEADING));
        writer.le_u16(dilution_raw(self.pdop));
        writer.put(&[u8::from(self.position.is_none()), 0, 0, 0, 0, 0]);
        writer.le_i32(signed(wrap_two_pi(self.heading.unwrap_or_default()), HEADING));
        let (declination, accuracy) = self.declination.unwrap_or_default();
        writer.le_i16((declination / DECLINATION).round() as i16);
        writer.le_u16((accuracy / DECLINATION).round() as u16);
        framed(NAME, &writer)
    }

    /// What a receiver in this state would send.
    #[must_use]
    pub fn of(state: &GnssEpoch) -> Self {
        let fixed = state.quality != FixQuality::Invalid;
        let (fix, carrier) = match state.quality {
            FixQuality::Invalid => (FixType::None, Carrier::None),
            FixQuality::Estimated => (FixType::DeadReckoning, Carrier::None),
            FixQuality::RtkFixed => (FixType::ThreeDimensional, Carrier::Fixed),
            FixQuality::RtkFloat => (FixType::ThreeDimensional, Carrier::Float),
            _ => (FixType::ThreeDimensional, Carrier::None),
        };
        let [north, east, down] = state.velocity_std;
        NavPvt {
            time_of_week: state.time.to_week().1,
            time: PvtTime::of(state.time.to_utc(Some(state.leap_seconds)), state.time_std),
            fix,
            fix_ok: fixed,
            differential: matches!(state.quality, FixQuality::Differential)
                || carrier != Carrier::None,
            carrier,
            satellites: state.satellites,
            position: Some(state.position),
            height_msl: state.position.height - state.undulation,
            horizontal_accuracy: Some(state.horizontal_std()),
            vertical_accuracy: Some(state.position_std[2]),
            velocity: state.velocity,
            ground_speed: state.ground_speed(),
            course: state.course(),
            speed_accuracy: Some((north.powi(2) + east.powi(2) + down.powi(2)).sqrt()),
            heading_accuracy: None,
            pdop: Some(state.pdop),
            heading: None,
            declination: None,
        }
    }

    /// What the message says of its epoch.
    ///
    /// The epoch is UTC where that is certain, to the nanosecond; `iTOW`, by which NAV-DOP and NAV-COV
    /// name the same epoch, is rounded to a millisecond. `hAcc` is shared equally by north and east:
    /// u-blox does not define it, but users found it to be the root of the sum of both variances
    /// (forum.u-blox.com 24428). What `sAcc` sums is not known: each component gets all of it, which
    /// is never too little. NAV-COV tells the components apart.
    #[must_use]
    pub fn part(&self) -> GnssPart {
        let quality = self.quality();
        let usable = self.fix.has_position();
        let level = self.fix == FixType::TwoDimensional;
        let component = self.horizontal_accuracy.map(|both| both / std::f64::consts::SQRT_2);
        let [north, east, down] = self.velocity.map(Some);
        GnssPart {
            kind: "NAV-PVT",
            epoch: self.time.epoch().or_else(|| epoch(self.time_of_week)),
            time_std: self.time.accuracy,
            position: self.position.filter(|_| usable),
            position_std: if usable {
                [component, component, self.vertical_accuracy]
            } else {
                [None; 3]
            },
            velocity: if usable { [north, east, down.filter(|_| !level)] } else { [None; 3] },
            velocity_std: if usable { [self.speed_accuracy; 3] } else { [None; 3] },
            heading: self.heading,
            heading_std: self.heading.and(self.heading_accuracy),
            satellites: Some(self.satellites.into()),
            quality: Some(quality),
            invalid: quality == FixQuality::Invalid,
            ..GnssPart::default()
        }
    }

    /// What the receiver says of its fix. Dead reckoning without satellites is no measurement.
    #[must_use]
    pub fn quality(&self) -> FixQuality {
        self.fix.quality(self.fix_ok, self.carrier, self.differential)
    }
}

/// The last 8 bytes, which generation 7 does not send.
#[derive(Clone, Copy, Debug, Default)]
struct Vehicle {
    heading: Option<f64>,
    declination: Option<(f64, f64)>,
}

impl Vehicle {
    fn read(reader: &mut Reader<'_>) -> Result<Self, BinaryFault> {
        if reader.rest().is_empty() {
            return Ok(Vehicle::default());
        }
        let heading = wrap_two_pi(f64::from(reader.le_i32()?) * HEADING);
        let declination = f64::from(reader.le_i16()?) * DECLINATION;
        let accuracy = f64::from(reader.le_u16()?) * DECLINATION;
        Ok(Vehicle { heading: Some(heading), declination: Some((declination, accuracy)) })
    }
}
