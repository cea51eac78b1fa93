//! Telegrams of motion sensors, as echo sounders and other survey equipment read them.
//!
//! | | [`tss1`] | [`em`] | [`kmb`] | [`seapath`] |
//! |---|---|---|---|---|
//! | roll, positive | port up | port up | port up | port up |
//! | pitch, positive | bow up | bow up | bow up | bow up |
//! | heave on the wire, positive | up | up | **down** | **down** |
//! | what roll is | against the horizon | against the horizon | Euler angle | Euler angle |
//! | unknown is | not sent | a number out of range | a bit | a bit |
//! | time of validity | none | none | ns | 0.1 ms |
//! | check | none | none | none | CRC-16 |
//!
//! In the structs heave is positive up and vertical velocity positive down, whatever the wire has; roll
//! is positive with starboard down, which is the same as port up.
//!
//! A value that is out of the range of its field is written as unknown where the format can say so.
//! Where it cannot, `write` gives `None`, and there is nothing to send.
//!
//! Readers never panic, whatever the bytes. Formats without a check are taken by their shape and by the
//! ranges of their fields alone.

pub mod em;
pub mod kmb;
pub mod seapath;
pub mod tss1;

use std::f64::consts::PI;

use insd_base::UtcTime;

use crate::binary::{BinaryFault, scaled};

const SECOND: i64 = 1_000_000_000;

/// Values to which a status word gives one mark.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rated<T> {
    /// The values.
    pub value: T,
    /// Whether the sensor says that their quality is reduced.
    pub reduced: bool,
}

/// Where the sensor's reference point is and how it moves over ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SensorPlace {
    /// Latitude, rad, north positive.
    pub latitude: f64,
    /// Longitude, rad in [-pi, pi], east positive.
    pub longitude: f64,
    /// Height above the ellipsoid, m. No format has a mark of its own for it.
    pub height: f64,
    /// Velocity to the north, m/s.
    pub north_velocity: f64,
    /// Velocity to the east, m/s.
    pub east_velocity: f64,
}

/// How the ship is leaned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tilt {
    /// Roll, rad in [-pi, pi], starboard down positive, as Euler angle.
    pub roll: f64,
    /// Pitch, rad in [-pi, pi], bow up positive.
    pub pitch: f64,
}

/// Vertical motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertical {
    /// Heave, m, up positive.
    pub heave: f64,
    /// Velocity, m/s, **down** positive.
    pub down_velocity: f64,
}

/// Heave that was computed later, with knowledge of what came after.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SensorDelayedHeave {
    /// The instant at which it was valid.
    pub time: UtcTime,
    /// Heave, m, up positive.
    pub heave: f64,
}

/// Roll against the horizon of Euler angles, rad: the angle by which the athwartships axis leaves the
/// horizontal, arcsin(sin roll cos pitch). At 10 deg of roll and 5 deg of pitch it is 9.96 deg.
///
/// The makers' manuals have this angle in TSS1, EM1000 and EM3000 (Seapath 200, sections 6.3 and 6.4;
/// Seapath 320, A.12; Simrad FS70 and ES80, Sounder/TSS1). A Kongsberg multibeam can be told that roll
/// is the Euler angle instead ("rotation", not "horizontal"), and not every maker of sensors says which
/// of the two is sent.
#[must_use]
pub fn roll_from_horizon(roll: f64, pitch: f64) -> f64 {
    (roll.sin() * pitch.cos()).asin()
}

/// Bits of one group in a status word.
#[derive(Clone, Copy)]
struct Bits {
    invalid: u32,
    reduced: u32,
}

impl Bits {
    /// Numbers of a group for the wire: zeros, with the bit that says so, if the group is unknown or if
    /// one of them is out of its range.
    fn encode<T: Copy, W: Default>(
        self,
        status: &mut u32,
        group: Option<Rated<T>>,
        numbers: impl Fn(&T) -> Option<W>,
    ) -> W {
        let encoded = group.and_then(|group| Some((numbers(&group.value)?, group.reduced)));
        match encoded {
            Some((numbers, reduced)) => {
                *status |= if reduced { self.reduced } else { 0 };
                numbers
            }
            None => {
                *status |= self.invalid;
                W::default()
            }
        }
    }

    /// A group that was read, `None` if the status says that it is invalid; its numbers are not looked
    /// at then.
    fn rate<T>(
        self,
        status: u32,
        value: Result<T, BinaryFault>,
    ) -> Result<Option<Rated<T>>, BinaryFault> {
        if status & self.invalid != 0 {
            return Ok(None);
        }
        Ok(Some(Rated { value: value?, reduced: status & self.reduced != 0 }))
    }
}

/// All of a frame of fixed length.
fn whole<const N: usize>(bytes: &[u8]) -> Result<&[u8; N], BinaryFault> {
    let short = BinaryFault::Short { needed: N, found: bytes.len() };
    bytes.try_into().map_err(|_| if bytes.len() < N { short } else { BinaryFault::Frame })
}

/// The nearest whole number of units, `None` if the field cannot hold it or the value is not finite.
fn fixed<N: TryFrom<i64>>(value: f64, unit: f64) -> Option<N> {
    value.is_finite().then(|| scaled(value, unit)).and_then(|number| number.try_into().ok())
}

/// A value whose magnitude is not above a limit.
fn within(value: f64, limit: f64) -> Option<f64> {
    (value.abs() <= limit).then_some(value)
}

/// An angle from -pi to pi.
fn half_turn(angle: f64) -> Option<f64> {
    within(angle, PI)
}

/// The same with the other sign, and zero without one.
fn opposite(value: f64) -> f64 {
    0.0 - value
}

/// The instant of seconds since 1970, in 32 bits, and nanoseconds of the second.
fn time_of(seconds: impl Into<i64>, nanos: i64) -> Result<UtcTime, BinaryFault> {
    let fault = BinaryFault::Range { field: "fraction of a second" };
    let seconds = seconds.into().checked_mul(SECOND).filter(|_| (0..SECOND).contains(&nanos));
    seconds.and_then(|whole| whole.checked_add(nanos)).map(UtcTime::from_nanos).ok_or(fault)
}
