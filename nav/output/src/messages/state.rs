//! That the system lives, and what it is doing.

use insd_base::{Mode, Span};
use insd_wire::nmea::{Hbt, Talker, Txt};

use super::entry::one;
use super::entry::{Content, Entry};
use crate::redacted_epoch::RedactedEpoch;

pub(super) static ENTRIES: &[Entry] = &[
    Entry { name: "TXT", talker: Some(Talker::IN), longest: Txt::LONGEST, make: txt },
    Entry { name: "HBT", talker: Some(Talker::IN), longest: Hbt::LONGEST, make: hbt },
];

/// Kinds of text as receivers of u-blox number them: an error, and what is only told.
const ERROR: u8 = 0;
const NOTICE: u8 = 2;

/// It says that it has failed while there is no solution although there should be one, or one that must
/// not be used. Simulated data come from a system that works.
fn hbt(said: &RedactedEpoch<'_>, talker: Talker) -> Option<Content> {
    let normal =
        said.is_levelling() || said.marked().mode().is_some_and(|mode| mode != Mode::Fault);
    let interval = said.period.map(Span::as_seconds);
    let sequence = u8::try_from(said.count % 10).ok();
    one(Hbt { interval, normal, sequence }.write(talker))
}

/// The mode in words.
fn txt(said: &RedactedEpoch<'_>, talker: Talker) -> Option<Content> {
    let (kind, words) = words(said);
    let mark = if said.is_simulated() { " (simulated)" } else { "" };
    let sentences = Txt::message(kind, &format!("insd: {words}{mark}"));
    Some(Content::Lines(sentences.iter().map(|sentence| sentence.write(talker)).collect()))
}

/// What the system does, in words, and whether that is an error, simulated or not.
pub(super) fn words(said: &RedactedEpoch<'_>) -> (u8, &'static str) {
    match said.marked().mode() {
        None if said.is_levelling() => (NOTICE, "levelling"),
        None => (ERROR, "no solution"),
        Some(Mode::Fault) => (ERROR, "fault"),
        Some(Mode::Standby) => (ERROR, "no data of the IMU"),
        Some(Mode::CoarseAlignment) => (NOTICE, "coarse alignment"),
        Some(Mode::FineAlignment) => (NOTICE, "fine alignment"),
        Some(Mode::InMotionAlignment) => (NOTICE, "alignment under way"),
        Some(Mode::Aided) => (NOTICE, "aided navigation"),
        Some(Mode::DeadReckoning) => (NOTICE, "dead reckoning"),
        Some(Mode::Inertial) => (NOTICE, "inertial navigation alone"),
    }
}
