//! The messages that a port can send, by family: an epoch as each of them.

mod alerts;
mod docking;
mod entry;
mod heading;
mod motion;
mod octans;
mod others;
mod pashr;
mod pinsd;
mod pixse;
mod position;
mod psxn;
mod signalk;
mod speed;
mod state;
mod time;
mod transducers;

use std::fmt;

use insd_wire::nmea::Talker;

use crate::redacted_epoch::RedactedEpoch;

pub use entry::Content;
use entry::Entry;

/// All families, in the order in which their messages leave a port at one epoch: time first, as others have
/// none of their own. gpsd of 3.23 and later publishes the roll and pitch of PASHR only when a heading or a
/// rate of turn follows in the same epoch; an Octans and a Phins send their heading first, and their sets belong to it.
static FAMILIES: &[&[Entry]] = &[
    time::ENTRIES,
    position::ENTRIES,
    speed::ENTRIES,
    position::LAST,
    pashr::ENTRIES,
    psxn::ENTRIES,
    others::ENTRIES,
    heading::ENTRIES,
    octans::ENTRIES,
    pixse::ENTRIES,
    motion::ENTRIES,
    pinsd::ENTRIES,
    docking::ENTRIES,
    transducers::ENTRIES,
    state::ENTRIES,
    signalk::ENTRIES,
    alerts::ENTRIES,
];

/// A kind of message that a port can send, by its name in the configuration: `GGA`, `PASHR.sbg`.
#[derive(Clone, Copy)]
pub struct MessageKind(&'static Entry);

impl MessageKind {
    /// All there are, in the order in which they leave a port at one epoch.
    pub fn all() -> impl Iterator<Item = Self> {
        FAMILIES.iter().flat_map(|family| family.iter()).map(MessageKind)
    }

    /// The kind of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::all().find(|kind| kind.name() == name)
    }

    /// Its name in the configuration.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.0.name
    }

    /// Bytes of the longest message of this kind that a ship can bring about.
    #[must_use]
    pub fn longest(self) -> usize {
        self.0.longest
    }

    /// Who speaks, if nothing else is configured; `None` for makers' own messages, which have no talker.
    #[must_use]
    pub fn talker(self) -> Option<Talker> {
        self.0.talker
    }

    /// Whether it tells of alerts.
    pub(crate) fn tells_alerts(self) -> bool {
        alerts::ENTRIES.iter().any(|entry| entry.name == self.name())
    }

    /// Whether it tells of changes: it is made once for each, and not at all without any.
    pub(crate) fn tells_changes(self) -> bool {
        self.name() == alerts::CHANGES
    }

    pub(crate) fn make(self, said: &RedactedEpoch<'_>, talker: Option<Talker>) -> Option<Content> {
        (self.0.make)(said, talker.or(self.0.talker).unwrap_or(Talker::IN))
    }
}

impl PartialEq for MessageKind {
    fn eq(&self, other: &Self) -> bool {
        self.name() == other.name()
    }
}

impl Eq for MessageKind {}

impl fmt::Debug for MessageKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
