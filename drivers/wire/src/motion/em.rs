//! EM1000 and EM3000 (Kongsberg EM Attitude 1000 and 3000): roll, pitch, heave and heading in 10 bytes.
//!
//! ```text
//! byte 0     EM1000: 00; EM3000: status
//!            90 full accuracy, 91 to 99 reduced, 9A to 9F not valid but in order (aligning, heave
//!            unsettled, being configured), A0 to AF error of the sensor
//! byte 1     90
//! bytes 2-3  roll,    i16, 0.01 deg, port up positive, -17999 to 17999
//! bytes 4-5  pitch,   i16, 0.01 deg, bow up positive,  -17999 to 17999
//! bytes 6-7  heave,   i16, cm,       up positive,      -999 to 999
//! bytes 8-9  heading, u16, 0.01 deg, clockwise,        0 to 35999
//! ```
//!
//! Little endian; no checksum, no time. **A number out of its range is an unknown value**, which the
//! echo sounder rejects. Here the largest number that the field holds is written for one.
//! The heave of the EM systems ends at 9.99 m; SBG Systems describes up to 99.99 m in the same field,
//! which the EM systems would reject, so it is taken as unknown here, both ways.
//!
//! Roll is against the horizon by the maker's definition (see `roll_from_horizon`).
//!
//! Sources: Kongsberg Seatex Seapath 200 installation manual (2008), 6.3 and 6.4, where values out of
//! range are called invalid; the page "Kongsberg EM Attitude 3000" of Simrad's EK80 help;
//! `doc/thirdPartyMessages.md` of SBG Systems' sbgECom; Innomar SES manual. Verified against a telegram
//! of a ship in the tests of `ds_sensor_parsers`, whose angles agree there with another sensor's.

use insd_base::units::{DEG, wrap_two_pi};

use super::{fixed, whole};
use crate::binary::{BinaryFault, Reader, scaled};
use crate::stream::Look;

/// Bytes of the telegram.
pub const LENGTH: usize = 10;

const SYNC: u8 = 0x90;
/// First byte of EM1000.
const NO_STATUS: u8 = 0x00;
/// Unit of angles, rad.
const ANGLE: f64 = 0.01 * DEG;
/// Largest roll and pitch, units.
const LARGEST_ANGLE: u16 = 17_999;
/// Unit of heave, m.
const CENTIMETRE: f64 = 0.01;
/// Largest heave, units.
const LARGEST_HEAVE: u16 = 999;
/// Units of a full turn.
const TURN: u16 = 36_000;

/// What stands at the start of some bytes: a telegram of EM3000 by its first two bytes and the ranges of all its values, as there is no
/// checksum; of random bytes one in 400 000 begins a telegram. That of EM1000, which has no status, is not sought.
#[must_use]
pub fn look(bytes: &[u8]) -> Look {
    match bytes {
        [status, rest @ ..] if EmStatus::of_byte(*status).is_some() => match rest {
            [] => Look::More(2),
            [SYNC, ..] => bytes.get(..LENGTH).map_or(Look::More(LENGTH), within_ranges),
            _ => Look::Nothing,
        },
        _ => Look::Nothing,
    }
}

/// A telegram whose values are in their ranges, or the largest that their fields hold, by which they are unknown.
fn within_ranges(bytes: &[u8]) -> Look {
    let Ok(read) = EmAttitude::read(bytes) else { return Look::Nothing };
    let [_, _, r0, r1, p0, p1, h0, h1, d0, d1] = *bytes else { return Look::Nothing };
    let largest = |told: Option<f64>, low: u8, high: u8, unknown: [u8; 2]| {
        told.is_some() || [low, high] == unknown
    };
    let signed = i16::MAX.to_le_bytes();
    let good = largest(read.roll, r0, r1, signed)
        && largest(read.pitch, p0, p1, signed)
        && largest(read.heave, h0, h1, signed)
        && largest(read.heading, d0, d1, u16::MAX.to_le_bytes());
    if good { Look::Frame(LENGTH) } else { Look::Nothing }
}

/// What the sensor says of itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum EmStatus {
    /// 90: valid, full accuracy.
    Normal,
    /// 91: valid, reduced accuracy. 91 to 99 are read, of which larger is worse.
    Reduced,
    /// 9A: not valid, but the sensor is in order: it is aligning or its heave has not settled. 9A to 9F
    /// are read.
    Unsettled,
    /// A0: error of the sensor. A0 to AF are read. Seapath calls values within range valid still.
    Error,
}

/// The telegram.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmAttitude {
    /// Status; `None` is the telegram of EM1000, which has none.
    pub status: Option<EmStatus>,
    /// Roll, rad, starboard down positive, by the format's definition **against the horizon**
    /// ([`roll_from_horizon`](super::roll_from_horizon)).
    pub roll: Option<f64>,
    /// Pitch, rad, bow up positive.
    pub pitch: Option<f64>,
    /// Heave, m, up positive.
    pub heave: Option<f64>,
    /// Heading, rad in [0, 2 pi), clockwise from true north.
    pub heading: Option<f64>,
}

impl EmAttitude {
    /// Writes the telegram; values that are out of their range or not finite are written as unknown.
    #[must_use]
    pub fn write(&self) -> [u8; LENGTH] {
        let status = self.status.map_or(NO_STATUS, EmStatus::byte);
        let [r0, r1] = signed(self.roll, ANGLE, LARGEST_ANGLE);
        let [p0, p1] = signed(self.pitch, ANGLE, LARGEST_ANGLE);
        let [h0, h1] = signed(self.heave, CENTIMETRE, LARGEST_HEAVE);
        let [d0, d1] = turn(self.heading);
        [status, SYNC, r0, r1, p0, p1, h0, h1, d0, d1]
    }

    /// Reads the telegram.
    ///
    /// # Errors
    /// [`BinaryFault::Short`]; [`BinaryFault::Frame`] if the first two bytes are not of this format.
    pub fn read(bytes: &[u8]) -> Result<Self, BinaryFault> {
        let frame: &[u8; LENGTH] = whole(bytes)?;
        let mut reader = Reader::new(frame);
        let status = match reader.u8()? {
            NO_STATUS => None,
            byte => Some(EmStatus::of_byte(byte).ok_or(BinaryFault::Frame)?),
        };
        if reader.u8()? != SYNC {
            return Err(BinaryFault::Frame);
        }
        let mut signed = |unit: f64, largest: u16| {
            let number = reader.le_i16()?;
            Ok((number.unsigned_abs() <= largest).then_some(f64::from(number) * unit))
        };
        let roll = signed(ANGLE, LARGEST_ANGLE)?;
        let pitch = signed(ANGLE, LARGEST_ANGLE)?;
        let heave = signed(CENTIMETRE, LARGEST_HEAVE)?;
        let heading = reader.le_u16()?;
        let heading = (heading < TURN).then_some(f64::from(heading) * ANGLE);
        Ok(EmAttitude { status, roll, pitch, heave, heading })
    }
}

impl EmStatus {
    fn byte(self) -> u8 {
        match self {
            EmStatus::Normal => 0x90,
            EmStatus::Reduced => 0x91,
            EmStatus::Unsettled => 0x9A,
            EmStatus::Error => 0xA0,
        }
    }

    fn of_byte(byte: u8) -> Option<Self> {
        match byte {
            0x90 => Some(EmStatus::Normal),
            0x91..=0x99 => Some(EmStatus::Reduced),
            0x9A..=0x9F => Some(EmStatus::Unsettled),
            0xA0..=0xAF => Some(EmStatus::Error),
            _ => None,
        }
    }
}

fn signed(value: Option<f64>, unit: f64, largest: u16) -> [u8; 2] {
    let number = value.and_then(|value| fixed::<i16>(value, unit));
    let number = number.filter(|number| number.unsigned_abs() <= largest);
    number.unwrap_or(i16::MAX).to_le_bytes()
}

fn turn(heading: Option<f64>) -> [u8; 2] {
    let heading = heading.filter(|heading| heading.is_finite());
    let number = heading.map(|heading| {
        // half a unit below the full turn is north
        scaled(wrap_two_pi(heading), ANGLE).rem_euclid(i64::from(TURN)) as u16
    });
    number.unwrap_or(u16::MAX).to_le_bytes()
}
