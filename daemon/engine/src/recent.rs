//! Times of the last messages of each source, so that a repeated one is not used twice.

use std::collections::{BTreeMap, VecDeque};

use insd_base::{Rejection, Source, Time};

/// Times remembered for each source.
const REMEMBERED: usize = 64;

/// What came lately.
#[derive(Clone, Debug, Default)]
pub(crate) struct Recent {
    times: BTreeMap<Source, VecDeque<Time>>,
}

impl Recent {
    /// Lets a message pass unless one of the same source and time came before.
    pub(crate) fn admit(&mut self, source: Source, time: Time) -> Result<(), Rejection> {
        let times = self.times.entry(source).or_default();
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
