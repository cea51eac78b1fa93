//! How fast counters grow.

use std::collections::VecDeque;

use insd_base::Time;

/// Looks that are remembered: so many seconds.
const LOOKS: usize = 5;

/// The last values of some counters.
#[derive(Debug, Default)]
pub(super) struct Rates {
    looks: VecDeque<(Time, Vec<u64>)>,
}

impl Rates {
    /// Takes note of the counters, always in the same order. When there are others all begins anew.
    pub(super) fn note(&mut self, now: Time, counts: impl Iterator<Item = u64>) {
        let counts: Vec<u64> = counts.collect();
        if self.looks.back().is_some_and(|(_, before)| before.len() != counts.len()) {
            self.looks.clear();
        }
        if self.looks.len() > LOOKS {
            self.looks.pop_front();
        }
        self.looks.push_back((now, counts));
    }

    /// Growth of a counter a second, over the last seconds; `None` before it could be seen.
    pub(super) fn rate(&self, index: usize) -> Option<f64> {
        let ((from, first), (to, last)) = (self.looks.front()?, self.looks.back()?);
        let (first, last) = (first.get(index)?, last.get(index)?);
        let passed = (*to - *from).as_seconds();
        // a counter that began anew tells nothing
        (passed > 0.0).then(|| last.checked_sub(*first).map(|more| more as f64 / passed))?
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rate_is_that_of_the_last_seconds() {
        let mut rates = Rates::default();
        assert_eq!(rates.rate(0), None);
        for second in 0..20_u64 {
            let count = if second < 10 { 0 } else { 7 * (second - 10) };
            rates.note(Time::from_seconds(second as f64), [count, 3].into_iter());
        }
        assert_eq!((rates.rate(0), rates.rate(1), rates.rate(2)), (Some(7.0), Some(0.0), None));
        rates.note(Time::from_seconds(20.0), [0, 3].into_iter());
        assert_eq!(rates.rate(0), None);
    }
}
