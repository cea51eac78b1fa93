//! The instants of the solutions: whole multiples of the output period.

use insd_base::{Solution, Span, Time};
use insd_nav::{Estimator, Increment, Timeline};

use crate::ship::Ship;

/// The instant of an epoch: whole multiples of the period since the start of the voyage.
fn epoch_time(period: Span, index: i64) -> Time {
    Time::from_nanos(index.saturating_mul(period.as_nanos()))
}

/// First epoch after an instant.
pub(crate) fn epoch_after(period: Span, time: Time) -> i64 {
    time.as_nanos().div_euclid(period.as_nanos().max(1)) + 1
}

/// Solutions at the epochs strictly inside an increment, before the ship moves over it.
pub(crate) fn epochs(
    period: Span,
    next: &mut Option<i64>,
    increment: &Increment,
    line: &Timeline<Ship>,
    solutions: &mut Vec<Solution>,
) {
    let mut index = *next.get_or_insert_with(|| epoch_after(period, increment.from));
    while epoch_time(period, index) < increment.to {
        let at = epoch_time(period, index);
        if at > increment.from {
            solutions.push(line.estimator().solution_at(increment, at));
        }
        index += 1;
    }
    *next = Some(index);
}

/// The epoch at an instant, if there is one; it is then passed.
pub(crate) fn due_at(period: Span, next: &mut Option<i64>, time: Time) -> Option<Time> {
    let index = (*next)?;
    (epoch_time(period, index) == time).then(|| {
        *next = Some(index + 1);
        time
    })
}
