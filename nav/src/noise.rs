//! The noise that an IMU really has: a data sheet is written on a granite table, a ship vibrates.
//!
//! Fourth differences of successive samples leave next to nothing of a hull's motion and seventy
//! times the variance of white noise (binomial coefficients 1, 4, 6, 4, 1). What they show beyond the
//! stated random walk is added to it.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// Running variance of the white noise of three axes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct NoiseMonitor {
    last: [Vector3<f64>; 4],
    samples: u32,
    density: Vector3<f64>,
}

/// Squared sum of the binomial coefficients of a fourth difference.
const GAIN: f64 = 70.0;
/// Time over which the variance is averaged, s.
const MEMORY: f64 = 5.0;
/// Density over the stated one up to which the stated one holds: the estimate's own scatter.
const TOLERANCE: f64 = 1.5;

impl Default for NoiseMonitor {
    fn default() -> Self {
        NoiseMonitor { last: [Vector3::zeros(); 4], samples: 0, density: Vector3::zeros() }
    }
}

impl NoiseMonitor {
    /// Learns from the mean of a quantity over an interval of `duration` s.
    pub fn learn(&mut self, mean: &Vector3<f64>, duration: f64) {
        let [a, b, c, d] = self.last;
        let difference = mean - d * 4.0 + c * 6.0 - b * 4.0 + a;
        self.last = [b, c, d, *mean];
        self.samples = self.samples.saturating_add(1);
        if self.samples <= 4 {
            return;
        }
        let density = difference.component_mul(&difference) * (duration / GAIN);
        let steady = duration / MEMORY;
        let weight = steady.max(1.0 / f64::from(self.samples - 4)).min(1.0);
        self.density += (density - self.density) * weight;
    }

    /// Forgets the samples before a gap.
    pub fn interrupt(&mut self) {
        self.samples = 0;
    }

    /// Density of white noise on each axis beyond what a random walk of `stated` (per square root
    /// of a second) explains: square of the unit, times seconds.
    #[must_use]
    pub fn excess(&self, stated: f64) -> Vector3<f64> {
        self.density.map(|density| (density - TOLERANCE * stated * stated).max(0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_motion_of_a_hull_is_not_taken_for_noise_and_an_engine_is() {
        let mut calm = NoiseMonitor::default();
        let mut shaken = NoiseMonitor::default();
        for i in 0..2000_i32 {
            let roll_rate = 0.1 * (0.008 * f64::from(i)).sin();
            let engine = if i % 2 == 0 { 1e-3 } else { -1e-3 };
            calm.learn(&Vector3::repeat(roll_rate), 0.01);
            shaken.learn(&Vector3::repeat(roll_rate + engine), 0.01);
        }
        assert_eq!(calm.excess(1e-6), Vector3::zeros());
        assert!(shaken.excess(1e-6).min() > 1e-9);
    }
}
