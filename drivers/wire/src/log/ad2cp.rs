//! Nortek AD2CP: the bottom track record (0x17) of Signature instruments and of what records as they do.
//!
//! ```text
//! A5            start
//! 0A            bytes of the header
//! id            17 bottom track; others are framed and not read
//! family        10 for the AD2CP
//! length u16    of the data
//! sum u16       of the data
//! sum u16       of the header before it
//! data
//! ```
//!
//! Little endian; a sum is that of the 16-bit words, begun with B58C, a last single byte being the high one of a word. The data are a head
//! of 78 bytes, then, as the head's configuration has it, velocities, distances and figures of merit, one for each beam.
//!
//! Readers never panic, whatever the bytes. Source: Nortek's Integrators Guide for Signature as `dolfyn` 1.3 (BSD-3-Clause) has it, an
//! independent reader that agrees on the recordings named in the tests. In none of those had the instrument found the bottom. **Not
//! verified**: which way the velocity counts. It is taken as that of the instrument over the ground, as Nortek's sentences
//! ([`crate::nmea::NortekBottomTrack`]) have it.

use insd_base::LogReference;
use insd_base::units::DEG;

use super::{LogFrame, LogReading};
use crate::binary::{BinaryFault, Reader, Writer};
use crate::layout::{Each, layout, le};
use crate::stream::Look;

const START: u8 = 0xA5;
const HEADER: usize = 10;
const SEED: u16 = 0xB58C;
/// The family of the AD2CP and of Nortek's logs.
const FAMILIES: [u8; 2] = [0x10, 0x16];
/// The bottom track record.
pub const BOTTOM_TRACK: u8 = 0x17;
/// Bytes of its head.
const HEAD: usize = 78;
/// A figure of merit of a beam that has found no bottom.
const BAD: u16 = u16::MAX;
/// Beams that a record can have.
const BEAMS: usize = 4;
/// Metres of a distance's least bit.
const DISTANCE: f64 = 1e-3;
/// Bits of the configuration that tell what follows the head.
const VELOCITY_TOLD: u16 = 1 << 5;
const DISTANCE_TOLD: u16 = 1 << 8;
const MERIT_TOLD: u16 = 1 << 9;

/// What stands at the start of some bytes.
#[must_use]
pub fn look(bytes: &[u8]) -> Look {
    let mut known = bytes.iter().zip([START, HEADER as u8]);
    if !known.all(|(found, byte)| *found == byte) {
        return Look::Nothing;
    }
    if bytes.get(3).is_some_and(|family| !FAMILIES.contains(family)) {
        return Look::Nothing;
    }
    let Some((header, data)) = bytes.split_first_chunk::<HEADER>() else {
        return Look::More(HEADER);
    };
    let [head @ .., low, high] = header;
    if sum(head) != u16::from_le_bytes([*low, *high]) {
        return Look::Nothing;
    }
    let length = usize::from(u16::from_le_bytes([header[4], header[5]]));
    match data.get(..length) {
        None => Look::More(HEADER + length),
        Some(data) if sum(data) == u16::from_le_bytes([header[6], header[7]]) => {
            Look::Frame(HEADER + length)
        }
        Some(_) => Look::Damaged,
    }
}

fn sum(bytes: &[u8]) -> u16 {
    bytes.chunks(2).fold(SEED, |sum, word| match word {
        [low, high] => sum.wrapping_add(u16::from_le_bytes([*low, *high])),
        [single] => sum.wrapping_add(u16::from(*single) << 8),
        _ => sum,
    })
}

/// The frame of a record's data; what there is no room for is cut off.
#[must_use]
pub fn frame(id: u8, data: &[u8]) -> Vec<u8> {
    let data = data.get(..usize::from(u16::MAX)).unwrap_or(data);
    let mut writer = Writer::new();
    writer.put(&[START, HEADER as u8, id, FAMILIES[0]]).le_u16(data.len() as u16).le_u16(sum(data));
    let head = sum(writer.bytes());
    writer.le_u16(head).put(data);
    writer.into_bytes()
}

layout! {
    /// The head of a bottom track record.
    Ad2cpHead, 78 bytes;
    /// Version of the record: 1.
    0 version: u8 = le();
    /// Where the velocities begin.
    1 offset: u8 = le();
    /// What is valid and what is told: bit 5 velocities, 8 distances, 9 figures of merit.
    2 config: u16 = le();
    /// The instrument's serial number.
    4 serial: u32 = le();
    /// Year since 1900, month from 0 on, day, hour, minute, second of its own clock.
    8 clock: [u8; 6] = Each(le());
    /// Fraction of the second.
    14 fraction: f64 = le::<u16>().steps(1e-4);
    /// Speed of sound, m/s.
    16 sound_speed: f64 = le::<u16>().steps(0.1);
    /// Temperature of the water, deg C.
    18 temperature: f64 = le::<i16>().steps(0.01);
    /// Pressure, dbar.
    20 pressure: f64 = le::<u32>().steps(0.001);
    /// Heading by its own compass, rad.
    24 heading: f64 = le::<u16>().steps(0.01 * DEG);
    /// Pitch and roll, rad, as they stand.
    26 tilt: [f64; 2] = Each(le::<i16>().steps(0.01 * DEG));
    /// Cells (bits 0 to 9), axes (10 and 11: 0 east, north, up, 1 the instrument's, 2 along the beams), beams (12 to 15).
    30 beams: u16 = le();
    /// Battery, V.
    38 battery: f64 = le::<u16>().steps(0.1);
    /// Least bit of a velocity is ten to this power, m/s.
    60 exponent: i8 = le();
    /// Errors and status.
    66 error: u32 = le();
    /// Status.
    70 status: u32 = le();
    /// Number of the ensemble.
    74 ensemble: u32 = le();
}

/// A bottom track record. What it does not tell, or of which the instrument says that it is bad, is `None`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ad2cpBottomTrack {
    /// Its head.
    pub head: Ad2cpHead,
    /// Velocities in the axes of the head, m/s.
    pub velocity: [Option<f64>; BEAMS],
    /// Vertical distance to the bottom by each beam, m.
    pub distance: [Option<f64>; BEAMS],
    /// Figures of merit, as they stand.
    pub merit: [Option<u16>; BEAMS],
}

impl Ad2cpBottomTrack {
    /// Reads a record.
    ///
    /// # Errors
    /// [`BinaryFault::Frame`] if it is none, [`BinaryFault::OtherMessage`] if it is another one, else what is wrong with it.
    pub fn read(frame: &[u8]) -> Result<Self, BinaryFault> {
        if look(frame) != Look::Frame(frame.len()) {
            return Err(BinaryFault::Frame);
        }
        if frame.get(2) != Some(&BOTTOM_TRACK) {
            return Err(BinaryFault::OtherMessage);
        }
        let data = frame.get(HEADER..).unwrap_or_default();
        let head = Ad2cpHead::read_fields(data)?;
        let beams = usize::from(head.beams >> 12);
        if head.version != 1 || !(1..=BEAMS).contains(&beams) || !(-9..=9).contains(&head.exponent)
        {
            return Err(BinaryFault::Range { field: "version, beams or velocity scaling" });
        }
        let mut reader = Reader::new(data);
        reader.take(usize::from(head.offset).max(HEAD))?;
        let (raw, far) =
            (told(&mut reader, &head, VELOCITY_TOLD)?, told(&mut reader, &head, DISTANCE_TOLD)?);
        let mut merit = [None; BEAMS];
        if head.config & MERIT_TOLD != 0 {
            for own in merit.iter_mut().take(beams) {
                *own = Some(reader.le_u16()?).filter(|merit| *merit != BAD);
            }
        }
        let scale = 10_f64.powi(head.exponent.into());
        let mut velocity = [None; BEAMS];
        for ((own, raw), merit) in velocity.iter_mut().zip(raw).zip(merit) {
            *own = raw
                .filter(|raw| merit.is_some() && *raw != i32::MIN)
                .map(|raw| f64::from(raw) * scale);
        }
        let distance =
            far.map(|far| far.filter(|far| *far > 0).map(|far| f64::from(far) * DISTANCE));
        Ok(Ad2cpBottomTrack { head, velocity, distance, merit })
    }

    /// The record as a frame, with velocities, distances and figures of merit. What is unknown stands as the instrument has it.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let config = self.head.config | VELOCITY_TOLD | DISTANCE_TOLD | MERIT_TOLD;
        let head = Ad2cpHead { config, offset: HEAD as u8, ..self.head };
        let mut data = Writer::new();
        data.put(&head.write_fields());
        let beams = usize::from(head.beams >> 12).min(BEAMS);
        let scale = 10_f64.powi(head.exponent.into());
        for velocity in self.velocity.iter().take(beams) {
            data.le_i32(velocity.map_or(i32::MIN, |own| (own / scale).round() as i32));
        }
        for distance in self.distance.iter().take(beams) {
            data.le_i32(distance.map_or(-1, |own| (own / DISTANCE).round() as i32));
        }
        for merit in self.merit.iter().take(beams) {
            data.le_u16(merit.unwrap_or(BAD));
        }
        frame(BOTTOM_TRACK, data.bytes())
    }

    /// Its axes.
    #[must_use]
    pub fn frame(&self) -> Option<LogFrame> {
        match self.head.beams >> 10 & 3 {
            0 => Some(LogFrame::Earth),
            1 => Some(LogFrame::Instrument),
            2 => Some(LogFrame::Beam),
            _ => None,
        }
    }

    /// The velocity over ground. In the instrument's axes every beam is in every component, so all must have found the bottom; two vertical
    /// velocities are told by four beams, and their mean is taken. `None` in other axes, and where a beam has not.
    #[must_use]
    pub fn reading(&self) -> Option<LogReading> {
        let beams = usize::from(self.head.beams >> 12);
        let all = self.velocity.iter().take(beams).all(Option::is_some);
        let [x, y, z, other] = self.velocity;
        let up = if beams == BEAMS { z.zip(other).map(|(a, b)| 0.5 * (a + b)) } else { z };
        (all && beams >= 3 && self.frame() == Some(LogFrame::Instrument)).then_some(LogReading {
            velocity: [x, y, up, None],
            frame: LogFrame::Instrument,
            reference: LogReference::Bottom,
            std: None,
            utc: None,
            age: None,
        })
    }
}

/// One number for each beam, if they are told.
fn told(
    reader: &mut Reader<'_>,
    head: &Ad2cpHead,
    bit: u16,
) -> Result<[Option<i32>; BEAMS], BinaryFault> {
    let mut told = [None; BEAMS];
    if head.config & bit != 0 {
        for own in told.iter_mut().take(usize::from(head.beams >> 12)) {
            *own = Some(reader.le_i32()?);
        }
    }
    Ok(told)
}
