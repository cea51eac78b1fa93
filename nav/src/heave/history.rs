//! The displacement of the last minutes, tick by tick.

use std::collections::VecDeque;

use nalgebra::Vector4;

use super::kernel::{Kernel, SPACING};
use super::times::TICK;

/// The twice integrated acceleration, up, m, and the direction of down in body axes: what the
/// displacement of every point is a sum of.
pub(super) type Raw = Vector4<f64>;

/// Ticks between the taps of a kernel.
const STRIDE: usize = (SPACING / TICK + 0.5) as usize;

/// A ring of the displacements of all ticks.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct History {
    ticks: VecDeque<Raw>,
    length: usize,
}

impl History {
    /// Room for `seconds` of ticks.
    pub(super) fn new(seconds: f64) -> Self {
        let length = ticks(seconds) + 1;
        History { ticks: VecDeque::with_capacity(length), length }
    }

    /// Takes the displacement of one more tick.
    pub(super) fn push(&mut self, raw: Raw) {
        if self.ticks.len() == self.length {
            self.ticks.pop_front();
        }
        self.ticks.push_back(raw);
    }

    /// The displacement so many ticks ago.
    pub(super) fn back(&self, ticks: usize) -> Option<&Raw> {
        self.ticks.get(self.ticks.len().checked_sub(ticks + 1)?)
    }

    /// The average about the instant `ago` ticks ago, once all that it covers is there.
    pub(super) fn average(&self, kernel: &Kernel, ago: usize) -> Option<Raw> {
        let middle = self.ticks.len().checked_sub(ago + 1)?;
        let reach = kernel.0.len().checked_sub(1)? * STRIDE;
        if middle < reach || ago < reach {
            return None;
        }
        let mut sum = Raw::zeros();
        for (i, tap) in kernel.0.iter().enumerate() {
            let earlier = self.ticks.get(middle - i * STRIDE)?;
            let later = self.ticks.get(middle + i * STRIDE)?;
            let pair = if i == 0 { *earlier } else { earlier + later };
            sum += pair * *tap;
        }
        Some(sum)
    }

    /// Takes a straight line away from the integral: `displacement` now, changing by `velocity`, m/s.
    pub(super) fn rebase(&mut self, displacement: f64, velocity: f64) {
        for (age, raw) in self.ticks.iter_mut().rev().enumerate() {
            raw.x -= displacement - velocity * TICK * age as f64;
        }
    }
}

/// Whole ticks in so many seconds.
pub(super) fn ticks(seconds: f64) -> usize {
    (seconds / TICK).round() as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_average_stays_the_heave_when_the_integral_gets_a_new_origin() {
        let kernel = Kernel::low_pass(20.0, 8.0, 20.0);
        let mut history = History::new(40.0);
        for i in 0..ticks(60.0) {
            let t = i as f64 * TICK;
            history.push(Raw::new(t.sin() + 3.0 * t * t, 0.0, 0.0, 1.0));
        }
        let heave = |history: &History| {
            let ago = ticks(20.0);
            history.back(ago).unwrap().x - history.average(&kernel, ago).unwrap().x
        };
        let before = heave(&history);
        history.rebase(1e4, 350.0);
        assert!((heave(&history) - before).abs() < 1e-6);
        assert!((before - 39.9_f64.sin()).abs() < 0.01, "{before}");
    }

    #[test]
    fn nothing_is_averaged_that_is_not_there() {
        let kernel = Kernel::low_pass(20.0, 8.0, 20.0);
        let mut history = History::new(40.0);
        for i in 0..=ticks(40.0) {
            assert!(history.average(&kernel, ticks(20.0)).is_none(), "{i}");
            history.push(Raw::zeros());
        }
        assert!(history.average(&kernel, ticks(20.0)).is_some());
        assert!(history.average(&kernel, ticks(19.0)).is_none());
    }
}
