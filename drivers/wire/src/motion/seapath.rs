//! Seapath binary formats 23 and 26: position, attitude, heave and rates in 44 bytes, and the same with
//! the delayed heave in 52.
//!
//! ```text
//! byte       field                                      type   unit
//!  0         header: AA 51 (23), AA 55 (26)
//!  2         seconds since 1970 UTC, no leap seconds    i32
//!  6         fraction of the second                     u16    0.0001 s
//!  8         latitude                                   i32    90 deg / 2^30
//! 12         longitude                                  i32    90 deg / 2^30
//! 16         height above the ellipsoid                 i32    cm
//! 20         heave, down positive                       i16    cm
//! 22 24 26   north, east, down velocity                 i16    cm/s
//! 28 30      roll, port up; pitch, bow up               i16    90 deg / 2^14
//! 32         heading                                    u16    90 deg / 2^14
//! 34 36 38   roll, pitch, yaw rate                      i16    90 deg/s / 2^14
//! 40 (26)    delayed heave: seconds, fraction           i32, u16
//! 46 (26)    delayed heave, down positive               i16    cm
//! 40 or 48   status                                     u16
//! 42 or 50   checksum
//! ```
//!
//! Numbers are big endian. The checksum is the CRC of X.25 (reflected polynomial 8408, initial value
//! FFFF, the result **inverted**) over all between header and checksum, **low byte first**. Seconds end
//! in January 2038.
//!
//! Status bits, reduced and invalid: 0, 1 horizontal position and velocity (here also the height, which
//! has no bits of its own); 2, 3 heave and vertical velocity; 4, 5 roll and pitch; 6, 7 heading; in 26
//! also 8: delayed heave invalid. Nothing says that the rates are invalid: they have to be known.
//!
//! Sources: the receiver `SeawardScience/seapath` (all of 23, with the text and the algorithm of the
//! checksum of the maker's manual); `doc/thirdPartyMessages.md` of SBG Systems' sbgECom (all of 26; it
//! names polynomial and initial value of the checksum only); Kongsberg Seapath 320 installation manual
//! (M300-62 rev. 2), A.7, for format 11, whose scales, signs, epoch and status bits are these. The
//! checksum is verified against a telegram of format 11 of a ship, in the tests of
//! `ds_sensor_parsers`. No telegram of 23 or 26 was found: they are not verified against a device.

use std::f64::consts::FRAC_PI_2;

use crc::{CRC_16_IBM_SDLC, Crc};
use insd_base::UtcTime;
use insd_base::units::wrap_two_pi;

use super::{
    Bits, Rated, SensorDelayedHeave, SensorPlace, Tilt, Vertical, fixed, half_turn, opposite,
    time_of, whole, within,
};
use crate::binary::{BinaryFault, Reader, Writer, scaled};

/// Bytes of format 23.
pub const LENGTH_23: usize = 44;
/// Bytes of format 26.
pub const LENGTH_26: usize = 52;

const HEADER_23: [u8; 2] = [0xAA, 0x51];
const HEADER_26: [u8; 2] = [0xAA, 0x55];

static CRC: Crc<u16> = Crc::<u16>::new(&CRC_16_IBM_SDLC);

const PLACE: Bits = Bits { reduced: 1, invalid: 1 << 1 };
const VERTICAL: Bits = Bits { reduced: 1 << 2, invalid: 1 << 3 };
const TILT: Bits = Bits { reduced: 1 << 4, invalid: 1 << 5 };
const HEADING: Bits = Bits { reduced: 1 << 6, invalid: 1 << 7 };
const DELAYED: Bits = Bits { reduced: 0, invalid: 1 << 8 };

/// Unit of latitude and longitude, rad.
const POSITION: f64 = FRAC_PI_2 / (1 << 30) as f64;
/// Unit of angles, rad, and of rates, rad/s.
const ANGLE: f64 = FRAC_PI_2 / (1 << 14) as f64;
/// Unit of lengths, m, and of velocities, m/s.
const CENTI: f64 = 0.01;
/// Nanoseconds in a unit of the fraction of a second.
const TICK: i64 = 100_000;
/// Units of a second.
const TICKS: i64 = 10_000;

/// Format 23.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seapath23 {
    /// The instant at which this was valid, to the nearest 0.1 ms; to January 2038.
    pub time: UtcTime,
    /// Position, height, and velocity over ground up to 327 m/s.
    pub place: Option<Rated<SensorPlace>>,
    /// Roll and pitch.
    pub tilt: Option<Rated<Tilt>>,
    /// Heading, rad in [0, 2 pi), clockwise from true north.
    pub heading: Option<Rated<f64>>,
    /// Heave, up to 327 m, and vertical velocity.
    pub vertical: Option<Rated<Vertical>>,
    /// Rates about the ship's axes forward, to starboard and down, rad/s: positive if starboard goes
    /// down, the bow goes up, the bow turns to starboard. Needed, below 180 deg/s.
    pub rates: [f64; 3],
}

/// Format 26.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seapath26 {
    /// What format 23 has.
    pub motion: Seapath23,
    /// Delayed heave.
    pub delayed_heave: Option<SensorDelayedHeave>,
}

impl Seapath23 {
    /// Writes the telegram. Groups with a value that is out of its range or not finite are written as
    /// invalid; `None` if that holds for the time or a rate, which nothing can mark.
    #[must_use]
    pub fn write(&self) -> Option<[u8; LENGTH_23]> {
        let (frame, status) = self.body(HEADER_23)?;
        sealed(frame, status).try_into().ok()
    }

    /// Reads the telegram. What its status calls invalid is `None`, whatever the numbers.
    ///
    /// # Errors
    /// [`BinaryFault::Short`]; [`BinaryFault::Frame`] for a wrong header, length or checksum; [`BinaryFault::Range`] for
    /// a number that is said to be valid and is not in its range.
    pub fn read(bytes: &[u8]) -> Result<Self, BinaryFault> {
        let (mut reader, status) = opened::<LENGTH_23>(bytes, HEADER_23)?;
        Seapath23::of_body(&mut reader, status)
    }

    fn body(&self, header: [u8; 2]) -> Option<(Writer, u32)> {
        let mut status = 0;
        let [roll_rate, pitch_rate, yaw_rate] = shorts(self.rates, ANGLE)?;
        let ([latitude, longitude, height], [north, east]) =
            PLACE.encode(&mut status, self.place, place);
        let [heave, down] = VERTICAL.encode(&mut status, self.vertical, |vertical| {
            Some([fixed(opposite(vertical.heave), CENTI)?, fixed(vertical.down_velocity, CENTI)?])
        });
        let [roll, pitch] = TILT.encode(&mut status, self.tilt, tilt);
        let heading = HEADING.encode(&mut status, self.heading, |heading| direction(*heading));
        let (seconds, fraction) = ticks_of(self.time)?;
        let mut frame = Writer::new();
        frame.put(&header).be_i32(seconds).be_u16(fraction);
        frame.be_i32(latitude).be_i32(longitude).be_i32(height);
        frame.be_i16(heave).be_i16(north).be_i16(east).be_i16(down);
        frame.be_i16(roll).be_i16(pitch).be_u16(heading);
        frame.be_i16(roll_rate).be_i16(pitch_rate).be_i16(yaw_rate);
        Some((frame, status))
    }

    fn of_body(reader: &mut Reader<'_>, status: u32) -> Result<Self, BinaryFault> {
        let time = time_of(reader.be_i32()?, i64::from(reader.be_u16()?) * TICK)?;
        let position = [reader.be_i32()?, reader.be_i32()?, reader.be_i32()?];
        let [heave, north, east, down] = numbers(reader, CENTI)?;
        let [roll, pitch] = numbers(reader, ANGLE)?;
        let heading = f64::from(reader.be_u16()?) * ANGLE;
        let rates = numbers(reader, ANGLE)?;
        let vertical = Vertical { heave: opposite(heave), down_velocity: down };
        Ok(Seapath23 {
            time,
            place: PLACE.rate(status, place_of(position, [north, east]))?,
            tilt: TILT.rate(status, Ok(Tilt { roll, pitch }))?,
            heading: HEADING.rate(status, Ok(heading))?,
            vertical: VERTICAL.rate(status, Ok(vertical))?,
            rates,
        })
    }
}

impl Seapath26 {
    /// Writes the telegram; what cannot be written is treated as in [`Seapath23::write`].
    #[must_use]
    pub fn write(&self) -> Option<[u8; LENGTH_26]> {
        let (mut frame, mut status) = self.motion.body(HEADER_26)?;
        let delayed = self.delayed_heave.map(|value| Rated { value, reduced: false });
        let (seconds, fraction, heave) = DELAYED.encode(&mut status, delayed, |delayed| {
            let (seconds, fraction) = ticks_of(delayed.time)?;
            Some((seconds, fraction, fixed(opposite(delayed.heave), CENTI)?))
        });
        frame.be_i32(seconds).be_u16(fraction).be_i16(heave);
        sealed(frame, status).try_into().ok()
    }

    /// Reads the telegram. What its status calls invalid is `None`, whatever the numbers.
    ///
    /// # Errors
    /// As [`Seapath23::read`].
    pub fn read(bytes: &[u8]) -> Result<Self, BinaryFault> {
        let (mut reader, status) = opened::<LENGTH_26>(bytes, HEADER_26)?;
        let motion = Seapath23::of_body(&mut reader, status)?;
        let time = time_of(reader.be_i32()?, i64::from(reader.be_u16()?) * TICK);
        let [heave]: [f64; 1] = numbers(&mut reader, CENTI)?;
        let delayed = DELAYED
            .rate(status, time.map(|time| SensorDelayedHeave { time, heave: opposite(heave) }))?;
        Ok(Seapath26 { motion, delayed_heave: delayed.map(|delayed| delayed.value) })
    }
}

/// Appends status and checksum.
fn sealed(mut frame: Writer, status: u32) -> Vec<u8> {
    frame.be_u16(status as u16);
    let crc = CRC.checksum(frame.bytes().get(HEADER_23.len()..).unwrap_or_default());
    frame.le_u16(crc);
    frame.into_bytes()
}

/// A reader behind the header, and the status, of a frame whose checksum holds.
fn opened<const N: usize>(bytes: &[u8], header: [u8; 2]) -> Result<(Reader<'_>, u32), BinaryFault> {
    let frame: &[u8; N] = whole(bytes)?;
    let body = frame.strip_prefix(&header).ok_or(BinaryFault::Frame)?;
    let (body, crc) = body.split_last_chunk::<2>().ok_or(BinaryFault::Frame)?;
    if CRC.checksum(body) != u16::from_le_bytes(*crc) {
        return Err(BinaryFault::Frame);
    }
    let (_, status) = body.split_last_chunk::<2>().ok_or(BinaryFault::Frame)?;
    Ok((Reader::new(body), u16::from_be_bytes(*status).into()))
}

fn place(place: &SensorPlace) -> Option<([i32; 3], [i16; 2])> {
    let latitude = fixed(within(place.latitude, FRAC_PI_2)?, POSITION)?;
    // 180 deg east is written as 180 deg west, which the field holds
    let longitude = scaled(half_turn(place.longitude)?, POSITION) as i32;
    let height = fixed(place.height, CENTI)?;
    let velocity = [fixed(place.north_velocity, CENTI)?, fixed(place.east_velocity, CENTI)?];
    Some(([latitude, longitude, height], velocity))
}

fn place_of(position: [i32; 3], [north, east]: [f64; 2]) -> Result<SensorPlace, BinaryFault> {
    let [latitude, longitude, height] = position.map(f64::from);
    Ok(SensorPlace {
        latitude: within(latitude * POSITION, FRAC_PI_2)
            .ok_or(BinaryFault::Range { field: "latitude" })?,
        longitude: longitude * POSITION,
        height: height * CENTI,
        north_velocity: north,
        east_velocity: east,
    })
}

fn tilt(tilt: &Tilt) -> Option<[i16; 2]> {
    // half a turn is written as minus half a turn, which the field holds
    let (roll, pitch) = (half_turn(tilt.roll)?, half_turn(tilt.pitch)?);
    Some([roll, pitch].map(|angle| scaled(angle, ANGLE) as i16))
}

/// A heading; half a unit below the full turn is north.
fn direction(heading: f64) -> Option<u16> {
    heading.is_finite().then(|| scaled(wrap_two_pi(heading), ANGLE) as u16)
}

/// Whole seconds since 1970 and units of the fraction, to the nearest unit: what rounds up to a full
/// second is the next second.
fn ticks_of(time: UtcTime) -> Option<(i32, u16)> {
    let ticks = time.as_nanos().saturating_add(TICK / 2).div_euclid(TICK);
    Some((ticks.div_euclid(TICKS).try_into().ok()?, ticks.rem_euclid(TICKS) as u16))
}

fn shorts(values: [f64; 3], unit: f64) -> Option<[i16; 3]> {
    let [x, y, z] = values;
    Some([fixed(x, unit)?, fixed(y, unit)?, fixed(z, unit)?])
}

fn numbers<const N: usize>(reader: &mut Reader<'_>, unit: f64) -> Result<[f64; N], BinaryFault> {
    let mut values = [0.0; N];
    for value in &mut values {
        *value = f64::from(reader.be_i16()?) * unit;
    }
    Ok(values)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Format 11 of a ship: one byte of header, the same checksum.
    const FORMAT_11: [u8; 42] = [
        113, 0, 0, 4, 255, 85, 227, 42, 46, 180, 32, 55, 61, 18, 0, 0, 0, 2, 0, 0, 0, 15, 255, 255,
        0, 0, 0, 102, 255, 248, 184, 85, 0, 0, 0, 0, 0, 0, 0, 0, 28, 176,
    ];

    #[test]
    fn the_checksum_is_that_of_a_telegram_of_a_ship() {
        let (body, crc) = FORMAT_11.split_last_chunk::<2>().unwrap();
        assert_eq!(CRC.checksum(&body[1..]), u16::from_le_bytes(*crc));
    }

    #[test]
    fn a_time_is_rounded_to_the_nearest_tick_and_never_splits_a_second() {
        let ticks = |nanos| ticks_of(UtcTime::from_nanos(nanos));
        assert_eq!(ticks(1_999_949_999), Some((1, 9_999)));
        assert_eq!(ticks(1_999_950_000), Some((2, 0)));
        assert_eq!(ticks(-1), Some((0, 0)));
        assert_eq!(ticks(-60_000), Some((-1, 9_999)));
        let last = i64::from(i32::MAX) * 1_000_000_000 + 999_900_000;
        assert_eq!(ticks(last), Some((i32::MAX, 9_999)));
        assert_eq!(ticks(last + 100_000), None);
        assert_eq!(ticks(i64::MAX), None);
    }
}
