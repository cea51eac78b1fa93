//! HDG: heading of a magnetic compass with deviation and variation.
//!
//! ```text
//! $HCHDG,x.x,x.x,a,x.x,a*hh
//!        1   2   3 4   5
//! 1    reading of the sensor, deg magnetic, uncorrected
//! 2, 3 deviation, deg, E or W
//! 4, 5 variation, deg, E or W
//! ```
//! East is added to the reading, west subtracted: reading + deviation is the magnetic heading, and
//! with the variation the true one. An empty variation is unknown, not zero, and one that is bad is left
//! out. A bad deviation is a fault: without it the reading is no heading.

use insd_base::units::wrap_two_pi;

use super::decimal::Form;
use super::fault::Fault;
use super::frame::Frame;
use super::line::{Line, Talker};

const CORRECTION: Form = Form { decimals: 1, width: 1, limit: 180.0 };

/// Heading of a magnetic compass.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Hdg {
    /// Reading of the sensor, rad, clockwise from compass north.
    pub reading: Option<f64>,
    /// Deviation, rad, east positive.
    pub deviation: Option<f64>,
    /// Variation, rad, east positive.
    pub variation: Option<f64>,
}

impl Hdg {
    /// The three letters after the talker.
    pub const FORMATTER: &'static str = "HDG";

    /// Bytes of the longest sentence with a ship's values, CR LF included.
    pub const LONGEST: usize = 34;

    /// Heading, rad, clockwise from true north, if the variation is known. A deviation that is not
    /// told is taken as corrected by the compass.
    #[must_use]
    pub fn true_heading(&self) -> Option<f64> {
        let corrections = self.deviation.unwrap_or(0.0) + self.variation?;
        self.reading.map(|reading| wrap_two_pi(reading + corrections))
    }

    /// Writes the sentence, reading to 0.01 deg, corrections to 0.1 deg.
    #[must_use]
    pub fn write(&self, talker: Talker) -> Line {
        Line::compose(talker, Self::FORMATTER, |line| {
            line.degrees(self.reading, 2);
            for correction in [self.deviation, self.variation] {
                line.signed(correction.map(f64::to_degrees), CORRECTION, [b'E', b'W']);
            }
        })
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`Fault`] of its fields.
    pub fn read(frame: &Frame<'_>) -> Result<Self, Fault> {
        let mut fields = frame.fields_of(Self::FORMATTER)?;
        Ok(Hdg {
            reading: fields.degrees()?,
            deviation: fields.signed(CORRECTION.limit, ["E", "W"])?.map(f64::to_radians),
            variation: fields
                .optional(|own| own.signed(CORRECTION.limit, ["E", "W"]))?
                .map(f64::to_radians),
        })
    }
}
