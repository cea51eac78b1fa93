//! VHW: speed through the water and heading.
//!
//! ```text
//! $VMVHW,x.x,T,x.x,M,x.x,N,x.x,K*hh
//!        1   2 3   4 5   6 7   8
//! 1, 2 heading, deg true
//! 3, 4 heading, deg magnetic
//! 5, 6 speed through the water, knots
//! 7, 8 speed through the water, km/h
//! ```
//! It has no status, and cannot tell drift from headway. A value that is bad, or stands beside another
//! letter, is left out.

use insd_base::units::KNOT;

use super::decimal::Form;
use super::fault::Fault;
use super::frame::Frame;
use super::line::{Line, Talker};
use super::vtg::{KMH, as_told};

const SPEED: Form = Form { decimals: 2, width: 1, limit: 999.9 };

/// Speed through the water and heading.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Vhw {
    /// Heading, rad, clockwise from true north.
    pub heading: Option<f64>,
    /// Heading, rad, clockwise from magnetic north.
    pub heading_magnetic: Option<f64>,
    /// Speed through the water along the ship, m/s; some logs send negative values going astern.
    pub speed: Option<f64>,
}

impl Vhw {
    /// The three letters after the talker.
    pub const FORMATTER: &'static str = "VHW";

    /// Bytes of the longest sentence with a ship's values, CR LF included.
    pub const LONGEST: usize = 48;

    /// Writes the sentence: headings to 0.01 deg, speeds to 0.01 kn and 0.01 km/h.
    #[must_use]
    pub fn write(&self, talker: Talker) -> Line {
        let fits = self.speed.filter(|speed| (speed / KMH).abs() <= SPEED.limit);
        Line::compose(talker, Self::FORMATTER, |line| {
            line.degrees(self.heading, 2);
            line.letter(b'T');
            line.degrees(self.heading_magnetic, 2);
            line.letter(b'M');
            line.number(fits.map(|speed| speed / KNOT), SPEED);
            line.letter(b'N');
            line.number(fits.map(|speed| as_told(speed) / KMH), SPEED);
            line.letter(b'K');
        })
    }

    /// Reads the sentence. The speed is that in knots, or that in km/h if it stands alone.
    ///
    /// # Errors
    /// The first [`Fault`] of its fields.
    pub fn read(frame: &Frame<'_>) -> Result<Self, Fault> {
        let mut fields = frame.fields_of(Self::FORMATTER)?;
        let speed = |limit: f64| -limit..=limit;
        let heading = fields.optional(|own| own.degrees_with("T"))?;
        let heading_magnetic = fields.optional(|own| own.degrees_with("M"))?;
        let knots = fields.optional(|own| own.with_unit(speed(SPEED.limit), "N"))?;
        let kmh = fields.optional(|own| own.with_unit(speed(2.0 * SPEED.limit), "K"))?;
        let speed = knots.map(|knots| knots * KNOT).or(kmh.map(|kmh| kmh * KMH));
        Ok(Vhw { heading, heading_magnetic, speed })
    }
}
