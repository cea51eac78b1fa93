//! ARC: a command about an alert is refused.
//!
//! ```text
//! $INARC,hhmmss.ss,aaa,x.x,x.x,a*hh
//!        1         2   3   4   5
//! 1    UTC of the refusal; may be empty
//! 2..4 which alert: maker (empty: of a standard), identifier, instance
//! 5    the refused command: A acknowledge, Q request, O transfer of responsibility, S silence
//! ```
//! Sources as in [`super::alert`].

use super::alert::{AlertCommand, AlertId, lettered};
use super::civil::TimeOfDay;
use super::fault::Fault;
use super::frame::Frame;
use super::line::{Line, Talker};

/// A refusal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    /// UTC of the refusal.
    pub time: Option<TimeOfDay>,
    /// Which alert.
    pub alert: AlertId,
    /// What is refused.
    pub command: AlertCommand,
}

impl Arc {
    /// The three letters after the talker.
    pub const FORMATTER: &'static str = "ARC";

    /// Bytes of the longest sentence, CR LF included.
    pub const LONGEST: usize = 42;

    /// Writes the sentence, time truncated to 0.01 s.
    #[must_use]
    pub fn write(&self, talker: Talker) -> Line {
        Line::compose(talker, Self::FORMATTER, |line| {
            line.time_of_day(self.time);
            self.alert.write(line);
            line.letter(self.command.letter());
        })
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`Fault`] of its fields.
    pub fn read(frame: &Frame<'_>) -> Result<Self, Fault> {
        let mut fields = frame.fields_of(Self::FORMATTER)?;
        let time = fields.time_of_day()?;
        let alert = AlertId::read(&mut fields)?;
        let command = lettered(&mut fields, AlertCommand::from_letter)?;
        Ok(Arc { time, alert, command: command.ok_or_else(|| fields.malformed())? })
    }
}
