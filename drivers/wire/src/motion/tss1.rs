//! TSS1: accelerations, heave, roll and pitch as a line of 27 characters.
//!
//! ```text
//! :XXAAAA MHHHHQMRRRR MPPPP<CR><LF>
//! XX     horizontal acceleration, two digits hex, 0.03835 m/s^2, no sign
//! AAAA   vertical acceleration, four digits hex, two's complement, 0.000625 m/s^2, up positive
//! MHHHH  heave, cm, up positive           M is a blank, or - if the value is negative
//! Q      aiding of the sensor, in capitals once it has settled (Tss1Aiding)
//! MRRRR  roll, 0.01 deg, port up positive, against the horizon (see roll_from_horizon)
//! MPPPP  pitch, 0.01 deg, bow up positive
//! ```
//!
//! No checksum, no time, and **no way to say that a value is unknown**: the struct has all of them, and
//! whoever does not know one sends nothing. A letter that is not a capital says "do not trust this yet",
//! it does not say "unknown".
//!
//! What the accelerations are differs: of the published samples, those of NovAtel have no gravity in the
//! vertical one, those of the F180R have; Seapath always sends `:000000`. Some makers call the
//! horizontal one sway.
//!
//! Sources: `doc/thirdPartyMessages.md` of SBG Systems' sbgECom; the TSS1 pages of Norwegian Subsea and
//! of NovAtel OEM7; the ES80 and FS70 manuals of Simrad, which read it; Kongsberg Seapath 320
//! installation manual, A.12. Verified against the published lines of SBG Systems, NovAtel and Coda
//! Octopus (F180R).

use insd_base::units::DEG;

use super::{fixed, whole};
use crate::binary::{BinaryFault, Reader};
use crate::stream::Look;

/// Bytes of the telegram.
pub const LENGTH: usize = 27;

/// Unit of the horizontal acceleration, m/s^2.
const HORIZONTAL: f64 = 0.038_35;
/// Unit of the vertical acceleration, m/s^2.
const VERTICAL: f64 = 0.000_625;
/// Unit of heave, m.
const CENTIMETRE: f64 = 0.01;
/// Unit of angles, rad.
const ANGLE: f64 = 0.01 * DEG;
/// Largest number of four digits.
const LARGEST: u16 = 9999;

/// What stands at the start of some bytes: a telegram by the place of its colon and its line end and by all its characters, as there is no
/// checksum.
#[must_use]
pub fn look(bytes: &[u8]) -> Look {
    if bytes.first() != Some(&b':') {
        return Look::Nothing;
    }
    let shape = bytes.iter().zip(0..LENGTH).all(|(byte, place)| fits(*byte, place));
    match bytes.get(..LENGTH) {
        _ if !shape => Look::Nothing,
        None => Look::More(LENGTH),
        Some(telegram) if Tss1::read(telegram).is_ok() => Look::Frame(LENGTH),
        Some(_) => Look::Nothing,
    }
}

/// Whether a character can stand at its place.
fn fits(byte: u8, place: usize) -> bool {
    match place {
        0 => byte == b':',
        1..=6 => byte.is_ascii_hexdigit(),
        7 | 19 => byte == b' ',
        8 | 14 | 20 => matches!(byte, b' ' | b'-'),
        13 => Tss1Aiding::of_letter(byte).is_some(),
        25 => byte == b'\r',
        26 => byte == b'\n',
        _ => byte.is_ascii_digit(),
    }
}

/// What helps the sensor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Tss1Aiding {
    /// U: nothing.
    Unaided,
    /// G: the ship's speed.
    Speed,
    /// H: the ship's heading.
    Heading,
    /// F: both.
    Full,
}

/// The telegram. Every value is needed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tss1 {
    /// Horizontal acceleration, m/s^2, 0 to 9.78. The field has no sign: the magnitude is written.
    pub horizontal_acceleration: f64,
    /// Vertical acceleration, m/s^2, up positive, without gravity; -20.48 to 20.48.
    pub vertical_acceleration: f64,
    /// Heave, m, up positive; -99.99 to 99.99.
    pub heave: f64,
    /// What helps the sensor.
    pub aiding: Tss1Aiding,
    /// Whether it has settled: capital letter.
    pub settled: bool,
    /// Roll, rad, starboard down positive, by the format's definition **against the horizon**
    /// ([`roll_from_horizon`](super::roll_from_horizon)); -99.99 to 99.99 deg.
    pub roll: f64,
    /// Pitch, rad, bow up positive; -99.99 to 99.99 deg.
    pub pitch: f64,
}

impl Tss1 {
    /// Writes the telegram; `None` if a value is out of the range of its field or not finite.
    #[must_use]
    pub fn write(&self) -> Option<[u8; LENGTH]> {
        let horizontal: u8 = fixed(self.horizontal_acceleration.abs(), HORIZONTAL)?;
        let vertical: i16 = fixed(self.vertical_acceleration, VERTICAL)?;
        let heave = decimal(self.heave, CENTIMETRE)?;
        let (roll, pitch) = (decimal(self.roll, ANGLE)?, decimal(self.pitch, ANGLE)?);
        let letter = self.aiding.letter(self.settled);
        let text = format!(":{horizontal:02X}{vertical:04X} {heave}{letter}{roll} {pitch}\r\n");
        text.into_bytes().try_into().ok()
    }

    /// Reads the telegram.
    ///
    /// # Errors
    /// [`BinaryFault::Short`]; [`BinaryFault::Frame`] if it does not have the shape.
    pub fn read(bytes: &[u8]) -> Result<Self, BinaryFault> {
        let frame: &[u8; LENGTH] = whole(bytes)?;
        let [b':', inner @ .., b'\r', b'\n'] = frame else { return Err(BinaryFault::Frame) };
        let mut reader = Reader::new(inner);
        let horizontal = hexadecimal(reader.take(2)?)?;
        let vertical = hexadecimal(reader.take(4)?)?.cast_signed();
        blank(&mut reader)?;
        let heave = number(reader.array()?)?;
        let (aiding, settled) = Tss1Aiding::of_letter(reader.u8()?).ok_or(BinaryFault::Frame)?;
        let roll = number(reader.array()?)?;
        blank(&mut reader)?;
        let pitch = number(reader.array()?)?;
        Ok(Tss1 {
            horizontal_acceleration: f64::from(horizontal) * HORIZONTAL,
            vertical_acceleration: f64::from(vertical) * VERTICAL,
            heave: heave * CENTIMETRE,
            aiding,
            settled,
            roll: roll * ANGLE,
            pitch: pitch * ANGLE,
        })
    }
}

impl Tss1Aiding {
    fn letter(self, settled: bool) -> char {
        let capital = match self {
            Tss1Aiding::Unaided => 'U',
            Tss1Aiding::Speed => 'G',
            Tss1Aiding::Heading => 'H',
            Tss1Aiding::Full => 'F',
        };
        if settled { capital } else { capital.to_ascii_lowercase() }
    }

    fn of_letter(letter: u8) -> Option<(Self, bool)> {
        let aiding = match letter.to_ascii_uppercase() {
            b'U' => Tss1Aiding::Unaided,
            b'G' => Tss1Aiding::Speed,
            b'H' => Tss1Aiding::Heading,
            b'F' => Tss1Aiding::Full,
            _ => return None,
        };
        Some((aiding, letter.is_ascii_uppercase()))
    }
}

/// Sign and four digits; nothing that is rounded to zero has a minus.
fn decimal(value: f64, unit: f64) -> Option<String> {
    let number: i16 = fixed(value, unit)?;
    let sign = if number < 0 { '-' } else { ' ' };
    let digits = number.unsigned_abs();
    (digits <= LARGEST).then(|| format!("{sign}{digits:04}"))
}

fn number([sign, digits @ ..]: [u8; 5]) -> Result<f64, BinaryFault> {
    let mut magnitude = 0;
    for digit in digits {
        let digit = char::from(digit).to_digit(10).ok_or(BinaryFault::Frame)?;
        magnitude = magnitude * 10 + i32::try_from(digit).map_err(|_| BinaryFault::Frame)?;
    }
    match sign {
        b' ' => Ok(f64::from(magnitude)),
        b'-' => Ok(f64::from(-magnitude)),
        _ => Err(BinaryFault::Frame),
    }
}

fn hexadecimal(digits: &[u8]) -> Result<u16, BinaryFault> {
    let mut number = 0;
    for digit in digits {
        let digit = char::from(*digit).to_digit(16).ok_or(BinaryFault::Frame)?;
        number = (number << 4) | u16::try_from(digit).map_err(|_| BinaryFault::Frame)?;
    }
    Ok(number)
}

fn blank(reader: &mut Reader<'_>) -> Result<(), BinaryFault> {
    if reader.u8()? == b' ' { Ok(()) } else { Err(BinaryFault::Frame) }
}
