//! Alerts: those that have changed, and the list of all that are active.

use insd_wire::nmea::{Alc, Alf, Talker};

use super::entry::{Content, Entry, one};
use crate::alerts::Announcement;
use crate::redacted_epoch::RedactedEpoch;

/// The message that tells of changes.
pub(super) const CHANGES: &str = "ALF";

/// An alert has two sentences, and the list of all there are has no more.
pub(super) static ENTRIES: &[Entry] = &[
    Entry { name: CHANGES, talker: Some(Talker::IN), longest: 2 * Alf::LONGEST, make: alf },
    Entry { name: "ALC", talker: Some(Talker::IN), longest: 7 * Alc::LONGEST, make: alc },
];

/// How an alert stands, or that a command about one is refused (ARC).
fn alf(said: &RedactedEpoch<'_>, talker: Talker) -> Option<Content> {
    let message = u8::try_from(said.count % 10).ok()?;
    match said.announcement? {
        Announcement::Refusal(_, arc) => one(arc.write(talker)),
        Announcement::Alert(_, sentences) => {
            let lines = sentences.map(|alf| Alf { message, ..alf }.write(talker));
            Some(Content::Lines(lines.to_vec()))
        }
    }
}

/// All that are active; an empty list, too, is told.
fn alc(said: &RedactedEpoch<'_>, talker: Talker) -> Option<Content> {
    let message = u8::try_from(said.count % 100).ok()?;
    let sentences = Alc::list(message, said.alerts?);
    Some(Content::Lines(sentences.iter().map(|sentence| sentence.write(talker)).collect()))
}
