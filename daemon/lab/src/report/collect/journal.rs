//! Events in their order, the first and the last of them, and how many there were of each kind.

use std::collections::BTreeMap;

use insd_base::Time;

use crate::report::bounded::Bounded;

/// Events kept at each end.
const KEPT: usize = 100;

/// An event in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Entry {
    pub(crate) time: Time,
    pub(crate) kind: &'static str,
    pub(crate) text: String,
}

/// The journal.
#[derive(Clone, Debug)]
pub(crate) struct Journal {
    pub(crate) entries: Bounded<Entry>,
    pub(crate) kinds: BTreeMap<&'static str, u64>,
}

impl Journal {
    pub(crate) fn new() -> Self {
        Journal { entries: Bounded::new(KEPT), kinds: BTreeMap::new() }
    }

    /// Writes an event down.
    pub(crate) fn write(&mut self, time: Time, kind: &'static str, text: String) {
        self.count(kind);
        self.entries.push(Entry { time, kind, text });
    }

    /// Counts an event that is not worth a line.
    pub(crate) fn count(&mut self, kind: &'static str) {
        *self.kinds.entry(kind).or_insert(0) += 1;
    }
}
