//! HDT: heading, true.
//!
//! ```text
//! $HEHDT,x.x,T*hh
//!        1   2
//! 1 heading, deg true
//! 2 T, fixed
//! ```
//! It has no status: a talker that is unsure of its heading must stop sending it. THS replaces it.

use super::fault::Fault;
use super::frame::Frame;
use super::line::{Line, Talker};

/// Heading without any word on its quality.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hdt {
    /// Heading, rad, clockwise from true north.
    pub heading: Option<f64>,
}

impl Hdt {
    /// The three letters after the talker.
    pub const FORMATTER: &'static str = "HDT";

    /// Bytes of the longest sentence with a ship's values, CR LF included.
    pub const LONGEST: usize = 20;

    /// Writes the sentence, heading to 0.01 deg.
    #[must_use]
    pub fn write(&self, talker: Talker) -> Line {
        Line::compose(talker, Self::FORMATTER, |line| {
            line.degrees(self.heading, 2);
            line.letter(b'T');
        })
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`Fault`] of its fields.
    pub fn read(frame: &Frame<'_>) -> Result<Self, Fault> {
        let mut fields = frame.fields_of(Self::FORMATTER)?;
        let heading = fields.degrees()?;
        fields.fixed("T")?;
        Ok(Hdt { heading })
    }
}
