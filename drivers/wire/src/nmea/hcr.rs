//! HCR: which corrections a gyro compass has made to its heading.
//!
//! ```text
//! $HEHCR,x.x,a,a,x.x*hh
//!        1   2 3 4
//! 1 heading, deg true
//! 2 mode: A autonomous, E estimated, M manual, S simulator, V not valid; never empty
//! 3 corrections in the heading: A for speed and latitude and for acceleration, D for acceleration
//!   (dynamic), S for speed and latitude, N none, V not known; never empty
//! 4 their sum, deg
//! ```
//! The example of a Kongsberg MGC R3 is read by a test; the letters of field 3 are those of two public
//! parsers. Which way field 4 is positive is not stated where we could look.

use super::alert::lettered;
use super::decimal::Form;
use super::fault::Fault;
use super::frame::Frame;
use super::line::{Line, Talker};
use super::mode::{HeadingMode, letters};

const CORRECTION: Form = Form { decimals: 1, width: 1, limit: 180.0 };

/// Corrections that a heading has in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum HeadingCorrections {
    /// A: for speed and latitude, and for acceleration.
    Both,
    /// D: for acceleration.
    Dynamic,
    /// S: for speed and latitude.
    SpeedLatitude,
    /// N.
    Uncorrected,
    /// V: the talker does not know.
    Unknown,
}

letters! {
    HeadingCorrections {
        Both b'A', Dynamic b'D', SpeedLatitude b'S', Uncorrected b'N', Unknown b'V'
    }
}

/// A heading and its corrections.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hcr {
    /// Heading, rad, clockwise from true north.
    pub heading: Option<f64>,
    /// How it was found.
    pub mode: HeadingMode,
    /// Which corrections are in it.
    pub corrections: HeadingCorrections,
    /// Their sum as it was sent, rad.
    pub correction: Option<f64>,
}

impl Hcr {
    /// The three letters after the talker.
    pub const FORMATTER: &'static str = "HCR";

    /// Bytes of the longest sentence, CR LF included, with a correction below 100 deg.
    pub const LONGEST: usize = 27;

    /// Writes the sentence, both angles to 0.1 deg.
    #[must_use]
    pub fn write(&self, talker: Talker) -> Line {
        Line::compose(talker, Self::FORMATTER, |line| {
            line.degrees(self.heading, 1);
            line.letter(self.mode.letter());
            line.letter(self.corrections.letter());
            line.number(self.correction.map(f64::to_degrees), CORRECTION);
        })
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`Fault`] of its fields.
    pub fn read(frame: &Frame<'_>) -> Result<Self, Fault> {
        let mut fields = frame.fields_of(Self::FORMATTER)?;
        let heading = fields.degrees()?;
        let mode = lettered(&mut fields, HeadingMode::from_letter)?;
        let mode = mode.ok_or_else(|| fields.malformed())?;
        let corrections = lettered(&mut fields, HeadingCorrections::from_letter)?;
        let corrections = corrections.ok_or_else(|| fields.malformed())?;
        let correction = fields.number_in(-CORRECTION.limit..=CORRECTION.limit)?;
        Ok(Hcr { heading, mode, corrections, correction: correction.map(f64::to_radians) })
    }
}
