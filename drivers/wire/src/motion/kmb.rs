//! KM binary, `#KMB`: position, attitude, rates, accelerations and their errors in 132 bytes.
//!
//! ```text
//! byte   field                    type                byte   field                    type
//!   0    "#KMB"                   4 bytes              68    north velocity, m/s      f32
//!   4    length, 132              u16                  72    east velocity, m/s       f32
//!   6    version, 1               u16                  76    down velocity, m/s       f32
//!   8    seconds since 1970       u32                  80    latitude error, m        f32
//!  12    nanoseconds              u32                  84    longitude error, m       f32
//!  16    status                   u32                  88    height error, m          f32
//!  20    latitude, deg            f64                  92    roll error, deg          f32
//!  28    longitude, deg           f64                  96    pitch error, deg         f32
//!  36    ellipsoid height, m      f32                 100    heading error, deg       f32
//!  40    roll, deg, port up       f32                 104    heave error, m           f32
//!  44    pitch, deg, bow up       f32                 108    north acceleration       f32
//!  48    heading, deg             f32                 112    east acceleration        f32
//!  52    heave, m, down           f32                 116    down acceleration, m/s^2 f32
//!  56    roll rate, deg/s         f32                 120    delayed heave: seconds   u32
//!  60    pitch rate, deg/s        f32                 124    nanoseconds              u32
//!  64    yaw rate, deg/s          f32                 128    delayed heave, m, down   f32
//! ```
//!
//! Little endian; no checksum. An error that the sensor does not estimate is -1. Status bits, invalid
//! and reduced performance:
//!
//! ```text
//! 0, 16  horizontal position and velocity; here also the height, which has no bits of its own
//! 1, 17  roll and pitch                    3, 19  heave and vertical velocity
//! 2, 18  heading                           4, 20  acceleration             5, 21  delayed heave
//! ```
//!
//! Nothing says that the rates are invalid: they have to be known. `.kmall` files hold the first 120
//! bytes of this format with other bits: there 6 and 22 are the delayed heave.
//!
//! Sources: the page "KM Binary" of Simrad's EK80 help (table, signs, -1, bits 0 to 5 and 16, 17);
//! `doc/thirdPartyMessages.md` of SBG Systems' sbgECom (all offsets and bits); `vortex-seapath-driver`,
//! which receives a Seapath 130 (the same table and bits); `kma_reader.h` for the bits of `.kmall`.
//! No published telegram was found: not verified against a device.

use insd_base::UtcTime;
use insd_base::units::{DEG, wrap_two_pi};

use super::{
    Bits, Rated, SECOND, SensorDelayedHeave, SensorPlace, Tilt, Vertical, half_turn, opposite,
    time_of, whole, within,
};
use crate::binary::{BinaryFault, Reader, Writer};
use crate::stream::Look;

/// Bytes of the telegram.
pub const LENGTH: usize = 132;

const START: &[u8; 4] = b"#KMB";
/// How each telegram begins: start, length, version.
const HEAD: [u8; 8] = [b'#', b'K', b'M', b'B', LENGTH as u8, 0, VERSION as u8, 0];
const VERSION: u16 = 1;

const PLACE: Bits = Bits { invalid: 1, reduced: 1 << 16 };
const TILT: Bits = Bits { invalid: 1 << 1, reduced: 1 << 17 };
const HEADING: Bits = Bits { invalid: 1 << 2, reduced: 1 << 18 };
const VERTICAL: Bits = Bits { invalid: 1 << 3, reduced: 1 << 19 };
const ACCELERATION: Bits = Bits { invalid: 1 << 4, reduced: 1 << 20 };
const DELAYED: Bits = Bits { invalid: 1 << 5, reduced: 1 << 21 };

/// An error that the sensor does not estimate.
const NOT_ESTIMATED: f32 = -1.0;

/// What stands at the start of some bytes: a telegram by its first eight bytes and by what can be read of it, as there is no checksum.
#[must_use]
pub fn look(bytes: &[u8]) -> Look {
    if bytes.iter().zip(&HEAD).any(|(byte, own)| byte != own) {
        return Look::Nothing;
    }
    match bytes.get(..LENGTH) {
        None => Look::More(LENGTH),
        Some(telegram) if Kmb::read(telegram).is_ok() => Look::Frame(LENGTH),
        Some(_) => Look::Damaged,
    }
}

/// The telegram.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kmb {
    /// The instant at which all but the delayed heave was valid; 1970 to 2106.
    pub time: UtcTime,
    /// Position, height, and velocity over ground.
    pub place: Option<Rated<SensorPlace>>,
    /// Roll and pitch; pitch is within -90 to 90 deg.
    pub tilt: Option<Rated<Tilt>>,
    /// Heading, rad in [0, 2 pi), clockwise from true north.
    pub heading: Option<Rated<f64>>,
    /// Heave and vertical velocity.
    pub vertical: Option<Rated<Vertical>>,
    /// Rates of roll (starboard going down), pitch (bow going up) and yaw (bow turning to starboard),
    /// rad/s. Needed.
    pub rates: [f64; 3],
    /// Acceleration to north, east and down, without gravity, m/s^2.
    pub acceleration: Option<Rated<[f64; 3]>>,
    /// Delayed heave.
    pub delayed_heave: Option<Rated<SensorDelayedHeave>>,
    /// Errors that the sensor expects.
    pub sigma: KmbSigma,
}

/// Errors that the sensor expects of itself, 1-sigma; unknown ones are -1 on the wire.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct KmbSigma {
    /// Of the latitude, m.
    pub north: Option<f64>,
    /// Of the longitude, m.
    pub east: Option<f64>,
    /// Of the height, m.
    pub height: Option<f64>,
    /// Of roll, rad.
    pub roll: Option<f64>,
    /// Of pitch, rad.
    pub pitch: Option<f64>,
    /// Of the heading, rad.
    pub heading: Option<f64>,
    /// Of the heave in real time, m.
    pub heave: Option<f64>,
}

/// Units of the seven errors, m and rad.
const SIGMA_UNITS: [f64; 7] = [1.0, 1.0, 1.0, DEG, DEG, DEG, 1.0];

impl Kmb {
    /// Writes the telegram. Groups with a value that is out of its range or not finite are written as
    /// invalid; `None` if that holds for the time or a rate, which nothing can mark.
    #[must_use]
    pub fn write(&self) -> Option<[u8; LENGTH]> {
        let (seconds, nanos) = unsigned_seconds_of(self.time)?;
        let rates = floats(self.rates.map(|rate| rate / DEG))?;
        let mut status = 0;
        let ([latitude, longitude], [height, north, east]) =
            PLACE.encode(&mut status, self.place, place);
        let tilt = TILT.encode(&mut status, self.tilt, tilt);
        let heading = HEADING.encode(&mut status, self.heading, |heading| direction(*heading));
        let [heave, down] = VERTICAL.encode(&mut status, self.vertical, |vertical| {
            floats([opposite(vertical.heave), vertical.down_velocity])
        });
        let acceleration =
            ACCELERATION.encode(&mut status, self.acceleration, |values| floats(*values));
        let (delayed_time, [delayed]) =
            DELAYED.encode(&mut status, self.delayed_heave, |delayed| {
                Some((unsigned_seconds_of(delayed.time)?, floats([opposite(delayed.heave)])?))
            });
        let mut frame = Writer::new();
        frame.put(START).le_u16(LENGTH as u16).le_u16(VERSION);
        frame.le_u32(seconds).le_u32(nanos).le_u32(status);
        frame.le_f64(latitude).le_f64(longitude).le_f32(height);
        put(&mut frame, &tilt);
        frame.le_f32(heading).le_f32(heave);
        put(&mut frame, &rates);
        put(&mut frame, &[north, east, down]);
        put(&mut frame, &self.sigma.to_wire());
        put(&mut frame, &acceleration);
        frame.le_u32(delayed_time.0).le_u32(delayed_time.1).le_f32(delayed);
        frame.into_bytes().try_into().ok()
    }

    /// Reads the telegram. What its status calls invalid is `None`, whatever the numbers.
    ///
    /// # Errors
    /// [`BinaryFault::Short`]; [`BinaryFault::Frame`] for another start or length; [`BinaryFault::OtherMessage`] for
    /// another version; [`BinaryFault::Range`] for a number that is said to be valid and is not in its range.
    pub fn read(bytes: &[u8]) -> Result<Self, BinaryFault> {
        let frame: &[u8; LENGTH] = whole(bytes)?;
        let mut reader = Reader::new(frame);
        if &reader.array()? != START || usize::from(reader.le_u16()?) != LENGTH {
            return Err(BinaryFault::Frame);
        }
        if reader.le_u16()? != VERSION {
            return Err(BinaryFault::OtherMessage);
        }
        let time = time_of(reader.le_u32()?, reader.le_u32()?.into())?;
        let status = reader.le_u32()?;
        let position = [reader.le_f64()?, reader.le_f64()?];
        let [height] = singles(&mut reader)?;
        let [roll, pitch, heading, heave] = singles(&mut reader)?;
        let rates = singles(&mut reader)?;
        let [north, east, down] = singles(&mut reader)?;
        let sigma = KmbSigma::of_wire(singles(&mut reader)?)?;
        let acceleration = singles(&mut reader)?;
        let delayed_time = (reader.le_u32()?, reader.le_u32()?);
        let [delayed] = singles(&mut reader)?;
        Ok(Kmb {
            time,
            place: PLACE.rate(status, place_of(position, [height, north, east]))?,
            tilt: TILT.rate(status, tilt_of(roll, pitch))?,
            heading: HEADING.rate(status, heading_of(heading))?,
            vertical: VERTICAL.rate(status, vertical_of(heave, down))?,
            rates: finite(rates, "rate")?.map(|rate| rate * DEG),
            acceleration: ACCELERATION.rate(status, finite(acceleration, "acceleration"))?,
            delayed_heave: DELAYED.rate(status, delayed_of(delayed_time, delayed))?,
            sigma,
        })
    }
}

impl KmbSigma {
    fn to_wire(self) -> [f32; 7] {
        let KmbSigma { north, east, height, roll, pitch, heading, heave } = self;
        let mut units = SIGMA_UNITS.into_iter();
        [north, east, height, roll, pitch, heading, heave].map(|sigma| {
            let unit = units.next().unwrap_or(1.0);
            let sigma = sigma.map(|sigma| (sigma / unit) as f32);
            sigma.filter(|sigma| sigma.is_finite() && *sigma >= 0.0).unwrap_or(NOT_ESTIMATED)
        })
    }

    fn of_wire(values: [f64; 7]) -> Result<Self, BinaryFault> {
        let mut units = SIGMA_UNITS.into_iter();
        let [north, east, height, roll, pitch, heading, heave] =
            finite(values, "error")?.map(|sigma| {
                let unit = units.next().unwrap_or(1.0);
                (sigma >= 0.0).then_some(sigma * unit)
            });
        Ok(KmbSigma { north, east, height, roll, pitch, heading, heave })
    }
}

fn place(place: &SensorPlace) -> Option<([f64; 2], [f32; 3])> {
    let latitude = within(place.latitude / DEG, 90.0)?;
    let longitude = within(place.longitude / DEG, 180.0)?;
    let others = floats([place.height, place.north_velocity, place.east_velocity])?;
    Some(([latitude, longitude], others))
}

fn place_of([latitude, longitude]: [f64; 2], others: [f64; 3]) -> Result<SensorPlace, BinaryFault> {
    let [height, north_velocity, east_velocity] = finite(others, "height or velocity")?;
    Ok(SensorPlace {
        latitude: limited(latitude, 90.0, "latitude")? * DEG,
        longitude: limited(longitude, 180.0, "longitude")? * DEG,
        height,
        north_velocity,
        east_velocity,
    })
}

fn tilt(tilt: &Tilt) -> Option<[f32; 2]> {
    let (roll, pitch) = (half_turn(tilt.roll)?, within(tilt.pitch / DEG, 90.0)?);
    floats([roll / DEG, pitch])
}

fn tilt_of(roll: f64, pitch: f64) -> Result<Tilt, BinaryFault> {
    let (roll, pitch) = (limited(roll, 180.0, "roll")?, limited(pitch, 90.0, "pitch")?);
    Ok(Tilt { roll: roll * DEG, pitch: pitch * DEG })
}

/// A heading in degrees below 360, also once it is rounded to a single.
fn direction(heading: f64) -> Option<f32> {
    let degrees = (heading.is_finite().then(|| wrap_two_pi(heading))? / DEG) as f32;
    Some(if degrees < 360.0 { degrees } else { 0.0 })
}

fn heading_of(degrees: f64) -> Result<f64, BinaryFault> {
    let valid = (0.0..=360.0).contains(&degrees);
    if valid {
        Ok(wrap_two_pi(degrees * DEG))
    } else {
        Err(BinaryFault::Range { field: "heading" })
    }
}

fn vertical_of(heave: f64, down: f64) -> Result<Vertical, BinaryFault> {
    let [heave, down_velocity] = finite([heave, down], "heave or down velocity")?;
    Ok(Vertical { heave: opposite(heave), down_velocity })
}

fn delayed_of((seconds, nanos): (u32, u32), heave: f64) -> Result<SensorDelayedHeave, BinaryFault> {
    let [heave] = finite([heave], "delayed heave")?;
    Ok(SensorDelayedHeave { time: time_of(seconds, nanos.into())?, heave: opposite(heave) })
}

/// Whole seconds since 1970 and nanoseconds of the second, `None` before 1970 and after 2106.
fn unsigned_seconds_of(time: UtcTime) -> Option<(u32, u32)> {
    let nanos = time.as_nanos();
    Some((nanos.div_euclid(SECOND).try_into().ok()?, nanos.rem_euclid(SECOND) as u32))
}

fn put(frame: &mut Writer, values: &[f32]) {
    for value in values {
        frame.le_f32(*value);
    }
}

/// Values as singles, `None` if one is not finite or too large.
fn floats<const N: usize>(values: [f64; N]) -> Option<[f32; N]> {
    let singles = values.map(|value| value as f32);
    singles.iter().all(|value| value.is_finite()).then_some(singles)
}

fn singles<const N: usize>(reader: &mut Reader<'_>) -> Result<[f64; N], BinaryFault> {
    let mut values = [0.0; N];
    for value in &mut values {
        *value = reader.le_f32()?.into();
    }
    Ok(values)
}

fn finite<const N: usize>(values: [f64; N], field: &'static str) -> Result<[f64; N], BinaryFault> {
    let all = values.iter().all(|value| value.is_finite());
    if all { Ok(values) } else { Err(BinaryFault::Range { field }) }
}

fn limited(value: f64, limit: f64, field: &'static str) -> Result<f64, BinaryFault> {
    within(value, limit).ok_or(BinaryFault::Range { field })
}
