//! One kind of message, and what a message is made of.

use insd_wire::nmea::{NmeaLine, Talker};

use crate::redacted_epoch::RedactedEpoch;

/// What one message is made of.
#[derive(Clone, Debug, PartialEq)]
pub enum Content {
    /// Sentences that belong together and leave in this order.
    Lines(Vec<NmeaLine>),
    /// A binary telegram.
    Binary(Vec<u8>),
}

/// A kind of message.
pub(super) struct Entry {
    /// Its name in the configuration.
    pub(super) name: &'static str,
    /// Who speaks, if nothing else is configured; `None` for makers' own.
    pub(super) talker: Option<Talker>,
    /// Bytes of the longest that a ship can bring about.
    pub(super) longest: usize,
    /// The message of an epoch; `None` where silence is the only honest answer.
    pub(super) make: Make,
}

pub(super) type Make = fn(&RedactedEpoch<'_>, Talker) -> Option<Content>;

impl Entry {
    /// A maker's own, which has no talker.
    pub(super) const fn own(name: &'static str, longest: usize, make: Make) -> Self {
        Entry { name, talker: None, longest, make }
    }
}

impl Content {
    /// The bytes for the wire.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        match self {
            Content::Lines(lines) => {
                lines.iter().flat_map(|line| line.as_bytes().iter().copied()).collect()
            }
            Content::Binary(bytes) => bytes.clone(),
        }
    }
}

/// One sentence without a mark for simulated data: from a simulator there is none.
pub(super) fn unmarked(
    said: &RedactedEpoch<'_>,
    write: fn(&RedactedEpoch<'_>) -> NmeaLine,
) -> Option<Content> {
    if said.is_muted() { None } else { one(write(said)) }
}

/// One sentence.
pub(super) fn one(line: NmeaLine) -> Option<Content> {
    Some(Content::Lines(vec![line]))
}
