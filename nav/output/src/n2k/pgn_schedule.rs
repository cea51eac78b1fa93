//! Which messages are due, and the number that ties them together.

use std::collections::BTreeMap;

use insd_n2k::node::Transmit;

use super::table::Entry;
use crate::epoch::OutputEpoch;
use crate::manner::Manner;
use crate::redacted_epoch::RedactedEpoch;
use crate::schedule::Beat;

/// Sequence identifiers count from 0 to this one; those above have meanings of their own.
const LAST_SID: u8 = 252;

/// Turns epochs into the messages of one bus.
#[derive(Clone, Debug)]
pub struct PgnSchedule {
    manner: Manner,
    sid: u8,
    /// The beat of each group.
    sent: BTreeMap<u32, Beat>,
}

impl PgnSchedule {
    /// A voice that has said nothing yet.
    #[must_use]
    pub fn new(manner: Manner) -> Self {
        PgnSchedule { manner, sid: 0, sent: BTreeMap::new() }
    }

    /// The messages that are due at this epoch, number of the group and contents, in the order of the
    /// table. All carry the same sequence identifier. Groups that are not enabled, or that are none of
    /// [`super::default_transmit`], are not sent. The table may change from epoch to epoch.
    pub fn messages(&mut self, epoch: &OutputEpoch, transmit: &[Transmit]) -> Vec<(u32, Vec<u8>)> {
        let said = RedactedEpoch::new(epoch, &self.manner).with_sid(Some(self.sid));
        let (now, mut messages) = (epoch.boundary(), Vec::new());
        for line in transmit.iter().filter(|line| line.enabled) {
            if let Some(entry) = Entry::of(line.pgn)
                && self.sent.entry(line.pgn).or_default().is_due(&now, line.interval)
            {
                messages.push((line.pgn, (entry.contents)(&said)));
            }
        }
        if !messages.is_empty() {
            self.sid = if self.sid < LAST_SID { self.sid + 1 } else { 0 };
        }
        messages
    }
}
