//! VDR: set and drift, the water's own movement.
//!
//! ```text
//! $VDVDR,x.x,T,x.x,M,x.x,N*hh
//!        1   2 3   4 5   6
//! 1, 2 direction in which the water moves, deg true
//! 3, 4 the same, deg magnetic
//! 5, 6 speed of the water, knots
//! ```

use insd_base::units::KNOT;

use super::decimal::Form;
use super::fault::Fault;
use super::frame::Frame;
use super::line::{Line, Talker};

const SPEED: Form = Form { decimals: 2, width: 1, limit: 99.9 };

/// Set and drift.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Vdr {
    /// Direction in which the water moves, rad, clockwise from true north.
    pub set: Option<f64>,
    /// The same, rad, clockwise from magnetic north.
    pub set_magnetic: Option<f64>,
    /// Speed of the water, m/s.
    pub drift: Option<f64>,
}

impl Vdr {
    /// The three letters after the talker.
    pub const FORMATTER: &'static str = "VDR";

    /// Bytes of the longest sentence with a ship's values, CR LF included.
    pub const LONGEST: usize = 37;

    /// Writes the sentence: directions to 0.01 deg, speed to 0.01 kn.
    #[must_use]
    pub fn write(&self, talker: Talker) -> Line {
        Line::compose(talker, Self::FORMATTER, |line| {
            line.degrees(self.set, 2);
            line.letter(b'T');
            line.degrees(self.set_magnetic, 2);
            line.letter(b'M');
            line.magnitude(self.drift.map(|drift| drift / KNOT), SPEED);
            line.letter(b'N');
        })
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`Fault`] of its fields.
    pub fn read(frame: &Frame<'_>) -> Result<Self, Fault> {
        let mut fields = frame.fields_of(Self::FORMATTER)?;
        let set = fields.optional(|own| own.degrees_with("T"))?;
        let set_magnetic = fields.optional(|own| own.degrees_with("M"))?;
        let knots = fields.optional(|own| own.with_unit(0.0..=SPEED.limit, "N"))?;
        Ok(Vdr { set, set_magnetic, drift: knots.map(|knots| knots * KNOT) })
    }
}
