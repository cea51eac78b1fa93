//! What became of the messages of an output, slot by slot.

use std::collections::BTreeMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

use insd_base::Span;

use super::histogram::Histogram;
use super::outgoing::{AgeStatus, SlotStatus};

/// The counts of all slots.
#[derive(Debug, Default)]
pub(super) struct Tally(Mutex<BTreeMap<u16, Slot>>);

#[derive(Debug, Default)]
struct Slot {
    handed: u64,
    sent: u64,
    dropped: u64,
    unread: u64,
    bytes: u64,
    last: Span,
    max: Span,
    ages: Histogram,
}

impl Tally {
    /// A message was handed over.
    pub(super) fn handed(&self, slot: u16) {
        self.change(slot, |slot| slot.handed += 1);
    }

    /// One was given to the system whole, and was so old when its last byte left.
    pub(super) fn sent(&self, slot: u16, bytes: usize, age: Span) {
        self.change(slot, |slot| slot.note(bytes, age));
    }

    /// One will never leave.
    pub(super) fn dropped(&self, slot: u16) {
        self.change(slot, |slot| slot.dropped += 1);
    }

    /// One that was sent was never read.
    pub(super) fn unread(&self, slot: u16) {
        self.change(slot, |slot| slot.unread += 1);
    }

    /// Messages of all slots that will never leave.
    pub(super) fn all_dropped(&self) -> u64 {
        self.lock().values().map(|slot| slot.dropped).sum()
    }

    /// What there is to tell of each slot.
    pub(super) fn status(&self) -> Vec<SlotStatus> {
        self.lock().iter().map(|(number, slot)| slot.status(*number)).collect()
    }

    fn change(&self, number: u16, change: impl FnOnce(&mut Slot)) {
        change(self.lock().entry(number).or_default());
    }

    fn lock(&self) -> MutexGuard<'_, BTreeMap<u16, Slot>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Slot {
    fn note(&mut self, bytes: usize, age: Span) {
        self.max = if self.sent == 0 { age } else { self.max.max(age) };
        self.last = age;
        self.sent += 1;
        self.bytes += bytes as u64;
        self.ages.count(age);
    }

    fn status(&self, slot: u16) -> SlotStatus {
        // the upper edge of a bin may be above the oldest that it holds
        let quantile = |part| self.ages.quantile(part).min(self.max.max(Span::ZERO));
        let age =
            AgeStatus { last: self.last, max: self.max, p50: quantile(0.5), p99: quantile(0.99) };
        SlotStatus {
            slot,
            sent: self.sent,
            dropped: self.dropped,
            waiting: self.handed.saturating_sub(self.sent + self.dropped),
            unread: self.unread,
            bytes: self.bytes,
            age: (self.sent > 0).then_some(age),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_slot_has_counts_and_ages_of_its_own() {
        let tally = Tally::default();
        let millis = |millis: i64| Span::from_nanos(millis * 1_000_000);
        for slot in [7, 2, 7, 7] {
            tally.handed(slot);
        }
        tally.sent(7, 20, millis(30));
        tally.sent(7, 22, millis(10));
        tally.dropped(2);
        let [two, seven] = tally.status().try_into().unwrap();
        assert_eq!((two.slot, two.sent, two.dropped, two.waiting, two.age), (2, 0, 1, 0, None));
        assert_eq!((seven.slot, seven.sent, seven.dropped, seven.waiting), (7, 2, 0, 1));
        assert_eq!(seven.bytes, 42);
        let age = seven.age.unwrap();
        assert_eq!((age.last, age.max, age.p99), (millis(10), millis(30), millis(30)));
        assert!(age.p50 >= millis(10) && age.p50 < millis(11));
    }
}
