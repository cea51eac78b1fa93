//! What a kind of lie draws its size, axis, direction and moment with.

use nalgebra::{Vector2, Vector3};
use rand::RngExt;
use rand_pcg::Pcg64;

use super::{Grade, Suite, Window};
use crate::random::uniform;

/// When a lie begins at the earliest and at the latest, s.
const ONSET: [f64; 2] = [1200.0, 2400.0];
/// When one begins at the berth, s.
const AT_BERTH: [f64; 2] = [30.0, 270.0];
/// For how long one lasts that heals, s.
const HEALS: [f64; 2] = [20.0, 300.0];

/// Draws numbers for a case.
pub(super) struct Draw {
    pub(super) rng: Pcg64,
    pub(super) grade: Grade,
    pub(super) suite: Suite,
}

impl Draw {
    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        uniform(&mut self.rng, low, high)
    }

    /// Evenly in the logarithm.
    pub(super) fn size(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    pub(super) fn signed(&mut self, low: f64, high: f64) -> f64 {
        let size = self.size(low, high);
        if self.rng.random::<bool>() { size } else { -size }
    }

    /// Of such a length, in any direction.
    pub(super) fn vector(&mut self, low: f64, high: f64) -> Vector2<f64> {
        let (length, angle) = (self.size(low, high), self.between(0.0, std::f64::consts::TAU));
        Vector2::new(length * angle.cos(), length * angle.sin())
    }

    pub(super) fn axis(&mut self) -> usize {
        self.rng.random_range(0..3)
    }

    /// Along one axis.
    pub(super) fn along(&mut self, low: f64, high: f64) -> Vector3<f64> {
        let (axis, size) = (self.axis(), self.signed(low, high));
        Vector3::from_fn(|i, _| if i == axis { size } else { 0.0 })
    }

    /// To the end.
    pub(super) fn onset(&mut self) -> Window {
        Window { from: self.between(ONSET[0], ONSET[1]).round(), until: f64::INFINITY }
    }

    /// At the berth, while she aligns.
    pub(super) fn at_berth(&mut self) -> Window {
        let [from, to] = AT_BERTH;
        Window { from: self.between(from, to).round(), until: f64::INFINITY }
    }

    /// It heals.
    pub(super) fn moment(&mut self) -> Window {
        let window = self.onset();
        Window { until: window.from + self.size(HEALS[0], HEALS[1]).round(), ..window }
    }
}
