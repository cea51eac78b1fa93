//! PSXN: attitude, rates and quality of Seatex and Kongsberg units.
//!
//! ```text
//! $PSXN,20,q,q,q,q*hh           quality of horizontal position and velocity, of height and heave,
//!                               of heading, of roll and pitch: 0 normal, 1 reduced, 2 invalid
//! $PSXN,21,n*hh                 event: 1 the unit has started again
//! $PSXN,22,x.xx,x.xx*hh         calibration and short-term offset of the gyro compass, deg
//! $PSXN,23,x.xx,x.xx,x.xx,x.xx*hh  roll, pitch, heading, deg; heave, m
//! $PSXN,24,x.xx,x.xx,x.xx,x.xx*hh  roll, pitch, yaw rate, deg/s; vertical velocity, m/s
//! ```
//! Signs: roll positive with port up, pitch with the bow up, heave and vertical velocity **down**.
//! Sentence 23 has no quality of its own: it holds as far as the last sentence 20 says.
//!
//! From the maker's manual (Seapath 320); sentences 20 and 23 verified against its published examples.

use super::decimal::Form;
use super::fault::NmeaFault;
use super::fields::Fields;
use super::frame::Frame;
use super::line::{Composer, NmeaLine};

const ANGLE: Form = Form { decimals: 2, width: 1, limit: 360.0 };
const RATE: Form = Form { decimals: 2, width: 1, limit: 9999.9 };
const HEAVE: Form = Form { decimals: 2, width: 1, limit: 999.9 };

/// How good a quantity is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PsxnQuality {
    /// 0.
    Normal,
    /// 1: reduced performance.
    Reduced,
    /// 2: invalid.
    Invalid,
}

/// One of the PSXN sentences.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Psxn {
    /// 20.
    Quality {
        /// Horizontal position and velocity; an unknown quality is written as invalid.
        horizontal: Option<PsxnQuality>,
        /// Height, heave and vertical velocity.
        height: Option<PsxnQuality>,
        /// Heading.
        heading: Option<PsxnQuality>,
        /// Roll and pitch.
        attitude: Option<PsxnQuality>,
    },
    /// 21.
    Event {
        /// 1: the unit has started again.
        event: u32,
    },
    /// 22.
    GyroOffsets {
        /// Calibration of the gyro compass, rad.
        calibration: Option<f64>,
        /// Its offset from the unit's own heading of late, rad.
        offset: Option<f64>,
    },
    /// 23.
    Motion {
        /// Roll, rad, starboard down positive.
        roll: Option<f64>,
        /// Pitch, rad, bow up positive.
        pitch: Option<f64>,
        /// Heading, rad, clockwise from true north.
        heading: Option<f64>,
        /// Heave, m, **down** positive.
        heave: Option<f64>,
    },
    /// 24.
    Rates {
        /// Roll rate, rad/s, starboard going down positive.
        roll_rate: Option<f64>,
        /// Pitch rate, rad/s, bow going up positive.
        pitch_rate: Option<f64>,
        /// Yaw rate, rad/s, bow turning to starboard positive.
        yaw_rate: Option<f64>,
        /// Vertical velocity, m/s, down positive.
        down_velocity: Option<f64>,
    },
}

impl Psxn {
    /// All before the first comma.
    pub const ADDRESS: &'static str = "PSXN";

    /// Bytes of the longest sentence with a ship's values, CR LF included.
    pub const LONGEST: usize = 42;

    /// Writes the sentence, to 0.01 of its units.
    #[must_use]
    pub fn write(&self) -> NmeaLine {
        NmeaLine::compose_own(Self::ADDRESS, |line| match self {
            Psxn::Quality { horizontal, height, heading, attitude } => {
                line.whole(Some(20), 2, 99);
                for quality in [horizontal, height, heading, attitude] {
                    line.letter(b'0' + quality.unwrap_or(PsxnQuality::Invalid) as u8);
                }
            }
            Psxn::Event { event } => {
                line.whole(Some(21), 2, 99);
                line.whole(Some(*event), 1, 9999);
            }
            Psxn::GyroOffsets { calibration, offset } => {
                line.whole(Some(22), 2, 99);
                degrees(line, &[*calibration, *offset], ANGLE);
            }
            Psxn::Motion { roll, pitch, heading, heave } => {
                line.whole(Some(23), 2, 99);
                degrees(line, &[*roll, *pitch], ANGLE);
                line.degrees(*heading, 2);
                line.number(*heave, HEAVE);
            }
            Psxn::Rates { roll_rate, pitch_rate, yaw_rate, down_velocity } => {
                line.whole(Some(24), 2, 99);
                degrees(line, &[*roll_rate, *pitch_rate, *yaw_rate], RATE);
                line.number(*down_velocity, HEAVE);
            }
        })
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`NmeaFault`] of its fields; [`NmeaFault::OtherSentence`] for other numbers than 20 to 24.
    pub fn read(frame: &Frame<'_>) -> Result<Self, NmeaFault> {
        let mut fields = frame.fields_of_own(Self::ADDRESS)?;
        let range = -HEAVE.limit..=HEAVE.limit;
        Ok(match fields.text()? {
            "20" => Psxn::Quality {
                horizontal: quality(&mut fields)?,
                height: quality(&mut fields)?,
                heading: quality(&mut fields)?,
                attitude: quality(&mut fields)?,
            },
            "21" => Psxn::Event { event: fields.whole(9999)?.ok_or_else(|| fields.malformed())? },
            "22" => Psxn::GyroOffsets {
                calibration: angle(&mut fields, ANGLE)?,
                offset: angle(&mut fields, ANGLE)?,
            },
            "23" => Psxn::Motion {
                roll: angle(&mut fields, ANGLE)?,
                pitch: angle(&mut fields, ANGLE)?,
                heading: fields.degrees()?,
                heave: fields.optional(|own| own.number_in(range))?,
            },
            "24" => Psxn::Rates {
                roll_rate: angle(&mut fields, RATE)?,
                pitch_rate: angle(&mut fields, RATE)?,
                yaw_rate: angle(&mut fields, RATE)?,
                down_velocity: fields.optional(|own| own.number_in(range))?,
            },
            _ => return Err(NmeaFault::OtherSentence),
        })
    }
}

fn degrees(line: &mut Composer, angles: &[Option<f64>], form: Form) {
    angles.iter().for_each(|angle| line.number(angle.map(f64::to_degrees), form));
}

fn angle(fields: &mut Fields<'_>, form: Form) -> Result<Option<f64>, NmeaFault> {
    let degrees = fields.optional(|own| own.number_in(-form.limit..=form.limit))?;
    Ok(degrees.map(f64::to_radians))
}

fn quality(fields: &mut Fields<'_>) -> Result<Option<PsxnQuality>, NmeaFault> {
    fields.convert(|text| match text {
        "0" => Some(PsxnQuality::Normal),
        "1" => Some(PsxnQuality::Reduced),
        "2" => Some(PsxnQuality::Invalid),
        _ => None,
    })
}
