//! PFEC,GPatt: attitude of Furuno and JRC satellite compasses.
//!
//! ```text
//! $PFEC,GPatt,xxx.x,sxx.x,sxx.x      version 1.5
//! $PFEC,GPatt,xxx.x,sxx.x,sxx.x*hh   version 2.0
//!             2     3     4
//! 2 heading, deg true
//! 3 pitch, deg
//! 4 roll, deg
//! ```
//! From the makers' manuals (Furuno SC-120; Simrad SY50, which listens to it), and the layout verified
//! against published sentences. No manual that could be read states the signs: pitch is taken as
//! positive with the bow up and roll as positive with starboard down, as in the makers' displays; not
//! verified against a device.

use super::decimal::Form;
use super::fault::Fault;
use super::frame::Frame;
use super::line::Line;
use super::parts::{degrees_with_sign, heading, read_degrees};

const HEADING: Form = Form { decimals: 1, width: 3, limit: 360.0 };
const ANGLE: Form = Form { decimals: 1, width: 2, limit: 90.0 };

/// Attitude.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct PfecAttitude {
    /// Heading, rad, clockwise from true north.
    pub heading: Option<f64>,
    /// Pitch, rad, bow up positive.
    pub pitch: Option<f64>,
    /// Roll, rad, starboard down positive; beyond 90 deg either way it is unknown.
    pub roll: Option<f64>,
}

impl PfecAttitude {
    /// All before the first comma.
    pub const ADDRESS: &'static str = "PFEC";

    /// Greatest length, bytes with CR LF, of either version.
    pub const LONGEST: usize = 34;

    /// Writes the sentence of version 2.0, to 0.1 deg.
    #[must_use]
    pub fn write(&self) -> Line {
        Line::compose_own(Self::ADDRESS, |line| {
            line.text("GPatt");
            heading(line, self.heading, HEADING);
            degrees_with_sign(line, self.pitch, ANGLE);
            degrees_with_sign(line, self.roll, ANGLE);
        })
    }

    /// Writes the sentence of version 1.5, which has no checksum, to 0.1 deg.
    #[must_use]
    pub fn write_old(&self) -> Line {
        self.write().without_checksum()
    }

    /// Reads the sentence of either version.
    ///
    /// # Errors
    /// The first [`Fault`] of its fields; [`Fault::OtherSentence`] for another word than `GPatt`.
    pub fn read(frame: &Frame<'_>) -> Result<Self, Fault> {
        let mut fields = frame.fields_of_own(Self::ADDRESS)?;
        if fields.text()? != "GPatt" {
            return Err(Fault::OtherSentence);
        }
        let heading = fields.degrees()?;
        let pitch = read_degrees(&mut fields, ANGLE.limit)?;
        Ok(PfecAttitude { heading, pitch, roll: read_degrees(&mut fields, ANGLE.limit)? })
    }
}
