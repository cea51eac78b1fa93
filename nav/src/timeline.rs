//! The time line: measurements are applied at their time of validity, however late they arrive
//! within the history that is kept.
//!
//! The newest state runs along with the IMU. A late measurement sends the estimator back to a
//! checkpoint before it; increments and measurements since then are applied again in the order of
//! validity. A measurement that arrives in time costs nothing extra.

use std::collections::VecDeque;

use insd_base::{Message, Received, Rejection, Solution, Source, Span, Time};

use crate::increments::Increment;
use crate::report::{AidReport, Outcome, Report};

/// What runs on a time line.
pub trait Estimator: Clone {
    /// Moves the estimate over an increment.
    fn advance(&mut self, increment: &Increment);
    /// Applies a measurement that is valid now.
    fn apply(&mut self, received: &Received) -> Report;
    /// The solution now.
    fn solution(&self) -> Solution;
    /// The solution at an instant inside an increment that starts now, without moving there.
    fn solution_at(&self, increment: &Increment, at: Time) -> Solution;
}

/// An estimator with the history it needs to go back.
#[derive(Clone, Debug)]
pub struct Timeline<E> {
    estimator: E,
    now: Time,
    increments: VecDeque<Increment>,
    measurements: VecDeque<Received>,
    pending: VecDeque<Received>,
    checkpoints: VecDeque<(Time, E)>,
}

/// History kept for late measurements.
pub const HISTORY: Span = Span::from_nanos(2_500_000_000);
/// Spacing of checkpoints.
const CHECKPOINT: Span = Span::from_nanos(500_000_000);

impl<E: Estimator> Timeline<E> {
    /// A time line that starts with an estimate at an instant.
    #[must_use]
    pub fn new(estimator: E, now: Time) -> Self {
        Timeline {
            checkpoints: VecDeque::from([(now, estimator.clone())]),
            estimator,
            now,
            increments: VecDeque::new(),
            measurements: VecDeque::new(),
            pending: VecDeque::new(),
        }
    }

    /// Instant of the newest state.
    #[must_use]
    pub fn now(&self) -> Time {
        self.now
    }

    /// The newest state.
    #[must_use]
    pub fn estimator(&self) -> &E {
        &self.estimator
    }

    /// The newest state, to be changed. What is changed is lost when a measurement comes that is valid before.
    pub fn estimator_mut(&mut self) -> &mut E {
        &mut self.estimator
    }

    /// Changes the newest state for good: what is valid before comes too late from then on.
    pub fn amend(&mut self, change: impl FnOnce(&mut E)) {
        change(&mut self.estimator);
        self.checkpoints = VecDeque::from([(self.now, self.estimator.clone())]);
        self.increments.clear();
        self.measurements.clear();
    }

    /// Moves on over an increment; measurements that were waiting for it are applied on the way.
    pub fn advance(&mut self, increment: &Increment) -> Vec<Report> {
        self.keep_checkpoint();
        let mut reports = Vec::new();
        let mut rest = *increment;
        while let Some(next) = self.pending.front().cloned() {
            let at = next.message.time();
            if at > increment.to {
                break;
            }
            self.pending.pop_front();
            rest = run_until(&mut self.estimator, rest, at);
            reports.push(self.estimator.apply(&next));
            insert_in_order(&mut self.measurements, next);
        }
        run_until(&mut self.estimator, rest, increment.to);
        self.now = increment.to;
        self.increments.push_back(*increment);
        self.forget();
        reports
    }

    /// Takes a measurement: applied now, when the IMU gets there, or back in the history.
    pub fn measure(&mut self, received: &Received) -> Option<Report> {
        let at = received.message.time();
        if at > self.now {
            insert_in_order(&mut self.pending, received.clone());
            return None;
        }
        let is_newest = self.measurements.back().is_none_or(|m| order(m) <= order(received));
        if at == self.now && is_newest {
            insert_in_order(&mut self.measurements, received.clone());
            return Some(self.estimator.apply(received));
        }
        Some(self.rewind_to(received))
    }

    fn rewind_to(&mut self, received: &Received) -> Report {
        let at = received.message.time();
        let Some(index) = self.checkpoints.iter().rposition(|(time, _)| *time < at) else {
            return too_late(received);
        };
        let place = insert_in_order(&mut self.measurements, received.clone());
        self.checkpoints.truncate(index + 1);
        let (from, state) = &self.checkpoints[index];
        let from = *from;
        self.estimator = state.clone();
        self.now = from;
        self.repeat_since(from, place)
    }

    /// Repeats increments and measurements after a checkpoint; returns the report of the measurement
    /// at `place`.
    fn repeat_since(&mut self, from: Time, place: usize) -> Report {
        let mut wanted = Report::default();
        let mut index = self.measurements.partition_point(|m| m.message.time() <= from);
        let increments = std::mem::take(&mut self.increments);
        for increment in increments.iter().filter(|increment| increment.from >= from) {
            self.keep_checkpoint();
            let mut rest = *increment;
            while let Some(next) = self.measurements.get(index).cloned() {
                let at = next.message.time();
                if at > increment.to {
                    break;
                }
                rest = run_until(&mut self.estimator, rest, at);
                let report = self.estimator.apply(&next);
                if index == place {
                    wanted = report;
                }
                index += 1;
            }
            run_until(&mut self.estimator, rest, increment.to);
            self.now = increment.to;
        }
        self.increments = increments;
        wanted
    }

    /// Keeps the state as it is before it moves on, with every measurement up to now applied.
    fn keep_checkpoint(&mut self) {
        let due = self.checkpoints.back().is_none_or(|(time, _)| self.now - *time >= CHECKPOINT);
        if due {
            self.checkpoints.push_back((self.now, self.estimator.clone()));
        }
    }

    fn forget(&mut self) {
        let horizon = self.now - HISTORY;
        while self.checkpoints.get(1).is_some_and(|(time, _)| *time <= horizon) {
            self.checkpoints.pop_front();
        }
        let oldest = self.checkpoints.front().map_or(self.now, |(time, _)| *time);
        while self.increments.front().is_some_and(|increment| increment.to <= oldest) {
            self.increments.pop_front();
        }
        while self.measurements.front().is_some_and(|m| m.message.time() <= oldest) {
            self.measurements.pop_front();
        }
    }
}

/// Runs an estimator over the part of an increment up to an instant and returns the rest.
fn run_until<E: Estimator>(estimator: &mut E, increment: Increment, at: Time) -> Increment {
    if at <= increment.from {
        return increment;
    }
    if at >= increment.to {
        estimator.advance(&increment);
        return Increment { from: increment.to, ..increment };
    }
    let (head, tail) = increment.split(at);
    estimator.advance(&head);
    tail
}

/// The order in which measurements are applied: by time of validity and, where that is the same, by
/// source, so that the order of arrival leaves no trace. A receiver that is only compared comes last: whoever else
/// spoke at that instant need not be repeated for it.
fn order(received: &Received) -> (Time, bool, Source) {
    let is_compared = matches!(received.message, Message::Gnss(fix) if fix.rank > 0);
    (received.message.time(), is_compared, received.source)
}

/// Inserts in order, behind its equals; returns the place.
fn insert_in_order(list: &mut VecDeque<Received>, received: Received) -> usize {
    let place = list.partition_point(|m| order(m) <= order(&received));
    list.insert(place, received);
    place
}

fn too_late(received: &Received) -> Report {
    let lost = AidReport {
        time: received.message.time(),
        source: received.source,
        aid: received.source.name(),
        outcome: Outcome::Rejected(Rejection::TooLate),
        innovation: [(f64::NAN, f64::NAN); 3],
    };
    Report { aids: vec![lost], ..Report::default() }
}

#[cfg(test)]
mod tests;
