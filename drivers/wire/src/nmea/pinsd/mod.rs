//! PINSD: insd's own sentences.
//!
//! What an operator tells insd; both hold at the moment of receipt:
//! ```text
//! $PINSD,FIX,ddmm.mmmmm,N,dddmm.mmmmm,E,x.x*hh   a position and its 1-sigma, m
//! $PINSD,HDG,x.xx,x.xx*hh                        a true heading and its 1-sigma, deg
//! ```
//! What a docking aid tells insd that has no sentence of its own:
//! ```text
//! $PINSD,RNG,...   a distance to a line or a point ashore   [PinsdRange]
//! ```
//! What the front end of a camera tells insd:
//! ```text
//! $PINSD,TRK,...   points that are followed from image to image   [PinsdTracks]
//! $PINSD,VO,...    how the camera moved between two images        [PinsdStep]
//! ```
//! What insd tells others, in their files:
//! ```text
//! $PINSD,STA,...   what it does and how good that is    [PinsdStatus]
//! $PINSD,SIG,...   1-sigma of the solution              [PinsdSigma]
//! $PINSD,ALI,...   how the alignment gets on            [PinsdAlignment]
//! $PINSD,PRO,...   protection levels                    [PinsdProtection]
//! $PINSD,BTH,...   how she stands to a berth            [PinsdBerth]
//! $PINSD,DOK,...   and each part of her                 [PinsdPartOfShip]
//! ```
//! None but those of a camera is longer than the 82 bytes of the standard. A field that is unknown is empty. Later versions may
//! append fields, and readers ignore what they do not know. `docs/pinsd.md` says the same to people.

mod alignment;
mod camera;
mod docking;
mod protection;
mod ranging;
mod sigma;
mod status;

pub use alignment::{PinsdAlignment, PinsdPhase};
pub use camera::{PinsdStep, PinsdTracks, TRACK_NUMBERS, TRACK_SENTENCES, TRACKED, TrackedPoint};
pub use docking::{PinsdBerth, PinsdChoice, PinsdDocking, PinsdPart, PinsdPartOfShip, PinsdSide};
pub use protection::{PinsdProtection, ProtectionState};
pub use ranging::PinsdRange;
pub use sigma::PinsdSigma;
pub use status::{PinsdIntegrity, PinsdMode, PinsdSource, PinsdStatus, PinsdTime};

use super::decimal::Form;
use super::fault::NmeaFault;
use super::frame::Frame;
use super::line::NmeaLine;
use super::position::Position;

/// Decimals of minutes: 0.02 m.
const MINUTES: u8 = 5;
const METRES: Form = Form { decimals: 1, width: 1, limit: 99_999.9 };
const DEGREES: Form = Form { decimals: 2, width: 1, limit: 180.0 };

/// One of the PINSD sentences.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pinsd {
    /// FIX: where the ship is, as the operator says.
    Fix {
        /// Latitude and longitude of the IMU.
        position: Option<Position>,
        /// 1-sigma of each horizontal component, m.
        std: Option<f64>,
    },
    /// HDG: which way she points, as the operator says.
    Heading {
        /// Heading, rad, clockwise from true north.
        heading: Option<f64>,
        /// 1-sigma, rad.
        std: Option<f64>,
    },
    /// RNG.
    Range(PinsdRange),
    /// TRK.
    Tracks(PinsdTracks),
    /// VO.
    Step(PinsdStep),
    /// STA.
    Status(PinsdStatus),
    /// SIG.
    Sigma(PinsdSigma),
    /// ALI.
    Alignment(PinsdAlignment),
    /// PRO.
    Protection(PinsdProtection),
    /// BTH.
    Berth(PinsdBerth),
    /// DOK.
    Part(PinsdPartOfShip),
}

impl Pinsd {
    /// All before the first comma.
    pub const ADDRESS: &'static str = "PINSD";

    /// Greatest length of any of them that insd tells, bytes with CR LF.
    pub const LONGEST: usize = 82;

    /// Writes the sentence; minutes to 0.00001, sigmas of the operator to 0.1 m and 0.01 deg.
    #[must_use]
    pub fn write(&self) -> NmeaLine {
        NmeaLine::compose_own(Self::ADDRESS, |line| match self {
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
            Pinsd::Range(range) => {
                line.text(PinsdRange::NAME);
                range.write_fields(line);
            }
            Pinsd::Tracks(tracks) => {
                line.text(PinsdTracks::NAME);
                tracks.write_fields(line);
            }
            Pinsd::Step(step) => {
                line.text(PinsdStep::NAME);
                step.write_fields(line);
            }
            Pinsd::Status(status) => {
                line.text(PinsdStatus::NAME);
                status.write_fields(line);
            }
            Pinsd::Sigma(sigma) => {
                line.text(PinsdSigma::NAME);
                sigma.write_fields(line);
            }
            Pinsd::Alignment(alignment) => {
                line.text(PinsdAlignment::NAME);
                alignment.write_fields(line);
            }
            Pinsd::Protection(protection) => {
                line.text(PinsdProtection::NAME);
                protection.write_fields(line);
            }
            Pinsd::Berth(berth) => {
                line.text(PinsdBerth::NAME);
                berth.write_fields(line);
            }
            Pinsd::Part(part) => {
                line.text(PinsdPartOfShip::NAME);
                part.write_fields(line);
            }
        })
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`NmeaFault`] of its fields; [`NmeaFault::OtherSentence`] for a word that is not in the list.
    pub fn read(frame: &Frame<'_>) -> Result<Self, NmeaFault> {
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
            PinsdRange::NAME => Pinsd::Range(PinsdRange::read_fields(&mut fields)?),
            PinsdTracks::NAME => Pinsd::Tracks(PinsdTracks::read_fields(&mut fields)?),
            PinsdStep::NAME => Pinsd::Step(PinsdStep::read_fields(&mut fields)?),
            PinsdStatus::NAME => Pinsd::Status(PinsdStatus::read_fields(&mut fields)?),
            PinsdSigma::NAME => Pinsd::Sigma(PinsdSigma::read_fields(&mut fields)?),
            PinsdAlignment::NAME => Pinsd::Alignment(PinsdAlignment::read_fields(&mut fields)?),
            PinsdProtection::NAME => Pinsd::Protection(PinsdProtection::read_fields(&mut fields)?),
            PinsdBerth::NAME => Pinsd::Berth(PinsdBerth::read_fields(&mut fields)?),
            PinsdPartOfShip::NAME => Pinsd::Part(PinsdPartOfShip::read_fields(&mut fields)?),
            _ => return Err(NmeaFault::OtherSentence),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nmea::Sentence;
    use crate::nmea::kinds::{Decimal, Kind, Significant};

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

    #[test]
    fn three_digits_are_kept_and_never_more_than_five_characters_written() {
        let text = |value: f64| {
            let kind = Significant(Decimal::magnitude(3, 99_999.0));
            let line = NmeaLine::compose_own("PX", |line| kind.write(line, &Some(value)));
            line.as_str().split([',', '*']).nth(1).unwrap().to_owned()
        };
        for (value, written) in [
            (0.0, "0.000"),
            (0.9994, "0.999"),
            (0.9996, "1.00"),
            (9.996, "10.0"),
            (99.94, "99.9"),
            (99.96, "100"),
            (12_345.6, "12346"),
            (-1.0, ""),
            (1e6, ""),
        ] {
            assert_eq!(text(value), written, "{value}");
        }
    }
}
