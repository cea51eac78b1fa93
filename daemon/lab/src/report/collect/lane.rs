//! What was the case when, as bits in bins.

use insd_base::{Span, Time};

use crate::report::bins::{Bins, Flags, LIMIT};

/// Width of the first bins.
const WIDTH: Span = Span::from_nanos(1_000_000_000);

/// A strip over the time of the recording.
#[derive(Clone, Debug)]
pub(crate) struct Lane {
    bins: Bins<Flags>,
    state: Option<(Time, u16)>,
}

/// A part of a strip in which a bit is set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Run {
    pub(crate) from: Time,
    pub(crate) to: Time,
}

impl Lane {
    /// A strip on which nothing is known yet.
    pub(crate) fn new(start: Time) -> Self {
        Lane { bins: Bins::new(start, WIDTH, LIMIT), state: None }
    }

    /// Something happened.
    pub(crate) fn mark(&mut self, time: Time, bit: u16) {
        self.bins.change(time, |flags| flags.0 |= bit);
    }

    /// From now on this lasts, and what was before does not.
    pub(crate) fn last(&mut self, now: Time, bit: u16) {
        self.finish(now);
        self.state = Some((now, bit));
    }

    /// What lasts has lasted until now.
    pub(crate) fn finish(&mut self, now: Time) {
        if let Some((since, bit)) = self.state {
            self.bins.change_all(since, now, |flags| flags.0 |= bit);
            self.state = Some((now, bit));
        }
    }

    /// Where a bit is set. Between neighbours of which each is only marked now and then there is no gap.
    pub(crate) fn runs(&self, bit: u16) -> Vec<Run> {
        let mut runs: Vec<Run> = Vec::new();
        let width = self.bins.width();
        for (from, _) in self.bins.iter().filter(|(_, flags)| flags.0 & bit > 0) {
            let to = from + width;
            match runs.last_mut() {
                Some(run) if from - run.to <= width => run.to = to,
                _ => runs.push(Run { from, to }),
            }
        }
        runs
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(seconds: f64) -> Time {
        Time::from_seconds(seconds)
    }

    fn seconds(runs: &[Run]) -> Vec<(f64, f64)> {
        runs.iter().map(|run| (run.from.as_seconds(), run.to.as_seconds())).collect()
    }

    #[test]
    fn what_lasts_ends_where_the_next_begins() {
        let mut lane = Lane::new(Time::START);
        lane.last(at(2.0), 1);
        lane.last(at(10.0), 2);
        lane.finish(at(20.0));
        assert_eq!(seconds(&lane.runs(1)), [(2.0, 11.0)]);
        assert_eq!(seconds(&lane.runs(2)), [(10.0, 21.0)]);
        assert_eq!(lane.runs(4), []);
    }

    #[test]
    fn marks_a_second_apart_are_one_run_and_an_outage_parts_them() {
        let mut lane = Lane::new(Time::START);
        (0..10).chain(15..20).for_each(|second| lane.mark(at(f64::from(second) + 0.1), 1));
        assert_eq!(seconds(&lane.runs(1)), [(0.0, 10.0), (15.0, 20.0)]);
    }
}
