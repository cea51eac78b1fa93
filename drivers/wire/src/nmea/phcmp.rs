//! PHCMP: what an Octans, a Phins or a unit that speaks like them corrects its heading with.
//!
//! ```text
//! $PHCMP,ddmm.mm,a,x.xx,N*hh
//!        1       2 3    4
//! 1, 2 latitude, degrees and minutes, north or south
//! 3, 4 horizontal speed, knots
//! ```
//! From the maker's manual, and verified against records of Phins units. The manual of the Reson SeaBat
//! 8101 prints one field more before the `N`; no record has it.

use insd_base::units::KNOT;

use super::decimal::Form;
use super::fault::Fault;
use super::frame::Frame;
use super::line::Line;

/// Decimals of minutes: 20 m.
const MINUTES: u8 = 2;
const KNOTS: Form = Form { decimals: 2, width: 1, limit: 999.994 };

/// Latitude and speed.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Phcmp {
    /// Geodetic latitude, rad, north positive.
    pub latitude: Option<f64>,
    /// Horizontal speed, m/s, never negative.
    pub speed: Option<f64>,
}

impl Phcmp {
    /// All before the first comma.
    pub const ADDRESS: &'static str = "PHCMP";

    /// Greatest length, bytes with CR LF, below 100 knots.
    pub const LONGEST: usize = 29;

    /// Writes the sentence: latitude to 0.01', speed to 0.01 knots.
    #[must_use]
    pub fn write(&self) -> Line {
        let knots = self.speed.map(|speed| speed / KNOT).filter(|speed| *speed >= 0.0);
        Line::compose_own(Self::ADDRESS, |line| {
            line.latitude(self.latitude, MINUTES);
            line.measured(knots, KNOTS, b'N');
        })
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`Fault`] of its fields.
    pub fn read(frame: &Frame<'_>) -> Result<Self, Fault> {
        let mut fields = frame.fields_of_own(Self::ADDRESS)?;
        let latitude = fields.latitude()?;
        let knots = fields.number_in(0.0..=999.99)?;
        fields.fixed("N")?;
        Ok(Phcmp { latitude, speed: knots.map(|knots| knots * KNOT) })
    }
}
