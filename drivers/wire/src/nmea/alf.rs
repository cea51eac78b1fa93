//! ALF: an alert, its state and its text.
//!
//! ```text
//! $INALF,x,x,x,hhmmss.ss,a,a,a,aaa,x.x,x.x,x.x,x,c--c*hh
//!        1 2 3 4         5 6 7 8   9   10  11  12 13
//! 1, 2  sentences of this message, 1 or 2; number of this one
//! 3     message, 0 to 9: the same in both sentences, the next one for the next message
//! 4     UTC of the last change; may be empty
//! 5     category: A, B, C
//! 6     priority: E emergency alarm, A alarm, W warning, C caution
//! 7     state: V active and unacknowledged, S silenced, A acknowledged, O responsibility transferred,
//!       U rectified and unacknowledged, N normal
//! 8..10 which alert: maker (empty: of a standard), identifier, instance
//! 11    revision counter, 1 to 99: it counts the changes of the alert
//! 12    escalation counter, 0 to 9
//! 13    text: the title, in the second sentence the description
//! ```
//! Fields 4 to 7 of a second sentence are empty. Sources as in [`super::alert`]; of the text, makers say
//! 16 or 18 characters.

use super::alert::{
    AlertCategory, AlertId, AlertPriority, AlertState, REVISION_MAX, lettered, place, small,
};
use super::civil::TimeOfDay;
use super::fault::NmeaFault;
use super::frame::Frame;
use super::line::{MAX_LEN, NmeaLine, Talker};
use super::text::Text;

/// Most characters of a text that is read.
const TEXT: usize = 64;

/// An alert.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Alf {
    /// Sentences of the message, 1 or 2.
    pub sentences: u8,
    /// Number of this one: 1 has the title, 2 the description.
    pub number: u8,
    /// Which message, 0 to 9.
    pub message: u8,
    /// UTC of the last change. This and the next three are not written in a second sentence.
    pub time: Option<TimeOfDay>,
    /// Who can judge it.
    pub category: Option<AlertCategory>,
    /// How urgent it is.
    pub priority: Option<AlertPriority>,
    /// Its state.
    pub state: Option<AlertState>,
    /// Which alert.
    pub alert: AlertId,
    /// Revision counter, 1 to 99.
    pub revision: Option<u8>,
    /// Escalation counter, 0 to 9: how often it has been raised again unacknowledged.
    pub escalation: Option<u8>,
    /// Title or description. What does not fit into 82 bytes is left out.
    pub text: Text<TEXT>,
}

impl Alf {
    /// The three letters after the talker.
    pub const FORMATTER: &'static str = "ALF";

    /// Bytes of the longest sentence, CR LF included: its text takes what room there is.
    pub const LONGEST: usize = MAX_LEN;

    /// Characters that fit whatever the other fields are: of a title, of a description. A reserved
    /// character counts for three.
    pub const ROOM: [usize; 2] = [24, 36];

    /// The two sentences of an alert with a title, which this is, and a description.
    #[must_use]
    pub fn with_description(self, description: Text<TEXT>) -> [Alf; 2] {
        let title = Alf { sentences: 2, number: 1, ..self };
        [title, Alf { number: 2, text: description, ..title }]
    }

    /// Writes the sentence, time truncated to 0.01 s.
    #[must_use]
    pub fn write(&self, talker: Talker) -> NmeaLine {
        let head = |letter: Option<u8>| letter.filter(|_| self.number < 2);
        let time = self.time.filter(|_| self.number < 2);
        NmeaLine::compose(talker, Self::FORMATTER, |line| {
            for number in [self.sentences, self.number, self.message] {
                line.whole(Some(number.into()), 1, 9);
            }
            line.time_of_day(time);
            line.optional_letter(head(self.category.map(AlertCategory::letter)));
            line.optional_letter(head(self.priority.map(AlertPriority::letter)));
            line.optional_letter(head(self.state.map(AlertState::letter)));
            self.alert.write(line);
            line.whole(self.revision.map(u32::from), 1, REVISION_MAX);
            line.whole(self.escalation.map(u32::from), 1, 9);
            line.escaped_last(&self.text);
        })
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`NmeaFault`] of its fields.
    pub fn read(frame: &Frame<'_>) -> Result<Self, NmeaFault> {
        let mut fields = frame.fields_of(Self::FORMATTER)?;
        let (sentences, number) = place(&mut fields, 2)?;
        let message = small(&mut fields, 9)?.ok_or_else(|| fields.malformed())?;
        Ok(Alf {
            sentences,
            number,
            message,
            time: fields.time_of_day()?,
            category: lettered(&mut fields, AlertCategory::from_letter)?,
            priority: lettered(&mut fields, AlertPriority::from_letter)?,
            state: lettered(&mut fields, AlertState::from_letter)?,
            alert: AlertId::read(&mut fields)?,
            revision: small(&mut fields, REVISION_MAX)?,
            escalation: small(&mut fields, 9)?,
            text: fields.convert(Text::read)?.unwrap_or_default(),
        })
    }
}
