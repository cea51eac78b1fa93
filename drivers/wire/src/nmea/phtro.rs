//! PHTRO: pitch and roll of Octans, Phins and the units that speak like them.
//!
//! ```text
//! $PHTRO,x.xx,a,y.yy,b*hh
//!        1    2 3    4
//! 1, 2 pitch, deg: M with the bow up, P with the bow down
//! 3, 4 roll, deg: B with port down, T with port up
//! ```
//! From the makers' manuals (Octans in Reson SeaBat 8101, SBG Systems `nmeaMessages.md`), and verified
//! against records of Phins units.

use super::decimal::Form;
use super::fault::Fault;
use super::frame::Frame;
use super::line::Line;
use super::parts::lettered;

const ROLL: Form = Form { decimals: 2, width: 1, limit: 180.0 };
const PITCH: Form = Form { decimals: 2, width: 1, limit: 90.0 };

/// Pitch and roll.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Phtro {
    /// Roll, rad, starboard down positive.
    pub roll: Option<f64>,
    /// Pitch, rad, bow up positive.
    pub pitch: Option<f64>,
}

impl Phtro {
    /// All before the first comma.
    pub const ADDRESS: &'static str = "PHTRO";

    /// Greatest length, bytes with CR LF.
    pub const LONGEST: usize = 28;

    /// Writes the sentence, to 0.01 deg. An unknown angle and its letter are empty.
    #[must_use]
    pub fn write(&self) -> Line {
        Line::compose_own(Self::ADDRESS, |line| {
            lettered(line, self.pitch.map(f64::to_degrees), PITCH, [b'M', b'P']);
            lettered(line, self.roll.map(f64::to_degrees), ROLL, [b'T', b'B']);
        })
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`Fault`] of its fields.
    pub fn read(frame: &Frame<'_>) -> Result<Self, Fault> {
        let mut fields = frame.fields_of_own(Self::ADDRESS)?;
        let pitch = fields.signed(PITCH.limit, ["M", "P"])?.map(f64::to_radians);
        let roll = fields.signed(ROLL.limit, ["T", "B"])?.map(f64::to_radians);
        Ok(Phtro { roll, pitch })
    }
}
