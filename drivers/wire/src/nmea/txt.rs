//! TXT: a text for people.
//!
//! ```text
//! $INTXT,xx,xx,xx,c--c*hh
//!        1  2  3  4
//! 1, 2 sentences of this message, 01 to 99; number of this one
//! 3    kind of text, 00 to 99: the talker's own numbers
//! 4    text
//! ```
//! Receivers do not escape commas in the text (gpsd's logs), so all behind field 3 is the text.

use super::alert::{place, small};
use super::fault::NmeaFault;
use super::frame::Frame;
use super::line::{MAX_LEN, NmeaLine, Talker};
use super::text::{Text, escape};

/// Most characters of a text that is read.
const TEXT: usize = 64;

/// Most sentences of a message.
const MAX_SENTENCES: u8 = 99;

/// A text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Txt {
    /// Sentences of the message.
    pub sentences: u8,
    /// Number of this one, from 1.
    pub number: u8,
    /// Kind of text, 0 to 99.
    pub kind: Option<u8>,
    /// The text. What does not fit into 82 bytes is left out: [`Txt::message`] takes as many sentences
    /// as are needed.
    pub text: Text<TEXT>,
}

impl Txt {
    /// The three letters after the talker.
    pub const FORMATTER: &'static str = "TXT";

    /// Bytes of the longest sentence, CR LF included: the text takes what room there is.
    pub const LONGEST: usize = MAX_LEN;

    /// Characters that fit; a reserved one counts for three.
    pub const ROOM: usize = 61;

    /// The sentences of a message of any length up to 99 sentences; a question mark stands for a
    /// character that cannot be written.
    #[must_use]
    pub fn message(kind: u8, message: &str) -> Vec<Txt> {
        let mut pieces = vec![(String::new(), 0)];
        for character in message.chars() {
            let one = character.to_string();
            let character = if Text::<1>::new(&one).is_some() { character } else { '?' };
            let length = escape(character).len();
            match pieces.last_mut().filter(|(_, used)| used + length <= Self::ROOM) {
                Some((piece, used)) => {
                    piece.push(character);
                    *used += length;
                }
                None => pieces.push((character.to_string(), length)),
            }
        }
        pieces.truncate(MAX_SENTENCES.into());
        let sentences = u8::try_from(pieces.len()).unwrap_or(MAX_SENTENCES);
        let texts = pieces.iter().map(|(piece, _)| Text::new(piece).unwrap_or_default());
        let numbered = (1..).zip(texts);
        numbered.map(|(number, text)| Txt { sentences, number, kind: Some(kind), text }).collect()
    }

    /// Writes the sentence.
    #[must_use]
    pub fn write(&self, talker: Talker) -> NmeaLine {
        NmeaLine::compose(talker, Self::FORMATTER, |line| {
            line.whole(Some(self.sentences.into()), 2, 99);
            line.whole(Some(self.number.into()), 2, 99);
            line.whole(self.kind.map(u32::from), 2, 99);
            line.escaped_last(&self.text);
        })
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`NmeaFault`] of its fields.
    pub fn read(frame: &Frame<'_>) -> Result<Self, NmeaFault> {
        let mut fields = frame.fields_of(Self::FORMATTER)?;
        let (sentences, number) = place(&mut fields, MAX_SENTENCES.into())?;
        let kind = small(&mut fields, 99)?;
        let text = Text::read(fields.remainder()?).ok_or_else(|| fields.malformed())?;
        Ok(Txt { sentences, number, kind, text })
    }
}
