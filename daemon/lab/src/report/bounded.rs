//! The first and the last of many.

use std::collections::VecDeque;

/// The first so many things and the last so many, and how many there were.
#[derive(Clone, Debug)]
pub(crate) struct Bounded<T> {
    limit: usize,
    first: Vec<T>,
    last: VecDeque<T>,
    count: u64,
}

impl<T> Bounded<T> {
    /// Keeps `limit` at each end.
    pub(crate) fn new(limit: usize) -> Self {
        Bounded { limit, first: Vec::new(), last: VecDeque::new(), count: 0 }
    }

    /// Takes the next.
    pub(crate) fn push(&mut self, thing: T) {
        self.count += 1;
        if self.first.len() < self.limit {
            self.first.push(thing);
            return;
        }
        self.last.push_back(thing);
        if self.last.len() > self.limit {
            self.last.pop_front();
        }
    }

    /// How many there were.
    pub(crate) fn count(&self) -> u64 {
        self.count
    }

    /// How many were left out between the first and the last.
    pub(crate) fn left_out(&self) -> u64 {
        self.count - (self.first.len() + self.last.len()) as u64
    }

    /// Those at the beginning.
    pub(crate) fn first(&self) -> impl Iterator<Item = &T> {
        self.first.iter()
    }

    /// Those at the end that are not at the beginning.
    pub(crate) fn last(&self) -> impl Iterator<Item = &T> {
        self.last.iter()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_ends_are_kept_and_the_middle_is_counted() {
        let mut own = Bounded::new(2);
        (1..=3).for_each(|number| own.push(number));
        assert_eq!((own.left_out(), own.last().copied().collect::<Vec<_>>()), (0, vec![3]));
        (4..=9).for_each(|number| own.push(number));
        assert_eq!(own.first().copied().collect::<Vec<_>>(), [1, 2]);
        assert_eq!(own.last().copied().collect::<Vec<_>>(), [8, 9]);
        assert_eq!((own.count(), own.left_out()), (9, 5));
    }
}
