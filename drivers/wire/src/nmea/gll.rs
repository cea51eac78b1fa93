//! GLL: geographic position.
//!
//! ```text
//! $GPGLL,ddmm.mmmmm,a,dddmm.mmmmm,a,hhmmss.ss,A,a*hh
//!        1          2 3           4 5         6 7
//! 1, 2 latitude, N or S
//! 3, 4 longitude, E or W
//! 5    UTC of the position
//! 6    A valid, V not valid
//! 7    mode: A D E F M N P R S; absent before NMEA 2.3
//! ```
//! The form of the Loran age ends after field 4, and has neither a time nor a status: its position is
//! taken as valid. Position, time, status and mode must be good.

use super::civil::TimeOfDay;
use super::fault::NmeaFault;
use super::frame::Frame;
use super::line::{NmeaLine, Talker};
use super::mode::PositionMode;
use super::parts::letter_of;
use super::position::Position;

/// A position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gll {
    /// Latitude and longitude; `None` if the sentence is not valid and they are no position.
    pub position: Option<Position>,
    /// UTC of the position.
    pub time: Option<TimeOfDay>,
    /// Whether the position may be used. A sentence without a position is written as not valid.
    pub valid: bool,
    /// How it was found; an unknown mode is written as autonomous or not valid.
    pub mode: Option<PositionMode>,
}

impl Gll {
    /// The three letters after the talker.
    pub const FORMATTER: &'static str = "GLL";

    /// Bytes of the longest sentence with a ship's values, CR LF included.
    pub const LONGEST: usize = 52;

    /// Writes the sentence: time truncated to 0.01 s, position to 0.00001 minutes (2 cm).
    #[must_use]
    pub fn write(&self, talker: Talker) -> NmeaLine {
        let valid = self.valid && self.position.is_some_and(Position::is_writable);
        let otherwise = if valid { PositionMode::Autonomous } else { PositionMode::NotValid };
        NmeaLine::compose(talker, Self::FORMATTER, |line| {
            line.position(self.position, 5);
            line.time_of_day(self.time);
            line.letter(if valid { b'A' } else { b'V' });
            line.letter(self.mode.unwrap_or(otherwise).letter());
        })
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`NmeaFault`] of its fields.
    pub fn read(frame: &Frame<'_>) -> Result<Self, NmeaFault> {
        let mut fields = frame.fields_of(Self::FORMATTER)?;
        let position = fields.position();
        if !fields.has_more() {
            let position = position?;
            return Ok(Gll { position, time: None, valid: position.is_some(), mode: None });
        }
        let time = fields.time_of_day()?;
        let valid = fields.status()?;
        let mode = if fields.has_more() {
            fields.convert(|text| letter_of(text).and_then(PositionMode::from_letter))?
        } else {
            None
        };
        let position = if valid { position? } else { position.ok().flatten() };
        Ok(Gll { position, time, valid, mode })
    }
}
