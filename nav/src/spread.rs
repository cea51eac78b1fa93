//! The spread of a quantity that should be zero on the mean: heave about the sea level, sway about
//! the berth. Learnt as a running mean square.

use serde::{Deserialize, Serialize};

/// A running mean square.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    mean_square: f64,
    least: f64,
}

/// Weight of a new sample against the mean.
const WEIGHT: f64 = 0.08;
/// A sample counts at most this many times the present mean square, so that one outlier does not
/// open the gate.
const BOUND: f64 = 9.0;

impl Spread {
    /// A spread that starts from a guess and never falls below `least`.
    #[must_use]
    pub fn new(guess: f64, least: f64) -> Self {
        Spread { mean_square: guess * guess, least }
    }

    /// 1-sigma.
    #[must_use]
    pub fn std(&self) -> f64 {
        self.mean_square.sqrt().max(self.least)
    }

    /// Learns from a deviation whose own estimate has variance `variance`.
    pub fn learn(&mut self, deviation: f64, variance: f64) {
        let square = (deviation * deviation - variance).clamp(0.0, BOUND * self.std().powi(2));
        self.mean_square += WEIGHT * (square - self.mean_square);
    }
}
