//! When a sentence is due.

use insd_base::Time;

/// How often a sentence is sent, in thousandths of a hertz, so that boundaries are exact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Rate(u32);

impl Rate {
    /// A rate from sentences per second, to the nearest 0.001 Hz and at least that. NaN and
    /// negative values give the lowest rate.
    #[must_use]
    pub fn from_hertz(hertz: f64) -> Self {
        Rate(((hertz * 1000.0).round() as u32).max(1))
    }

    /// Sentences per second.
    #[must_use]
    pub fn as_hertz(self) -> f64 {
        f64::from(self.0) / 1000.0
    }

    /// The number of the interval that an instant lies in; intervals begin at whole multiples of
    /// the rate's period on the voyage's time line.
    fn interval(self, time: Time) -> i128 {
        (i128::from(time.as_nanos()) * i128::from(self.0)).div_euclid(1_000_000_000_000)
    }
}

/// Remembers the interval of the last sentence sent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Schedule {
    rate: Rate,
    last: Option<i128>,
}

impl Schedule {
    pub(crate) fn new(rate: Rate) -> Self {
        Schedule { rate, last: None }
    }

    /// Whether this instant is the first one of an interval, so that sentences of one rate leave
    /// together and a late or missing solution does not shift the ones after it.
    pub(crate) fn is_due(&mut self, time: Time) -> bool {
        let interval = self.rate.interval(time);
        let due = self.last.is_none_or(|last| interval > last);
        if due {
            self.last = Some(interval);
        }
        due
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sent(rate: f64, steps: impl Iterator<Item = i64>, step_ms: i64) -> Vec<i64> {
        let mut schedule = Schedule::new(Rate::from_hertz(rate));
        let at = |step| Time::from_nanos(step * step_ms * 1_000_000);
        steps.filter(|step| schedule.is_due(at(*step))).collect()
    }

    #[test]
    fn a_sentence_leaves_at_the_first_solution_of_each_interval() {
        assert_eq!(sent(1.0, 0..35, 100), [0, 10, 20, 30]);
        assert_eq!(sent(10.0, 0..5, 100), [0, 1, 2, 3, 4]);
        assert_eq!(sent(3.0, 0..11, 100), [0, 4, 7, 10]);
        assert_eq!(sent(0.1, 0..25, 1000), [0, 10, 20]);
    }

    #[test]
    fn a_gap_in_the_solutions_does_not_shift_the_boundaries() {
        let steps = (0..35).filter(|step| !(8..13).contains(step));
        assert_eq!(sent(1.0, steps, 100), [0, 13, 20, 30]);
    }

    #[test]
    fn a_rate_above_that_of_the_solutions_sends_each_solution_once() {
        assert_eq!(sent(1000.0, [0, 1, 1, 2].into_iter(), 100), [0, 1, 2]);
    }
}
