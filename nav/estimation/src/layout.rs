//! Which error states there are, and in which order.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::key::Key;

/// Where a block stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Place {
    /// Its name.
    pub key: Key,
    /// Index of its first state.
    pub start: usize,
    /// Number of its states.
    pub width: usize,
}

/// The blocks of a state vector in their order. A copy is a reference; a change makes another one.
#[derive(Clone, Debug)]
pub struct Layout(Arc<Places>);

#[derive(Debug)]
struct Places {
    all: Vec<Place>,
    states: usize,
    /// Of the first instances of the first kinds, which most are: their starts, or [`ABSENT`].
    first: [u16; DIRECT],
}

/// Kinds of which the first instance is found without a search.
const DIRECT: usize = 64;
const ABSENT: u16 = u16::MAX;

impl Layout {
    /// No state at all.
    #[must_use]
    pub fn empty() -> Self {
        Layout::of(Vec::new())
    }

    /// Blocks in this order, by their names and widths.
    #[must_use]
    pub fn of_blocks(blocks: impl IntoIterator<Item = (Key, usize)>) -> Self {
        let mut end = 0;
        let place = |(key, width)| {
            let start = end;
            end += width;
            Place { key, start, width }
        };
        Layout::of(blocks.into_iter().map(place).collect())
    }

    fn of(all: Vec<Place>) -> Self {
        let states = all.last().map_or(0, |last| last.start + last.width);
        let mut first = [ABSENT; DIRECT];
        for place in all.iter().filter(|place| place.key.instance == 0) {
            if let Some(slot) = first.get_mut(usize::from(place.key.kind)) {
                *slot = u16::try_from(place.start).unwrap_or(ABSENT);
            }
        }
        Layout(Arc::new(Places { all, states, first }))
    }

    /// Number of states.
    #[must_use]
    pub fn states(&self) -> usize {
        self.0.states
    }

    /// All blocks in their order.
    #[must_use]
    pub fn places(&self) -> &[Place] {
        &self.0.all
    }

    /// Where a block stands, if it is there.
    #[must_use]
    pub fn place(&self, key: Key) -> Option<Place> {
        self.0.all.iter().find(|place| place.key == key).copied()
    }

    /// Index of the first state of a block, if it is there.
    #[must_use]
    pub fn start(&self, key: Key) -> Option<usize> {
        let direct = self.0.first.get(usize::from(key.kind)).filter(|_| key.instance == 0);
        match direct {
            Some(start) => (*start != ABSENT).then_some(usize::from(*start)),
            None => self.place(key).map(|place| place.start),
        }
    }

    /// The same with a block more at its end; as it is if that is there already.
    #[must_use]
    pub fn with(&self, key: Key, width: usize) -> Self {
        if self.place(key).is_some() {
            return self.clone();
        }
        let mut all = self.0.all.clone();
        all.push(Place { key, start: self.states(), width });
        Layout::of(all)
    }

    /// The same without a block: those behind it move up.
    #[must_use]
    pub fn without(&self, key: Key) -> Self {
        let rest = self.0.all.iter().filter(|place| place.key != key);
        Layout::of_blocks(rest.map(|place| (place.key, place.width)))
    }
}

impl PartialEq for Layout {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || self.0.all == other.0.all
    }
}

impl Default for Layout {
    fn default() -> Self {
        Layout::empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: Key = Key { kind: 0, instance: 0 };
    const B: Key = Key { kind: 1, instance: 0 };
    const B_AGAIN: Key = Key { kind: 1, instance: 7 };
    const FAR: Key = Key { kind: 900, instance: 0 };

    #[test]
    fn who_leaves_lets_the_others_move_up() {
        let all = Layout::of_blocks([(A, 3), (B, 2), (B_AGAIN, 2), (FAR, 1)]);
        assert_eq!(all.states(), 8);
        let rest = all.without(B);
        assert_eq!(rest.states(), 6);
        let starts = [A, B, B_AGAIN, FAR].map(|key| rest.start(key));
        assert_eq!(starts, [Some(0), None, Some(3), Some(5)]);
        assert_eq!(rest.with(B, 2).start(B), Some(6));
    }

    #[test]
    fn who_is_there_does_not_join_again() {
        let one = Layout::empty().with(A, 3);
        assert_eq!(one.with(A, 3), one);
        assert_eq!(one.with(B, 1).without(B), one);
    }
}
