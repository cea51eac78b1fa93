//! The samples of the last seconds on a regular grid; a lost sample is an empty slot.

use std::collections::VecDeque;

use insd_base::{Span, Time};
use nalgebra::Vector2;

/// Distance from the grid, in intervals, up to which a sample is taken as lying on it.
const JITTER: f64 = 0.1;

/// What became of a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Push {
    /// It is in the window.
    Kept,
    /// It came before the next instant of the grid and is left out.
    Early,
    /// It came after a gap as long as the window, or off the grid: the window begins anew with it.
    Restarted,
    /// Not a number: left out, as if it had been lost on the way.
    NotFinite,
}

/// Ring of samples, oldest first. Its first and last slots are never empty.
#[derive(Clone, Debug)]
pub(super) struct Window {
    slots: VecDeque<Option<Vector2<f64>>>,
    length: usize,
    interval: f64,
    newest: Option<Time>,
}

impl Window {
    pub(super) fn new(interval: Span, length: usize) -> Self {
        Window {
            slots: VecDeque::with_capacity(length),
            length,
            interval: interval.as_seconds(),
            newest: None,
        }
    }

    /// Time of the newest sample.
    pub(super) fn newest(&self) -> Option<Time> {
        self.newest
    }

    /// From sample to sample, s.
    pub(super) fn interval(&self) -> f64 {
        self.interval
    }

    /// The slots, oldest first.
    pub(super) fn slots(&self) -> impl ExactSizeIterator<Item = &Option<Vector2<f64>>> {
        self.slots.iter()
    }

    /// Slots that memory is reserved for.
    #[cfg(test)]
    pub(super) fn capacity(&self) -> usize {
        self.slots.capacity()
    }

    pub(super) fn clear(&mut self) {
        self.slots.clear();
        self.newest = None;
    }

    pub(super) fn push(&mut self, time: Time, velocity: Vector2<f64>) -> Push {
        if !velocity.iter().all(|v| v.is_finite()) {
            return Push::NotFinite;
        }
        let Some(newest) = self.newest else {
            self.append(time, velocity);
            return Push::Kept;
        };
        let steps = (time - newest).as_seconds() / self.interval;
        let is_off_grid = (steps - steps.round()).abs() > JITTER;
        if steps < 1.0 - JITTER {
            return Push::Early;
        }
        if is_off_grid || steps.round() >= self.length as f64 {
            self.clear();
            self.append(time, velocity);
            return Push::Restarted;
        }
        for _ in 1..steps.round() as usize {
            self.append_slot(None);
        }
        self.append(time, velocity);
        Push::Kept
    }

    /// Adds the polynomial with these derivatives at the newest sample: m/s, m/s^2, and so on.
    pub(super) fn shift(&mut self, derivatives: &[Vector2<f64>]) {
        for (age, slot) in self.slots.iter_mut().rev().enumerate() {
            let t = -(age as f64) * self.interval;
            if let Some(velocity) = slot {
                // Horner's scheme of sum d_n t^n / n!
                let highest_first = derivatives.iter().enumerate().rev();
                *velocity += highest_first
                    .fold(Vector2::zeros(), |sum, (n, d)| d + sum * (t / (n + 1) as f64));
            }
        }
    }

    fn append(&mut self, time: Time, velocity: Vector2<f64>) {
        self.append_slot(Some(velocity));
        self.newest = Some(time);
        while self.slots.front().is_some_and(Option::is_none) {
            self.slots.pop_front();
        }
    }

    fn append_slot(&mut self, slot: Option<Vector2<f64>>) {
        if self.slots.len() >= self.length {
            self.slots.pop_front();
        }
        self.slots.push_back(slot);
    }
}
