//! HBT: a device lives.
//!
//! ```text
//! $INHBT,x.x,A,x*hh
//!        1   2 3
//! 1 how often the sentence is sent, s, 1 to 999
//! 2 A normal, V the device has failed
//! 3 number of this sentence, 0 to 9 and again
//! ```
//! From manuals (Furuno BR-500, JRC JFE-680); not verified against a device.

use super::alert::small;
use super::decimal::Form;
use super::fault::Fault;
use super::frame::Frame;
use super::line::{Line, Talker};

const INTERVAL_MAX: f64 = 999.0;

/// A sign of life.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hbt {
    /// How often the sentence is sent, s.
    pub interval: Option<f64>,
    /// Whether the device works.
    pub normal: bool,
    /// Number of this sentence, 0 to 9.
    pub sequence: Option<u8>,
}

impl Hbt {
    /// The three letters after the talker.
    pub const FORMATTER: &'static str = "HBT";

    /// Bytes of the longest sentence, CR LF included.
    pub const LONGEST: usize = 21;

    /// Writes the sentence, the interval to 0.1 s, whole seconds without a point.
    #[must_use]
    pub fn write(&self, talker: Talker) -> Line {
        let whole = self.interval.is_none_or(|interval| interval.fract() == 0.0);
        let form = Form { decimals: u8::from(!whole), width: 1, limit: INTERVAL_MAX };
        Line::compose(talker, Self::FORMATTER, |line| {
            line.magnitude(self.interval, form);
            line.letter(if self.normal { b'A' } else { b'V' });
            line.whole(self.sequence.map(u32::from), 1, 9);
        })
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`Fault`] of its fields.
    pub fn read(frame: &Frame<'_>) -> Result<Self, Fault> {
        let mut fields = frame.fields_of(Self::FORMATTER)?;
        let interval = fields.number_in(0.0..=INTERVAL_MAX)?;
        let normal = fields.status()?;
        Ok(Hbt { interval, normal, sequence: small(&mut fields, 9)? })
    }
}
