//! How often something may be done: a few times at once, and then at a steady rate.

use insd_base::{Span, Time};

/// A bucket of tokens.
#[derive(Clone, Debug)]
pub(crate) struct Budget {
    /// Tokens at most.
    most: u32,
    /// Time from one new token to the next.
    every: Span,
    /// Tokens there are.
    left: u32,
    /// When they were last counted.
    counted: Option<Time>,
}

impl Budget {
    pub(crate) fn new(most: u32, every: Span) -> Self {
        Budget { most, every, left: most, counted: None }
    }

    /// Takes a token; false if there is none.
    pub(crate) fn take(&mut self, now: Time) -> bool {
        self.refill(now);
        let some = self.left > 0;
        self.left -= u32::from(some);
        some
    }

    /// When there will be a token.
    pub(crate) fn next(&self, now: Time) -> Time {
        if self.left > 0 { now } else { self.counted.unwrap_or(now) + self.every }
    }

    fn refill(&mut self, now: Time) {
        let counted = *self.counted.get_or_insert(now);
        let fresh = (now - counted).as_nanos().max(0) / self.every.as_nanos().max(1);
        self.left = self.left.saturating_add(fresh.min(i64::from(self.most)) as u32).min(self.most);
        let spent = self.every.as_nanos().saturating_mul(fresh);
        self.counted = Some(counted + Span::from_nanos(spent));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_budget_allows_a_burst_and_then_a_rate() {
        let mut budget = Budget::new(3, Span::from_seconds(0.1));
        let taken: u32 = (0..1000)
            .map(|milliseconds| {
                u32::from(budget.take(Time::from_nanos(5 + milliseconds * 1_000_000)))
            })
            .sum();
        assert_eq!(taken, 3 + 9);
        let now = Time::from_seconds(0.95);
        assert!(budget.next(now) > now);
    }
}
