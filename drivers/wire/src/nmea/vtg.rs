//! VTG: course and speed over ground.
//!
//! ```text
//! $INVTG,x.x,T,x.x,M,x.x,N,x.x,K,a*hh
//!        1   2 3   4 5   6 7   8 9
//! 1, 2 course over ground, deg true
//! 3, 4 course over ground, deg magnetic
//! 5, 6 speed over ground, knots
//! 7, 8 speed over ground, km/h
//! 9    mode: A D E F M N P R S; never empty in newer editions, absent before NMEA 2.3
//! ```
//! The unit letters stay even beside an empty field: readers tell the older layout without letters
//! by them. The mode must be good; a value that is bad, or stands beside another letter, is left out.

use insd_base::units::KNOT;

use super::decimal::Form;
use super::fault::Fault;
use super::frame::Frame;
use super::line::{Line, Talker};
use super::mode::PositionMode;

/// Metres per second in one kilometre per hour.
pub(crate) const KMH: f64 = 1.0 / 3.6;

/// A speed, m/s, as it is told in knots: that in km/h is the same.
pub(crate) fn as_told(speed: f64) -> f64 {
    (speed / KNOT * 100.0).round() / 100.0 * KNOT
}

const SPEED: Form = Form { decimals: 2, width: 1, limit: 9999.9 };

/// Course and speed over ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vtg {
    /// Course over ground, rad, clockwise from true north.
    pub course: Option<f64>,
    /// Course over ground, rad, clockwise from magnetic north.
    pub course_magnetic: Option<f64>,
    /// Speed over ground, m/s.
    pub speed: Option<f64>,
    /// How it was found; an unknown mode is written as not valid.
    pub mode: Option<PositionMode>,
}

impl Vtg {
    /// The three letters after the talker.
    pub const FORMATTER: &'static str = "VTG";

    /// Bytes of the longest sentence with a ship's values, CR LF included.
    pub const LONGEST: usize = 48;

    /// Writes the sentence: courses to 0.01 deg, speeds to 0.01 kn and 0.01 km/h.
    #[must_use]
    pub fn write(&self, talker: Talker) -> Line {
        let mode = self.mode.unwrap_or(PositionMode::NotValid);
        Line::compose(talker, Self::FORMATTER, |line| {
            line.degrees(self.course, 2);
            line.letter(b'T');
            line.degrees(self.course_magnetic, 2);
            line.letter(b'M');
            line.magnitude(self.speed.map(|speed| speed / KNOT), SPEED);
            line.letter(b'N');
            line.magnitude(self.speed.map(|speed| as_told(speed) / KMH), SPEED);
            line.letter(b'K');
            line.letter(mode.letter());
        })
    }

    /// Reads the sentence. The speed is that in knots, or that in km/h if it stands alone.
    ///
    /// # Errors
    /// The first [`Fault`] of its fields.
    pub fn read(frame: &Frame<'_>) -> Result<Self, Fault> {
        let mut fields = frame.fields_of(Self::FORMATTER)?;
        let course = fields.optional(|own| own.degrees_with("T"))?;
        let course_magnetic = fields.optional(|own| own.degrees_with("M"))?;
        let knots = fields.optional(|own| own.with_unit(0.0..=SPEED.limit, "N"))?;
        let kmh = fields.optional(|own| own.with_unit(0.0..=2.0 * SPEED.limit, "K"))?;
        let mode = if fields.has_more() {
            let mode = fields.letter()?.and_then(PositionMode::from_letter);
            Some(mode.ok_or_else(|| fields.malformed())?)
        } else {
            None
        };
        let speed = knots.map(|knots| knots * KNOT).or(kmh.map(|kmh| kmh * KMH));
        Ok(Vtg { course, course_magnetic, speed, mode })
    }
}
