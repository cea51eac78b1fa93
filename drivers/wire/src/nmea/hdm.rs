//! HDM: heading, magnetic.
//!
//! ```text
//! $HCHDM,x.x,M*hh
//!        1   2
//! 1 heading, deg magnetic
//! 2 M, fixed
//! ```
//! It is not in the newer editions; HDG replaces it.

use super::fault::Fault;
use super::frame::Frame;
use super::line::{Line, Talker};

/// Magnetic heading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hdm {
    /// Heading, rad, clockwise from magnetic north.
    pub heading: Option<f64>,
}

impl Hdm {
    /// The three letters after the talker.
    pub const FORMATTER: &'static str = "HDM";

    /// Bytes of the longest sentence with a ship's values, CR LF included.
    pub const LONGEST: usize = 20;

    /// Writes the sentence, heading to 0.01 deg.
    #[must_use]
    pub fn write(&self, talker: Talker) -> Line {
        Line::compose(talker, Self::FORMATTER, |line| {
            line.degrees(self.heading, 2);
            line.letter(b'M');
        })
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`Fault`] of its fields.
    pub fn read(frame: &Frame<'_>) -> Result<Self, Fault> {
        let mut fields = frame.fields_of(Self::FORMATTER)?;
        let heading = fields.degrees()?;
        fields.fixed("M")?;
        Ok(Hdm { heading })
    }
}
