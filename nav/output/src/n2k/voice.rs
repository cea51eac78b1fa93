//! Which messages are due, and the number that ties them together.

use std::collections::BTreeMap;

use insd_base::{Span, Time};
use insd_n2k::node::Transmit;

use super::epoch::Epoch;
use super::said::Said;
use super::table::Entry;
use crate::policy::Policy;

/// Sequence identifiers count from 0 to this one; those above have meanings of their own.
const LAST_SID: u8 = 252;

/// How a bus is spoken to.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct VoiceConfig {
    /// Limits beyond which a value is not available.
    pub policy: Policy,
    /// The data come from a simulator: 129029 says so, and the groups that cannot say it tell nothing,
    /// so that nobody takes them for real.
    pub simulated: bool,
    /// Tell everything even from a simulator. For a bus that no ship's equipment is on.
    pub unmarked_when_simulated: bool,
}

/// Turns epochs into the messages of one bus.
#[derive(Clone, Debug)]
pub struct Voice {
    config: VoiceConfig,
    sid: u8,
    /// The epoch of the last message of each group.
    sent: BTreeMap<u32, Time>,
}

impl Voice {
    /// A voice that has said nothing yet.
    #[must_use]
    pub fn new(config: VoiceConfig) -> Self {
        Voice { config, sid: 0, sent: BTreeMap::new() }
    }

    /// The messages that are due at this epoch, number of the group and contents, in the order of the
    /// table. All carry the same sequence identifier. Groups that are not enabled, or that are none of
    /// [`super::default_transmit`], are not sent. The table may change from epoch to epoch.
    pub fn messages(&mut self, epoch: &Epoch, transmit: &[Transmit]) -> Vec<(u32, Vec<u8>)> {
        let said = Said::new(Some(self.sid), epoch, &self.config);
        let mut messages = Vec::new();
        for line in transmit.iter().filter(|line| line.enabled) {
            if let Some(entry) = Entry::of(line.pgn)
                && is_due(self.sent.get(&line.pgn), epoch.time, line.interval)
            {
                self.sent.insert(line.pgn, epoch.time);
                messages.push((line.pgn, (entry.contents)(&said)));
            }
        }
        if !messages.is_empty() {
            self.sid = if self.sid < LAST_SID { self.sid + 1 } else { 0 };
        }
        messages
    }
}

/// Whether an instant is the first of an interval. Intervals begin at whole multiples of their length on
/// the voyage's time line, so that groups of one rate leave together, and a late or missing epoch does
/// not shift the ones after it.
fn is_due(last: Option<&Time>, now: Time, interval: Span) -> bool {
    let length = interval.as_nanos().max(1);
    let number = |time: Time| time.as_nanos().div_euclid(length);
    last.is_none_or(|last| number(now) > number(*last))
}
