//! Which message leaves next, and which never does. No clock and no waiting in here.
//!
//! Of what is sent for the moment only the **newest** of each slot waits:
//!
//! - A message takes the place of one of its slot that still waits; that one is dropped.
//! - None is started when it is older than its period: it is dropped, and the next of its slot takes
//!   its place. One that was handed over late may wait for half a period and at most 10 ms in any case:
//!   otherwise a source whose data are always that late would never be heard.
//! - They leave in the order in which they were handed over as long as this makes none of those that
//!   wait too old, as reckoned from the pace of the line. Otherwise the line is behind, and the one that
//!   is due first leaves first. It is due half a period after the time of validity.
//! - The place in the order and the time when it is due are those of the first message of its slot that
//!   has not left. So a slot that was passed over comes nearer to its turn with time: once it is due,
//!   each of the others can leave before it once at most.
//!
//! Why half a period: with a whole one (the earliest deadline first) an overfull line keeps the fast
//! sentences and loses half of the slow ones; with none (in turn) a batch of slow ones holds up the
//! fast ones although the line could carry all.
//!
//! What is a recording is kept whole and in order.

use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;

use insd_base::{Span, Time};

use super::outgoing::Outgoing;

/// How long a message may wait however late it was handed over, if its period is not short.
const LATE: i64 = 10_000_000;

/// What waits.
#[derive(Debug)]
pub(super) enum Waiting {
    /// All of it in order; when there are too many bytes the oldest go.
    All(All),
    /// The newest of each slot.
    Newest(Newest),
}

/// A message with its place in the order.
#[derive(Clone, Debug)]
pub(super) struct Item {
    pub(super) message: Arc<Outgoing>,
    turn: Turn,
    /// It is not started after this.
    expiry: Time,
}

#[derive(Clone, Copy, Debug)]
struct Turn {
    number: u64,
    due: Time,
}

/// When a message could start, and how long a byte takes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Start {
    pub(super) at: Time,
    pub(super) per_byte: Span,
}

/// All messages.
#[derive(Debug, Default)]
pub(super) struct All {
    items: VecDeque<Item>,
    bytes: usize,
}

/// The newest message of each slot.
#[derive(Debug, Default)]
pub(super) struct Newest {
    slots: BTreeMap<u16, Slot>,
    next: u64,
}

#[derive(Debug, Default)]
struct Slot {
    item: Option<Item>,
    /// The place of a message that was dropped for its age, for the next one.
    owed: Option<Turn>,
}

impl Waiting {
    /// Puts a message in at this time. Tells which ones are dropped for it, so that no more bytes wait
    /// than may.
    pub(super) fn put(
        &mut self,
        message: Arc<Outgoing>,
        now: Time,
        limit: usize,
        mut dropped: impl FnMut(&Outgoing),
    ) {
        if message.bytes.len() > limit {
            dropped(&message);
            return;
        }
        match self {
            Waiting::All(all) => all.put(message),
            Waiting::Newest(newest) => newest.put(message, now, &mut dropped),
        }
        while self.bytes() > limit {
            let Some(oldest) = self.take_oldest() else { break };
            dropped(&oldest.message);
        }
    }

    /// Takes the one that leaves next. Tells which ones are too old.
    pub(super) fn take(
        &mut self,
        start: Start,
        mut dropped: impl FnMut(&Outgoing),
    ) -> Option<Item> {
        match self {
            Waiting::All(all) => all.take(),
            Waiting::Newest(newest) => newest.take(start, &mut dropped),
        }
    }

    /// Puts back one that was taken and of which not a byte has left. It is dropped if there is a newer
    /// one.
    pub(super) fn put_back(&mut self, item: Item, mut dropped: impl FnMut(&Outgoing)) {
        match self {
            Waiting::All(all) => all.put_back(item),
            Waiting::Newest(newest) => newest.put_back(item, &mut dropped),
        }
    }

    /// Drops all that waits.
    pub(super) fn clear(&mut self, mut dropped: impl FnMut(&Outgoing)) {
        match self {
            Waiting::All(all) => {
                std::mem::take(all).items.iter().for_each(|item| dropped(&item.message));
            }
            Waiting::Newest(newest) => {
                newest.items().for_each(|item| dropped(&item.message));
                newest.slots.clear();
            }
        }
    }

    /// Whether nothing waits.
    pub(super) fn is_empty(&self) -> bool {
        match self {
            Waiting::All(all) => all.items.is_empty(),
            Waiting::Newest(newest) => newest.items().next().is_none(),
        }
    }

    fn bytes(&self) -> usize {
        match self {
            Waiting::All(all) => all.bytes,
            Waiting::Newest(newest) => newest.items().map(Item::length).sum(),
        }
    }

    fn take_oldest(&mut self) -> Option<Item> {
        match self {
            Waiting::All(all) => all.take(),
            Waiting::Newest(newest) => newest.take_least(|item| item.turn.number),
        }
    }
}

impl All {
    fn put(&mut self, message: Arc<Outgoing>) {
        self.bytes += message.bytes.len();
        let turn = Turn { number: 0, due: message.valid };
        self.items.push_back(Item { turn, expiry: message.valid, message });
    }

    fn take(&mut self) -> Option<Item> {
        let item = self.items.pop_front()?;
        self.bytes -= item.length();
        Some(item)
    }

    fn put_back(&mut self, item: Item) {
        self.bytes += item.length();
        self.items.push_front(item);
    }
}

impl Newest {
    fn put(&mut self, message: Arc<Outgoing>, now: Time, dropped: &mut impl FnMut(&Outgoing)) {
        self.next += 1;
        let own = Turn { number: self.next, due: message.valid + half(message.period) };
        let slot = self.slots.entry(message.slot).or_default();
        let older = slot.item.take();
        let inherited = older.as_ref().map(|older| older.turn).or(slot.owed.take());
        let (turn, expiry) = (inherited.unwrap_or(own), expiry(&message, now));
        slot.item = Some(Item { message, turn, expiry });
        if let Some(older) = older {
            dropped(&older.message);
        }
    }

    fn put_back(&mut self, item: Item, dropped: &mut impl FnMut(&Outgoing)) {
        let slot = self.slots.entry(item.message.slot).or_default();
        match &mut slot.item {
            Some(newer) => {
                newer.turn = item.turn;
                dropped(&item.message);
            }
            none => *none = Some(item),
        }
    }

    fn take(&mut self, start: Start, dropped: &mut impl FnMut(&Outgoing)) -> Option<Item> {
        for slot in self.slots.values_mut() {
            if let Some(old) = slot.item.take_if(|item| start.at > item.expiry) {
                slot.owed = Some(old.turn);
                dropped(&old.message);
            }
        }
        if self.is_behind(start) {
            self.take_least(|item| (item.turn.due, item.turn.number))
        } else {
            self.take_least(|item| item.turn.number)
        }
    }

    /// Whether one would become too old if all left in the order in which they were handed over.
    fn is_behind(&self, start: Start) -> bool {
        start.per_byte > Span::ZERO
            && self.items().any(|item| {
                let earlier = self.items().filter(|other| other.turn.number < item.turn.number);
                let bytes = earlier.map(Item::length).sum();
                start.at + times(start.per_byte, bytes) > item.expiry
            })
    }

    fn take_least<K: Ord>(&mut self, key: impl Fn(&Item) -> K) -> Option<Item> {
        let waiting = self.slots.values_mut().filter(|slot| slot.item.is_some());
        waiting.min_by_key(|slot| slot.item.as_ref().map(&key))?.item.take()
    }

    fn items(&self) -> impl Iterator<Item = &Item> {
        self.slots.values().filter_map(|slot| slot.item.as_ref())
    }
}

impl Item {
    fn length(&self) -> usize {
        self.message.bytes.len()
    }
}

/// So many bytes, each of which takes so long.
pub(super) fn times(per_byte: Span, bytes: usize) -> Span {
    let bytes = i64::try_from(bytes).unwrap_or(i64::MAX);
    Span::from_nanos(per_byte.as_nanos().saturating_mul(bytes))
}

fn expiry(message: &Outgoing, handed: Time) -> Time {
    let grace = half(message.period).min(Span::from_nanos(LATE));
    (message.valid + message.period).max(handed + grace)
}

fn half(period: Span) -> Span {
    Span::from_nanos(period.as_nanos() / 2)
}

#[cfg(test)]
mod tests;
