//! ALC: all alerts that are active, every 30 s, also when there is none.
//!
//! ```text
//! $INALC,xx,xx,xx,x.x,aaa,x.x,x.x,x.x,...*hh
//!        1  2  3  4   5   6   7   8
//! 1, 2 sentences of this list, 01 to 99; number of this one
//! 3    list, 00 to 99: the same in all its sentences, the next one for the next list
//! 4    alerts of this sentence
//! 5..7 which alert: maker (empty: of a standard), identifier, instance
//! 8    its revision counter, 1 to 99
//! ...  further alerts, four fields each; one is never split between sentences
//! ```
//! Sources as in [`super::alert`].

use super::alert::{AlertEntry, place, small};
use super::fault::NmeaFault;
use super::frame::Frame;
use super::line::{MAX_LEN, NmeaLine, Talker};

/// Most alerts of a sentence that is read: with the shortest fields, no more fit into 82 bytes.
pub const MAX_ENTRIES: usize = 12;

/// Most sentences of a list.
const MAX_SENTENCES: u8 = 99;

/// A sentence of a list of alerts.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Alc {
    /// Sentences of the list.
    pub sentences: u8,
    /// Number of this one, from 1.
    pub number: u8,
    /// Which list, 0 to 99.
    pub message: u8,
    /// Its alerts, no gap but at the end. Those that do not fit into 82 bytes are not written:
    /// [`Alc::list`] takes as many sentences as are needed.
    pub entries: [Option<AlertEntry>; MAX_ENTRIES],
}

impl Alc {
    /// The three letters after the talker.
    pub const FORMATTER: &'static str = "ALC";

    /// Bytes of the longest sentence, CR LF included: it is as full as may be.
    pub const LONGEST: usize = MAX_LEN;

    /// The sentences of a list, one at least. A list has no more than 99 sentences, in which there is
    /// room for at least 198 alerts.
    #[must_use]
    pub fn list(message: u8, alerts: &[AlertEntry]) -> Vec<Alc> {
        let mut sentences = vec![Alc { message, ..Alc::default() }];
        for alert in alerts {
            let grown = sentences.last().and_then(|last| last.with(*alert));
            match (grown, sentences.last_mut()) {
                (Some(grown), Some(last)) => *last = grown,
                _ => sentences.extend(Alc { message, ..Alc::default() }.with(*alert)),
            }
        }
        sentences.truncate(MAX_SENTENCES.into());
        let count = u8::try_from(sentences.len()).unwrap_or(MAX_SENTENCES);
        for (number, sentence) in (1..).zip(&mut sentences) {
            (sentence.sentences, sentence.number) = (count, number);
        }
        sentences
    }

    /// The sentence with one alert more, if it fits.
    fn with(mut self, alert: AlertEntry) -> Option<Self> {
        *self.entries.iter_mut().find(|entry| entry.is_none())? = Some(alert);
        let all = self.entries.iter().flatten().count();
        self.try_write(Talker::IN, all).map(|_| self)
    }

    /// Writes the sentence.
    #[must_use]
    pub fn write(&self, talker: Talker) -> NmeaLine {
        let all = self.entries.iter().flatten().count();
        let fitting = (0..=all).rev().find_map(|count| self.try_write(talker, count));
        fitting.unwrap_or_else(|| NmeaLine::compose(talker, Self::FORMATTER, |_| {}))
    }

    fn try_write(&self, talker: Talker, count: usize) -> Option<NmeaLine> {
        NmeaLine::try_compose(talker, Self::FORMATTER, |line| {
            for number in [self.sentences, self.number, self.message] {
                line.whole(Some(number.into()), 2, 99);
            }
            line.whole(u32::try_from(count).ok(), 1, 99);
            self.entries.iter().flatten().take(count).for_each(|entry| entry.write(line));
        })
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`NmeaFault`] of its fields, of which the number of alerts must be right.
    pub fn read(frame: &Frame<'_>) -> Result<Self, NmeaFault> {
        let mut fields = frame.fields_of(Self::FORMATTER)?;
        let (sentences, number) = place(&mut fields, MAX_SENTENCES.into())?;
        let message = small(&mut fields, 99)?.ok_or_else(|| fields.malformed())?;
        let count = small(&mut fields, 99)?.map(usize::from);
        let count =
            count.filter(|count| *count <= MAX_ENTRIES).ok_or_else(|| fields.malformed())?;
        let mut entries = [None; MAX_ENTRIES];
        for entry in entries.iter_mut().take(count) {
            *entry = Some(AlertEntry::read(&mut fields)?);
        }
        Ok(Alc { sentences, number, message, entries })
    }
}
