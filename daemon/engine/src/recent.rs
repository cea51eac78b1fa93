//! Times of the last messages of each source, so that a repeated one is not used twice.

use std::collections::{BTreeMap, VecDeque};

use insd_base::{Message, Rejection, Source, Time};

/// Times remembered for each source.
const REMEMBERED: usize = 64;

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Other,
    Ranges,
    Rtk,
    Compass,
}

/// What came lately.
#[derive(Clone, Debug, Default)]
pub(crate) struct Recent {
    /// Ranges of a receiver, and what they come to against a base, apart from its fixes, which may be of the same instant.
    times: BTreeMap<(Source, Kind), VecDeque<Time>>,
}

impl Recent {
    /// Lets a message pass unless one of the same source and time came before.
    pub(crate) fn admit(&mut self, source: Source, message: &Message) -> Result<(), Rejection> {
        let time = message.time();
        let kind = match message {
            Message::Ranges(_) => Kind::Ranges,
            Message::Rtk(_) => Kind::Rtk,
            Message::Compass(_) => Kind::Compass,
            _ => Kind::Other,
        };
        let times = self.times.entry((source, kind)).or_default();
        if times.contains(&time) {
            return Err(Rejection::Duplicate);
        }
        if times.len() == REMEMBERED {
            times.pop_front();
        }
        times.push_back(time);
        Ok(())
    }
}
