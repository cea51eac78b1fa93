//! Times of the last messages of each source, so that a repeated one is not used twice.

use std::collections::{BTreeMap, VecDeque};

use insd_base::{Message, Rejection, Source, Time};

/// Times remembered for each source.
const REMEMBERED: usize = 64;

/// What came lately.
#[derive(Clone, Debug, Default)]
pub(crate) struct Recent {
    /// Ranges of a receiver apart from its fixes, which may be of the same instant.
    times: BTreeMap<(Source, bool), VecDeque<Time>>,
}

impl Recent {
    /// Lets a message pass unless one of the same source and time came before.
    pub(crate) fn admit(&mut self, source: Source, message: &Message) -> Result<(), Rejection> {
        let time = message.time();
        let is_ranges = matches!(message, Message::Ranges(_));
        let times = self.times.entry((source, is_ranges)).or_default();
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
