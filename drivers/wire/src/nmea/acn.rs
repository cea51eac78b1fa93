//! ACN: what a bridge asks of a device about an alert.
//!
//! ```text
//! $--ACN,hhmmss.ss,aaa,x.x,x.x,a,C*hh
//!        1         2   3   4   5 6
//! 1    UTC of the command; may be empty
//! 2..4 which alert: maker (empty: of a standard), identifier, instance
//! 5    A acknowledge, Q request, O transfer of responsibility, S silence
//! 6    C, fixed: this is a command
//! ```
//! Sources as in [`super::alert`].

use super::alert::{AlertCommand, AlertId, lettered};
use super::civil::TimeOfDay;
use super::fault::Fault;
use super::frame::Frame;
use super::line::{Line, Talker};

/// A command about an alert.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Acn {
    /// UTC of the command.
    pub time: Option<TimeOfDay>,
    /// Which alert.
    pub alert: AlertId,
    /// What is to be done.
    pub command: AlertCommand,
}

impl Acn {
    /// The three letters after the talker.
    pub const FORMATTER: &'static str = "ACN";

    /// Bytes of the longest sentence, CR LF included.
    pub const LONGEST: usize = 44;

    /// Writes the sentence, time truncated to 0.01 s.
    #[must_use]
    pub fn write(&self, talker: Talker) -> Line {
        Line::compose(talker, Self::FORMATTER, |line| {
            line.time_of_day(self.time);
            self.alert.write(line);
            line.letter(self.command.letter());
            line.letter(b'C');
        })
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`Fault`] of its fields; one without the letter C is no command, and malformed.
    pub fn read(frame: &Frame<'_>) -> Result<Self, Fault> {
        let mut fields = frame.fields_of(Self::FORMATTER)?;
        let time = fields.time_of_day()?;
        let alert = AlertId::read(&mut fields)?;
        let command = lettered(&mut fields, AlertCommand::from_letter)?;
        let command = command.ok_or_else(|| fields.malformed())?;
        match fields.text()? {
            "C" => Ok(Acn { time, alert, command }),
            _ => Err(fields.malformed()),
        }
    }
}
