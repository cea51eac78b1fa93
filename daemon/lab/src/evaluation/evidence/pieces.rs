//! How long something held, and in how many pieces.

use insd_base::{Span, Time};

/// Rows further apart than this are not taken to hold until the next, whatever their rate.
const SHORT_GAP: i64 = 1_000_000_000;
/// Unless they usually are: so many median intervals.
const BRIDGED_INTERVALS: i64 = 3;

/// Time in which something held, entered in order of time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pieces {
    total: i64,
    longest: i64,
    piece: Option<i64>,
    count: u64,
    first: Option<Time>,
    last: Option<Time>,
}

impl Pieces {
    /// Whether it holds from an instant on for so long.
    pub fn enter(&mut self, time: Time, held: Span, holds: bool) {
        if !holds {
            self.piece = None;
            return;
        }
        self.count += u64::from(self.piece.is_none());
        let piece = self.piece.unwrap_or(0).saturating_add(held.as_nanos());
        self.piece = Some(piece);
        self.longest = self.longest.max(piece);
        self.total = self.total.saturating_add(held.as_nanos());
        self.first.get_or_insert(time);
        self.last = Some(time);
    }

    /// Nothing is known of what follows: a piece ends.
    pub fn cut(&mut self) {
        self.piece = None;
    }

    /// In all, s.
    #[must_use]
    pub fn total(&self) -> f64 {
        Span::from_nanos(self.total).as_seconds()
    }

    /// The longest piece, s.
    #[must_use]
    pub fn longest(&self) -> f64 {
        Span::from_nanos(self.longest).as_seconds()
    }

    /// How many pieces.
    #[must_use]
    pub fn count(&self) -> u64 {
        self.count
    }

    /// The first and the last instant at which it held, if it ever did.
    #[must_use]
    pub fn extent(&self) -> Option<(Time, Time)> {
        self.first.zip(self.last)
    }
}

/// An instant of a series, and how long what is said of it holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::evaluation) struct Step {
    pub(in crate::evaluation) time: Time,
    /// Until the next instant; before a gap and at the end the median interval.
    pub(in crate::evaluation) held: Span,
    /// Whether a gap follows.
    pub(in crate::evaluation) is_cut: bool,
}

/// The steps of instants in order of time.
pub(super) fn steps(times: &[Time]) -> Vec<Step> {
    let mut intervals: Vec<i64> =
        times.windows(2).map(|pair| (pair[1] - pair[0]).as_nanos()).collect();
    let untils = intervals.clone();
    intervals.sort_unstable();
    let median = intervals.get(intervals.len() / 2).copied().unwrap_or(0);
    let bridged = SHORT_GAP.max(median.saturating_mul(BRIDGED_INTERVALS));
    let step = |(at, time): (usize, &Time)| {
        let until = untils.get(at).copied().filter(|until| *until <= bridged);
        let held = Span::from_nanos(until.unwrap_or(median));
        Step { time: *time, held, is_cut: until.is_none() }
    };
    times.iter().enumerate().map(step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(seconds: f64) -> Time {
        Time::from_seconds(seconds)
    }

    #[test]
    fn a_row_holds_until_the_next_but_not_through_a_gap() {
        let told = steps(&[at(0.0), at(0.5), at(1.0), at(9.0), at(9.5)]);
        let held: Vec<f64> = told.iter().map(|step| step.held.as_seconds()).collect();
        assert_eq!(held, [0.5; 5]);
        let cut: Vec<bool> = told.iter().map(|step| step.is_cut).collect();
        assert_eq!(cut, [false, false, true, false, true]);
        assert_eq!(steps(&[at(3.0)])[0].held, Span::ZERO);
    }

    #[test]
    fn pieces_end_where_it_does_not_hold_and_at_a_cut() {
        let mut pieces = Pieces::default();
        let second = Span::from_seconds(1.0);
        for (time, holds) in [(0, true), (1, true), (2, false), (3, true), (4, true), (5, true)] {
            pieces.enter(at(f64::from(time)), second, holds);
        }
        pieces.cut();
        pieces.enter(at(60.0), second, true);
        assert_eq!((pieces.total(), pieces.longest(), pieces.count()), (6.0, 3.0, 3));
        assert_eq!(pieces.extent(), Some((at(0.0), at(60.0))));
        assert_eq!(Pieces::default().extent(), None);
    }
}
