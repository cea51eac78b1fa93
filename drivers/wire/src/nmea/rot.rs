//! ROT: rate of turn.
//!
//! ```text
//! $TIROT,x.x,A*hh
//!        1   2
//! 1 rate of turn, deg/min, "-" when the bow turns to port
//! 2 A valid, V not valid
//! ```
//! AIS transponders take the value from talker TI only; from others they take the side alone
//! (Saab R4 manual).

use insd_base::units::DEG;

use super::decimal::Form;
use super::fault::Fault;
use super::frame::Frame;
use super::line::{Line, Talker};

/// Radians per second in one degree per minute.
const DEG_PER_MINUTE: f64 = DEG / 60.0;

const RATE: Form = Form { decimals: 1, width: 1, limit: 99_999.9 };

/// Rate of turn with its status.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rot {
    /// Rate of turn, rad/s, positive when the bow turns to starboard.
    pub rate: Option<f64>,
    /// Whether the rate may be used. A sentence without a rate is written as not valid.
    pub valid: bool,
}

impl Rot {
    /// The three letters after the talker.
    pub const FORMATTER: &'static str = "ROT";

    /// Bytes of the longest sentence with a ship's values, CR LF included.
    pub const LONGEST: usize = 21;

    /// Writes the sentence, rate to 0.1 deg/min.
    #[must_use]
    pub fn write(&self, talker: Talker) -> Line {
        let rate = self.rate.map(|rate| rate / DEG_PER_MINUTE);
        let known = rate.is_some_and(|rate| rate.abs() <= RATE.limit);
        Line::compose(talker, Self::FORMATTER, |line| {
            line.number(rate, RATE);
            line.letter(if self.valid && known { b'A' } else { b'V' });
        })
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`Fault`] of its fields.
    pub fn read(frame: &Frame<'_>) -> Result<Self, Fault> {
        let mut fields = frame.fields_of(Self::FORMATTER)?;
        let rate = fields.number()?.map(|rate| rate * DEG_PER_MINUTE);
        let valid = match fields.letter()? {
            Some(b'A') => true,
            Some(b'V') => false,
            _ => return Err(fields.malformed()),
        };
        Ok(Rot { rate, valid })
    }
}
