//! The last readings of a watched sensor, so that two that never speak at the same instant can be compared.

use std::collections::VecDeque;

use insd_base::{Span, Time};
use insd_intake::watched::WatchedValue;

/// Readings that are kept of each.
const KEPT: usize = 256;
/// Between two readings that are farther apart nothing is known.
const GAP: Span = Span::from_nanos(3_000_000_000);

/// A reading with its 1-sigma.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Reading {
    pub(super) time: Time,
    pub(super) value: WatchedValue,
    pub(super) std: f64,
}

/// The last readings of one quantity, the newest one last.
#[derive(Clone, Debug, Default)]
pub(super) struct History(VecDeque<Reading>);

impl History {
    /// Adds a reading; one that is not newer than the last is left out. Whether it was taken.
    pub(super) fn add(&mut self, reading: Reading) -> bool {
        if self.0.back().is_some_and(|last| reading.time <= last.time) {
            return false;
        }
        if self.0.len() >= KEPT {
            self.0.pop_front();
        }
        self.0.push_back(reading);
        true
    }

    /// What its newest reading, and the way to it from the one before, say about the readings of another in between: times
    /// and differences of this one less the other one, and the 1-sigma of the other.
    pub(super) fn against<'a>(
        &'a self,
        other: &'a History,
    ) -> impl Iterator<Item = (Time, [f64; 2], f64)> + 'a {
        let newest = self.0.back().copied();
        let before = self.0.len().checked_sub(2).and_then(|index| self.0.get(index)).copied();
        let both = newest.zip(before).filter(|(new, old)| new.time - old.time <= GAP);
        both.into_iter().flat_map(move |(new, old)| {
            let within = move |own: &&Reading| own.time > old.time && own.time <= new.time;
            other.0.iter().filter(within).filter_map(move |own| {
                let part = (own.time - old.time).as_seconds() / (new.time - old.time).as_seconds();
                let [way, from] = [new.value.less(&old.value)?, old.value.less(&own.value)?];
                Some((own.time, [from[0] + part * way[0], from[1] + part * way[1]], own.std))
            })
        })
    }
}
