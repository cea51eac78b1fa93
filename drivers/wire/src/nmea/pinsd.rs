//! PINSD: what an operator tells insd.
//!
//! ```text
//! $PINSD,FIX,ddmm.mmmmm,N,dddmm.mmmmm,E,x.x*hh   a position and its 1-sigma, m
//! $PINSD,HDG,x.xx,x.xx*hh                        a true heading and its 1-sigma, deg
//! ```
//! Our own sentence. Both hold at the moment of receipt.

use super::decimal::Form;
use super::fault::Fault;
use super::frame::Frame;
use super::line::Line;
use super::position::Position;

/// Decimals of minutes: 0.02 m.
const MINUTES: u8 = 5;
const METRES: Form = Form { decimals: 1, width: 1, limit: 99_999.9 };
const DEGREES: Form = Form { decimals: 2, width: 1, limit: 180.0 };

/// What the operator says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pinsd {
    /// FIX: where the ship is.
    Fix {
        /// Latitude and longitude of the IMU.
        position: Option<Position>,
        /// 1-sigma of each horizontal component, m.
        std: Option<f64>,
    },
    /// HDG: which way she points.
    Heading {
        /// Heading, rad, clockwise from true north.
        heading: Option<f64>,
        /// 1-sigma, rad.
        std: Option<f64>,
    },
}

impl Pinsd {
    /// All before the first comma.
    pub const ADDRESS: &'static str = "PINSD";

    /// Writes the sentence: minutes to 0.00001, sigmas to 0.1 m and 0.01 deg.
    #[must_use]
    pub fn write(&self) -> Line {
        Line::compose_own(Self::ADDRESS, |line| match self {
            Pinsd::Fix { position, std } => {
                line.text("FIX");
                line.position(*position, MINUTES);
                line.number(*std, METRES);
            }
            Pinsd::Heading { heading, std } => {
                line.text("HDG");
                line.degrees(*heading, 2);
                line.number(std.map(f64::to_degrees), DEGREES);
            }
        })
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`Fault`] of its fields; [`Fault::OtherSentence`] for another word than FIX and HDG.
    pub fn read(frame: &Frame<'_>) -> Result<Self, Fault> {
        let mut fields = frame.fields_of_own(Self::ADDRESS)?;
        Ok(match fields.text()? {
            "FIX" => Pinsd::Fix {
                position: fields.position()?,
                std: fields.number_in(0.0..=METRES.limit)?,
            },
            "HDG" => Pinsd::Heading {
                heading: fields.degrees()?,
                std: fields.number_in(0.0..=DEGREES.limit)?.map(f64::to_radians),
            },
            _ => return Err(Fault::OtherSentence),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nmea::Sentence;

    #[test]
    fn what_the_operator_says_is_read_back() {
        let position = Position { latitude: 0.6, longitude: -2.4 };
        let fix = Pinsd::Fix { position: Some(position), std: Some(12.5) };
        let line = fix.write();
        let Ok((None, Sentence::Pinsd(Pinsd::Fix { position: Some(read), std }))) =
            Sentence::read(line.as_bytes())
        else {
            panic!("{line:?}");
        };
        assert!((read.latitude - 0.6).abs() < 4e-9 && (read.longitude + 2.4).abs() < 4e-9);
        assert_eq!(std, Some(12.5));
        let line = Pinsd::Heading { heading: Some(1.0), std: None }.write();
        assert!(line.as_str().starts_with("$PINSD,HDG,57.30,*"), "{line:?}");
    }
}
