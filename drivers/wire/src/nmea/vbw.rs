//! VBW: speed over ground and through the water, lengthwise and athwart.
//!
//! ```text
//! $VDVBW,x.x,x.x,A,x.x,x.x,A,x.x,A,x.x,A*hh
//!        1   2   3 4   5   6 7   8 9   10
//! 1, 2  speed through the water, lengthwise and athwart, knots; "-" is astern and to port
//! 3     A valid, V not valid
//! 4..6  speed over ground, in the same way
//! 7, 8  speed of the stern athwart through the water, and its status
//! 9, 10 speed of the stern athwart over ground, and its status
//! ```
//! The sentence of older editions ends after field 6, and units of SBG Systems still send it so. An
//! empty status is read as not valid, and so is a bad one; a speed that is bad is left out.

use insd_base::units::KNOT;

use super::decimal::Form;
use super::fault::NmeaFault;
use super::fields::Fields;
use super::frame::Frame;
use super::line::{Composer, NmeaLine, Talker};

const SPEED: Form = Form { decimals: 3, width: 1, limit: 999.9 };

/// A velocity of the ship with its status.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct VbwVelocity {
    /// Lengthwise, m/s, ahead positive.
    pub longitudinal: Option<f64>,
    /// Athwart, m/s, to starboard positive.
    pub transverse: Option<f64>,
    /// Whether it may be used. One without any speed is written as not valid.
    pub valid: bool,
}

/// A speed of the stern athwart with its status.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct VbwStern {
    /// Athwart, m/s, to starboard positive.
    pub transverse: Option<f64>,
    /// Whether it may be used. One without a speed is written as not valid.
    pub valid: bool,
}

/// Speed over ground and through the water.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Vbw {
    /// Through the water.
    pub water: VbwVelocity,
    /// Over ground.
    pub ground: VbwVelocity,
    /// Of the stern through the water.
    pub stern_water: VbwStern,
    /// Of the stern over ground.
    pub stern_ground: VbwStern,
    /// Whether the sentence ends before the stern, as in older editions.
    pub without_stern: bool,
}

impl Vbw {
    /// The three letters after the talker.
    pub const FORMATTER: &'static str = "VBW";

    /// Bytes of the longest sentence with a ship's values, CR LF included.
    pub const LONGEST: usize = 67;

    /// Writes the sentence, speeds to 0.001 kn: ten fields, or six without the stern.
    #[must_use]
    pub fn write(&self, talker: Talker) -> NmeaLine {
        NmeaLine::compose(talker, Self::FORMATTER, |line| {
            for velocity in [self.water, self.ground] {
                speeds(line, &[velocity.longitudinal, velocity.transverse], velocity.valid);
            }
            let sterns = [self.stern_water, self.stern_ground];
            for stern in sterns.iter().filter(|_| !self.without_stern) {
                speeds(line, &[stern.transverse], stern.valid);
            }
        })
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`NmeaFault`] of its fields.
    pub fn read(frame: &Frame<'_>) -> Result<Self, NmeaFault> {
        let mut fields = frame.fields_of(Self::FORMATTER)?;
        let mut vbw = Vbw {
            water: VbwVelocity::read(&mut fields)?,
            ground: VbwVelocity::read(&mut fields)?,
            ..Vbw::default()
        };
        vbw.without_stern = !fields.has_more();
        if !vbw.without_stern {
            vbw.stern_water = VbwStern::read(&mut fields)?;
            vbw.stern_ground = VbwStern::read(&mut fields)?;
        }
        Ok(vbw)
    }
}

impl VbwVelocity {
    fn read(fields: &mut Fields<'_>) -> Result<Self, NmeaFault> {
        let longitudinal = fields.optional(speed)?;
        let transverse = fields.optional(speed)?;
        Ok(VbwVelocity { longitudinal, transverse, valid: status(fields)? })
    }
}

impl VbwStern {
    fn read(fields: &mut Fields<'_>) -> Result<Self, NmeaFault> {
        Ok(VbwStern { transverse: fields.optional(speed)?, valid: status(fields)? })
    }
}

fn speeds(line: &mut Composer, speeds: &[Option<f64>], valid: bool) {
    let knots = |speed: &Option<f64>| speed.map(|speed| speed / KNOT);
    speeds.iter().for_each(|speed| line.number(knots(speed), SPEED));
    let known = speeds.iter().filter_map(knots).any(|knots| knots.abs() <= SPEED.limit);
    line.letter(if valid && known { b'A' } else { b'V' });
}

fn speed(fields: &mut Fields<'_>) -> Result<Option<f64>, NmeaFault> {
    let knots = fields.number_in(-SPEED.limit..=SPEED.limit)?;
    Ok(knots.map(|knots| knots * KNOT))
}

fn status(fields: &mut Fields<'_>) -> Result<bool, NmeaFault> {
    let status = fields.optional(|own| {
        own.convert(|text| match text {
            "A" => Some(true),
            "V" => Some(false),
            _ => None,
        })
    })?;
    Ok(status == Some(true))
}
