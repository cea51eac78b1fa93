//! THS: true heading and status. It replaces HDT.
//!
//! ```text
//! $HETHS,x.x,a*hh
//!        1   2
//! 1 heading, deg true
//! 2 mode: A autonomous, E estimated, M manual, S simulator, V not valid; never empty
//! ```

use super::fault::Fault;
use super::frame::Frame;
use super::line::{Line, Talker};
use super::mode::HeadingMode;

/// Heading with its mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ths {
    /// Heading, rad, clockwise from true north.
    pub heading: Option<f64>,
    /// How it was found.
    pub mode: HeadingMode,
}

impl Ths {
    /// The three letters after the talker.
    pub const FORMATTER: &'static str = "THS";

    /// Bytes of the longest sentence with a ship's values, CR LF included.
    pub const LONGEST: usize = 20;

    /// Writes the sentence, heading to 0.01 deg.
    #[must_use]
    pub fn write(&self, talker: Talker) -> Line {
        Line::compose(talker, Self::FORMATTER, |line| {
            line.degrees(self.heading, 2);
            line.letter(self.mode.letter());
        })
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`Fault`] of its fields.
    pub fn read(frame: &Frame<'_>) -> Result<Self, Fault> {
        let mut fields = frame.fields_of(Self::FORMATTER)?;
        let heading = fields.degrees()?;
        let mode = fields.letter()?.and_then(HeadingMode::from_letter);
        Ok(Ths { heading, mode: mode.ok_or_else(|| fields.malformed())? })
    }
}
