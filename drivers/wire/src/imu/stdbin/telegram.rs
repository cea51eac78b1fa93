//! One telegram: header, navigation blocks, external blocks.

use insd_base::UtcTime;
use insd_base::units::DEG;

use super::composer::Composer;
use super::external::External;
use super::sizes::{self, Blocks, cut, floats, words};
use super::{SUM, checksum, header_length, is_sound};
use crate::binary::{BinaryFault, Reader, Writer};

const DEGREES: [f64; 3] = [DEG; 3];
const ONES: [f64; 3] = [1.0; 3];
/// North, east, up on the wire; north, east, down here.
const NED: [f64; 3] = [1.0, 1.0, -1.0];
/// Heading, roll, pitch: the wire's pitch is positive with the bow down.
const HEADING_ROLL_PITCH: [f64; 3] = [DEG, DEG, -DEG];

/// A telegram. Blocks that are not among the fields are stepped over and not written.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Telegram {
    /// Protocol version, 2 to 5.
    pub version: u8,
    /// Time of validity of the navigation blocks, 0.1 ms.
    pub validity: u32,
    /// Number of the telegram.
    pub counter: u32,
    /// What the system computed.
    pub navigation: Navigation,
    /// What its sensors told it.
    pub external: External,
}

/// Heading and attitude of the vessel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StdBinAttitude {
    /// Heading, clockwise from true north, rad.
    pub heading: f64,
    /// Roll, starboard down positive, rad.
    pub roll: f64,
    /// Pitch, bow up positive, rad.
    pub pitch: f64,
}

/// Movement about the mean position, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StdBinHeave {
    /// Heave at the system, up positive.
    pub heave: f64,
    /// Heave at the chosen lever arm, up positive.
    pub lever_heave: f64,
    /// Surge at the lever arm, forward positive.
    pub lever_surge: f64,
    /// Sway at the lever arm, to port positive.
    pub lever_sway: f64,
}

/// Position at the chosen lever arm, WGS-84.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Position {
    /// Latitude, north positive, rad.
    pub latitude: f64,
    /// Longitude, 0 to 2 pi eastward, rad.
    pub longitude: f64,
    /// Altitude, up positive, m.
    pub altitude: f64,
    /// Whether the altitude is above the ellipsoid; else it is above the geoid.
    pub above_ellipsoid: bool,
}

/// The navigation blocks that are read. Axes: XV1 forward, XV2 to port, XV3 up.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Navigation {
    /// Bit 0: heading, roll, pitch.
    pub attitude: Option<StdBinAttitude>,
    /// Bit 1: 1-sigma of heading, roll, pitch, rad.
    pub attitude_std: Option<[f64; 3]>,
    /// Bit 2: heave, surge, sway in real time.
    pub heave: Option<StdBinHeave>,
    /// Bit 4: rates of heading, roll, pitch, rad/s, pitch positive with the bow going up.
    pub attitude_rates: Option<[f64; 3]>,
    /// Bit 5: rotation rates about XV1, XV2, XV3 with respect to the Earth, rad/s.
    pub rotation: Option<[f64; 3]>,
    /// Bit 6: accelerations along XV1, XV2, XV3 without gravity, m/s^2.
    pub acceleration: Option<[f64; 3]>,
    /// Bit 7: position.
    pub position: Option<Position>,
    /// Bit 9: velocity north, east, down, m/s.
    pub velocity: Option<[f64; 3]>,
    /// Bit 10: 1-sigma of the velocity north, east, down, m/s.
    pub velocity_std: Option<[f64; 3]>,
    /// Bit 13: year, month, day of the system's clock.
    pub date: Option<(u16, u8, u8)>,
    /// Bit 15: algorithm status of the INS.
    pub algorithm_status: Option<[u32; 4]>,
    /// Bit 16: system status of the INS.
    pub system_status: Option<[u32; 3]>,
    /// Bit 17: user status of the INS.
    pub user_status: Option<[u32; 1]>,
    /// Bit 22: velocity along XV1, XV2, XV3, m/s.
    pub vessel_velocity: Option<[f64; 3]>,
    /// Bit 25: mean temperature of gyroscopes, of accelerometers, of the board, deg C.
    pub temperatures: Option<[f64; 3]>,
    /// Bit 28: accelerations along XV1, XV2, XV3 with gravity: specific force, m/s^2.
    pub raw_acceleration: Option<[f64; 3]>,
    /// Extended bit 2: rotation rates about XV1, XV2, XV3 in inertial space, rad/s. Not in version 2.
    pub raw_rotation: Option<[f64; 3]>,
}

impl Telegram {
    /// Reads a whole telegram. A block with a number that is not finite is left out.
    ///
    /// # Errors
    /// [`BinaryFault::Frame`] if header, length or checksum are wrong; [`BinaryFault::Short`] if the blocks of the
    /// masks are longer than the telegram.
    pub fn read(frame: &[u8]) -> Result<Self, BinaryFault> {
        let mut reader = Reader::new(frame);
        let start = reader.take(3)?;
        let version = start.last().copied().unwrap_or_default();
        let header = header_length(version).filter(|_| start.starts_with(b"IX") && is_sound(frame));
        let header = header.ok_or(BinaryFault::Frame)?;
        let navigation_mask = reader.be_u32()?;
        let extended_mask = if version > 2 { reader.be_u32()? } else { 0 };
        let external_mask = reader.be_u32()?;
        let told = if version > 3 { Some(reader.be_u16()?) } else { None };
        if usize::from(reader.be_u16()?) != frame.len() {
            return Err(BinaryFault::Frame);
        }
        let (validity, counter) = (reader.be_u32()?, reader.be_u32()?);
        let mut body = Reader::new(reader.take(frame.len().saturating_sub(header + SUM))?);
        let mut external = body;
        let (blocks, whole) = cut(navigation_mask, &sizes::NAVIGATION, &mut body)?;
        let extended = if whole { extended_mask } else { 0 };
        let (extended, whole_too) = cut(extended, &sizes::EXTENDED, &mut body)?;
        match told {
            Some(told) => drop(external.take(usize::from(told))?),
            None => external = body,
        }
        let known = told.is_some() || whole && whole_too;
        let external_mask = if known { external_mask } else { 0 };
        let (external, _) = cut(external_mask, &sizes::EXTERNAL, &mut external)?;
        let navigation = Navigation::read(&blocks, &extended);
        Ok(Telegram { version, validity, counter, navigation, external: External::read(&external) })
    }

    /// Writes the telegram; a version that does not exist is written as 3.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let version = if header_length(self.version).is_some() { self.version } else { 3 };
        let header = header_length(version).unwrap_or_default();
        let mut composer = Composer::default();
        self.navigation.write(&mut composer, version > 2);
        let told = composer.body.bytes().len();
        self.external.write(&mut composer);
        let body = composer.body.into_bytes();
        let [navigation, extended, external] = composer.masks;
        let mut frame = Writer::new();
        frame.put(b"IX").u8(version).be_u32(navigation);
        if version > 2 {
            frame.be_u32(extended);
        }
        frame.be_u32(external);
        if version > 3 {
            frame.be_u16(told as u16);
        }
        frame.be_u16((header + body.len() + SUM) as u16);
        frame.be_u32(self.validity).be_u32(self.counter).put(&body);
        let sum = checksum(frame.bytes());
        frame.be_u32(sum);
        frame.into_bytes()
    }
}

impl Navigation {
    fn read(blocks: &Blocks<'_>, extended: &Blocks<'_>) -> Self {
        let attitude = floats(blocks[0], HEADING_ROLL_PITCH);
        let heave = floats(blocks[2], [1.0; 4]);
        Navigation {
            attitude: attitude.map(|[heading, roll, pitch]| StdBinAttitude {
                heading,
                roll,
                pitch,
            }),
            attitude_std: floats(blocks[1], DEGREES),
            heave: heave.map(|[heave, lever_heave, lever_surge, lever_sway]| StdBinHeave {
                heave,
                lever_heave,
                lever_surge,
                lever_sway,
            }),
            attitude_rates: floats(blocks[4], HEADING_ROLL_PITCH),
            rotation: floats(blocks[5], DEGREES),
            acceleration: floats(blocks[6], ONES),
            position: blocks[7].and_then(Position::read),
            velocity: floats(blocks[9], NED),
            velocity_std: floats(blocks[10], ONES),
            date: blocks[13].and_then(date),
            algorithm_status: words(blocks[15]),
            system_status: words(blocks[16]),
            user_status: words(blocks[17]),
            vessel_velocity: floats(blocks[22], ONES),
            temperatures: floats(blocks[25], ONES),
            raw_acceleration: floats(blocks[28], ONES),
            raw_rotation: floats(extended[2], DEGREES),
        }
    }

    fn write(&self, composer: &mut Composer, extended: bool) {
        let attitude = self.attitude.map(|a| [a.heading, a.roll, a.pitch]);
        let heave = self.heave.map(|h| [h.heave, h.lever_heave, h.lever_surge, h.lever_sway]);
        composer.floats((0, 0), attitude, HEADING_ROLL_PITCH);
        composer.floats((0, 1), self.attitude_std, DEGREES);
        composer.floats((0, 2), heave, [1.0; 4]);
        composer.floats((0, 4), self.attitude_rates, HEADING_ROLL_PITCH);
        composer.floats((0, 5), self.rotation, DEGREES);
        composer.floats((0, 6), self.acceleration, ONES);
        if let Some(position) = self.position {
            position.write(composer.block((0, 7)));
        }
        composer.floats((0, 9), self.velocity, NED);
        composer.floats((0, 10), self.velocity_std, ONES);
        if let Some((year, month, day)) = self.date {
            composer.block((0, 13)).u8(day).u8(month).be_u16(year);
        }
        composer.words((0, 15), self.algorithm_status);
        composer.words((0, 16), self.system_status);
        composer.words((0, 17), self.user_status);
        composer.floats((0, 22), self.vessel_velocity, ONES);
        composer.floats((0, 25), self.temperatures, ONES);
        composer.floats((0, 28), self.raw_acceleration, ONES);
        if extended {
            composer.floats((1, 2), self.raw_rotation, DEGREES);
        }
    }

    /// Midnight of the date.
    pub(super) fn midnight(&self) -> Option<UtcTime> {
        let (year, month, day) = self.date?;
        UtcTime::from_civil((year.into(), month, day), (0, 0, 0), 0)
    }
}

impl Position {
    fn read(block: &[u8]) -> Option<Self> {
        let mut reader = Reader::new(block);
        let latitude = reader.be_f64().ok()? * DEG;
        let longitude = reader.be_f64().ok()? * DEG;
        let above_ellipsoid = reader.u8().ok()? == 1;
        let altitude = f64::from(reader.be_f32().ok()?);
        let finite = [latitude, longitude, altitude].iter().all(|value| value.is_finite());
        finite.then_some(Position { latitude, longitude, altitude, above_ellipsoid })
    }

    fn write(&self, block: &mut Writer) {
        block.be_f64(self.latitude / DEG).be_f64(self.longitude / DEG);
        block.u8(u8::from(self.above_ellipsoid)).be_f32(self.altitude as f32);
    }
}

fn date(block: &[u8]) -> Option<(u16, u8, u8)> {
    let mut reader = Reader::new(block);
    let (day, month) = (reader.u8().ok()?, reader.u8().ok()?);
    Some((reader.be_u16().ok()?, month, day))
}
