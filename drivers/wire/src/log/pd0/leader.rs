//! The leaders: data types 0x0000 and 0x0080.
//!
//! ```text
//! fixed leader
//! 2   firmware 2 x u8   4 system configuration u16   8 beams u8   9 cells u8
//! 25  transformation: bits 4, 3 frame; 2 tilts used; 1 three beams allowed; 0 cells mapped
//! 26  heading alignment i16, 0.01 deg   28 heading bias i16, 0.01 deg   58 angle of the beams u8, deg
//! system configuration: bits 2 to 0 frequency, 3 convex, 7 up; 9, 8 beam angle 15, 20, 30 deg, other
//!
//! variable leader
//! 2   number u16, third byte at 11   4 clock: year, month, day, hour, minute, second, 0.01 s
//! 12  built-in test u16   14 speed of sound u16, m/s   16 depth of the transducer u16, dm
//! 18  heading u16, 0.01 deg   20 pitch i16, 0.01 deg   22 roll i16, 0.01 deg
//! 24  salinity u16, ppt   26 temperature i16, 0.01 deg C
//! 57  clock: century, year, month, day, hour, minute, second, 0.01 s (not in old instruments)
//! ```

use insd_base::UtcTime;
use insd_base::units::{DEG, wrap_two_pi};

use super::janus::Geometry;
use crate::binary::{BinaryFault, Reader, Writer, scaled};

/// Radians of the least bit of an angle.
const ANGLE: f64 = 0.01 * DEG;
/// Bytes that are written.
const FIXED: usize = 59;
const VARIABLE: usize = 65;
/// Least bytes that are read: up to the heading bias, up to the temperature.
const LEAST: usize = 30;

/// Axes of an ensemble's velocities.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Coordinates {
    /// Along the beams.
    Beam,
    /// Of the instrument.
    Instrument,
    /// Starboard, forward, mast.
    Ship,
    /// East, north, up.
    Earth,
}

/// What the instrument did to its velocities (command `EX`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Transformation {
    /// The axes.
    pub coordinates: Coordinates,
    /// Whether pitch and roll were used.
    pub tilts: bool,
    /// Whether velocities of three beams were allowed.
    pub three_beams: bool,
    /// Whether depth cells were mapped to the same depth.
    pub mapped: bool,
}

/// How the instrument is built and set up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FixedLeader {
    /// Version and revision of the firmware.
    pub firmware: [u8; 2],
    /// Acoustic frequency, Hz, if the code is known.
    pub frequency: Option<f64>,
    /// How the beams stand; `None` if the angle is not told.
    pub geometry: Option<Geometry>,
    /// Beams that were used.
    pub beams: u8,
    /// Depth cells.
    pub cells: u8,
    /// What was done to velocities.
    pub transformation: Transformation,
    /// Angle from beam 3 to the ship's bow (`EA`), rad.
    pub heading_alignment: f64,
    /// Added to the heading (`EB`), rad.
    pub heading_bias: f64,
}

/// When, where and how the instrument hung.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VariableLeader {
    /// Number of the ensemble, 24 bits.
    pub number: u32,
    /// The instrument's clock, taken as UTC. Years of two digits are 1980 to 2079.
    pub clock: Option<UtcTime>,
    /// Result of the built-in test; zero when all is well.
    pub self_test: u16,
    /// Speed of sound, m/s.
    pub sound: f64,
    /// Depth of the transducer, m.
    pub depth: f64,
    /// Heading by the instrument's own or given compass, rad in [0, 2 pi).
    pub heading: f64,
    /// Pitch, rad.
    pub pitch: f64,
    /// Roll, rad.
    pub roll: f64,
    /// Salinity, parts per thousand.
    pub salinity: f64,
    /// Temperature of the water, deg C.
    pub temperature: f64,
}

impl Transformation {
    fn of_byte(byte: u8) -> Self {
        let coordinates = match byte >> 3 & 3 {
            0 => Coordinates::Beam,
            1 => Coordinates::Instrument,
            2 => Coordinates::Ship,
            _ => Coordinates::Earth,
        };
        let bit = |bit: u8| byte >> bit & 1 == 1;
        Transformation { coordinates, tilts: bit(2), three_beams: bit(1), mapped: bit(0) }
    }

    fn byte(self) -> u8 {
        let frame = match self.coordinates {
            Coordinates::Beam => 0,
            Coordinates::Instrument => 1,
            Coordinates::Ship => 2,
            Coordinates::Earth => 3,
        };
        let bit = |on: bool, bit: u8| u8::from(on) << bit;
        frame << 3 | bit(self.tilts, 2) | bit(self.three_beams, 1) | bit(self.mapped, 0)
    }
}

/// Frequencies by code, Hz: 75, 150, 300, 600, 1200, 2400 kHz.
fn frequency(code: u16) -> Option<f64> {
    (code < 6).then(|| 75e3 * f64::from(1 << code))
}

/// The angle of the beams, rad: the byte at 58 if it is there and sane, else bits 9 and 8.
fn beam_angle(data: &[u8], configuration: u16) -> Option<f64> {
    let told = data.get(58).filter(|degrees| (5..=45).contains(*degrees));
    let coded = [Some(15), Some(20), Some(30), None][usize::from(configuration >> 8 & 3)];
    told.copied().or(coded).map(|degrees| f64::from(degrees) * DEG)
}

impl FixedLeader {
    /// The data type's id.
    pub(super) const ID: usize = 0x0000;

    pub(super) fn read(data: &[u8]) -> Result<Self, BinaryFault> {
        let mut reader = Reader::new(Reader::new(data).take(LEAST)?);
        reader.take(2)?;
        let firmware = reader.array()?;
        let configuration = reader.le_u16()?;
        reader.take(2)?;
        let [beams, cells] = reader.array()?;
        reader.take(15)?;
        let transformation = Transformation::of_byte(reader.u8()?);
        let convex = configuration >> 3 & 1 == 1;
        let up = configuration >> 7 & 1 == 1;
        let angle = beam_angle(data, configuration);
        Ok(FixedLeader {
            firmware,
            frequency: frequency(configuration & 7),
            geometry: angle.map(|angle| Geometry { angle, convex, up }),
            beams,
            cells,
            transformation,
            heading_alignment: f64::from(reader.le_i16()?) * ANGLE,
            heading_bias: f64::from(reader.le_i16()?) * ANGLE,
        })
    }

    pub(super) fn write(&self) -> Vec<u8> {
        let code = (0..6).find(|code| frequency(*code) == self.frequency).unwrap_or(7);
        let (convex, up) = self.geometry.map_or((false, false), |g| (g.convex, g.up));
        let degrees = self.geometry.map_or(0, |g| scaled(g.angle, DEG).clamp(0, 255) as u8);
        let angle = match degrees {
            15 => 0,
            20 => 1,
            30 => 2,
            _ => 3,
        };
        let configuration = code | u16::from(convex) << 3 | u16::from(up) << 7 | angle << 8;
        let mut data = Writer::new();
        data.le_u16(Self::ID as u16).put(&self.firmware);
        // 4 beams in Janus configuration
        data.le_u16(configuration | 0x4000)
            .put(&[0; 2])
            .u8(self.beams)
            .u8(self.cells)
            .put(&[0; 15]);
        data.u8(self.transformation.byte());
        data.le_i16(angle_count(self.heading_alignment)).le_i16(angle_count(self.heading_bias));
        data.put(&[0; FIXED - LEAST - 1]).u8(degrees);
        data.into_bytes()
    }
}

impl VariableLeader {
    /// The data type's id.
    pub(super) const ID: usize = 0x0080;

    pub(super) fn read(data: &[u8]) -> Result<Self, BinaryFault> {
        let mut reader = Reader::new(data);
        reader.take(2)?;
        let low = reader.le_u16()?;
        let [year, rest @ ..] = reader.array::<7>()?;
        let century = if year < 80 { 20 } else { 19 };
        let short = clock(century, year, rest);
        let number = u32::from(low) | u32::from(reader.u8()?) << 16;
        let long = data.get(57..65).and_then(|bytes| <[u8; 8]>::try_from(bytes).ok());
        let long = long.and_then(|[century, year, rest @ ..]| clock(century, year, rest));
        Ok(VariableLeader {
            number,
            clock: long.or(short),
            self_test: reader.le_u16()?,
            sound: reader.le_u16()?.into(),
            depth: f64::from(reader.le_u16()?) * 0.1,
            heading: wrap_two_pi(f64::from(reader.le_u16()?) * ANGLE),
            pitch: f64::from(reader.le_i16()?) * ANGLE,
            roll: f64::from(reader.le_i16()?) * ANGLE,
            salinity: reader.le_u16()?.into(),
            temperature: f64::from(reader.le_i16()?) * 0.01,
        })
    }

    pub(super) fn write(&self) -> Vec<u8> {
        let [century, date @ ..] = self.clock.and_then(clock_bytes).unwrap_or_default();
        let unsigned = |value: f64, unit: f64| scaled(value, unit).clamp(0, u16::MAX.into()) as u16;
        let heading = scaled(wrap_two_pi(self.heading), ANGLE).rem_euclid(36_000) as u16;
        let mut data = Writer::new();
        data.le_u16(Self::ID as u16).le_u16(self.number as u16).put(&date);
        data.u8((self.number >> 16) as u8).le_u16(self.self_test);
        data.le_u16(unsigned(self.sound, 1.0)).le_u16(unsigned(self.depth, 0.1)).le_u16(heading);
        data.le_i16(angle_count(self.pitch)).le_i16(angle_count(self.roll));
        data.le_u16(unsigned(self.salinity, 1.0)).le_i16(saturated(self.temperature, 0.01));
        let missing = (VARIABLE - 8).saturating_sub(data.bytes().len());
        data.put([0; VARIABLE].get(..missing).unwrap_or_default()).u8(century).put(&date);
        data.into_bytes()
    }
}

/// Century, year, month, day, hour, minute, second, 0.01 s; nothing if a part is out of its range.
fn clock(century: u8, year: u8, rest: [u8; 6]) -> Option<UtcTime> {
    let [month, day, hour, minute, second, hundredth] = rest;
    let year = i32::from(century) * 100 + i32::from(year);
    let nanosecond = u32::from(hundredth) * 10_000_000;
    UtcTime::from_civil((year, month, day), (hour, minute, second), nanosecond)
}

fn clock_bytes(clock: UtcTime) -> Option<[u8; 8]> {
    let ((year, month, day), nanos) = clock.to_civil();
    let hundredths = nanos / 10_000_000;
    let part = |unit: i64, count: i64| (hundredths / unit % count) as u8;
    let [century, year] = [year / 100, year % 100].map(|part| u8::try_from(part).ok());
    let time = [part(360_000, 24), part(6_000, 60), part(100, 60), part(1, 100)];
    let [hour, minute, second, hundredth] = time;
    Some([century?, year?, month, day, hour, minute, second, hundredth])
}

fn angle_count(angle: f64) -> i16 {
    saturated(angle, ANGLE)
}

fn saturated(value: f64, unit: f64) -> i16 {
    scaled(value, unit).clamp(i16::MIN.into(), i16::MAX.into()) as i16
}
