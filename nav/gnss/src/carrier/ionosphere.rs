//! How the ionosphere along one ray changes, from phases of two bands.

use nalgebra::{Matrix2, Vector2};

/// 1-sigma of the rate of change on L1 before anything is known of it, m/s.
const RATE: f64 = 0.002;
/// Random walk of that rate, m/s per root of a second: a quiet ionosphere's changes within ten minutes.
const WALK: f64 = 2e-5;

/// The smallest leap of the delay by a slip, m: one cycle on both L1 and L2 makes 85 mm.
const SLIP: f64 = 0.03;

/// The delay on L1 since tracking began, and its rate, m and m/s: what two bands say, smoothed, so that their noise does not come in threefold
/// as in the ionosphere-free combination, and nothing drifts as with one band and a model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct IonosphereTrack {
    state: Vector2<f64>,
    covariance: Matrix2<f64>,
}

impl IonosphereTrack {
    /// Tracking begins with a delay of unknown origin, m, that has a variance, and a rate by the model, m/s.
    pub(super) fn begin(delay: f64, variance: f64, rate: f64) -> Self {
        Self {
            state: Vector2::new(delay, rate),
            covariance: Matrix2::from_diagonal(&Vector2::new(variance, RATE * RATE)),
        }
    }

    /// Rate of the delay, m/s.
    pub(super) fn rate(&self) -> f64 {
        self.state.y
    }

    /// Goes on by some seconds with what two bands have, m, and the variance of it; `repeated`: by how much it counts more as errors are those of the epochs
    /// before. Returns the change of the delay since, and its 1-sigma. `None` where the delay leaps
    /// as only a slip on one of the bands makes it.
    pub(super) fn advance(
        &mut self,
        elapsed: f64,
        (delay, variance): (f64, f64),
        repeated: f64,
    ) -> Option<(f64, f64)> {
        let before = self.state.x;
        let f = Matrix2::new(1.0, elapsed, 0.0, 1.0);
        let q = WALK * WALK * elapsed;
        let noise = Matrix2::new(elapsed * elapsed / 3.0, elapsed / 2.0, elapsed / 2.0, 1.0) * q;
        self.state = f * self.state;
        self.covariance = f * self.covariance * f.transpose() + noise;
        let expected = self.covariance[(0, 0)] + variance;
        let innovation = delay - self.state.x;
        if innovation.abs() > SLIP.max(5.0 * expected.sqrt()) {
            return None;
        }
        let gain = self.covariance.column(0) / (expected + (repeated - 1.0) * variance);
        self.state += gain * innovation;
        self.covariance -= gain * self.covariance.row(0);
        Some((self.state.x - before, self.covariance[(1, 1)].max(0.0).sqrt() * elapsed))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_steady_drift_is_followed_without_lag_and_noise_is_smoothed() {
        let noise = |k: u32| if k.is_multiple_of(2) { 0.005 } else { -0.005 };
        let mut track = IonosphereTrack::begin(3.0 + noise(0), 5e-5, 0.0);
        let mut sum = 0.0;
        let mut scatter: f64 = 0.0;
        for k in 1..=300 {
            let (change, _) =
                track.advance(1.0, (3.0 + 6e-4 * f64::from(k) + noise(k), 5e-5), 1.0).unwrap();
            sum += change;
            if k > 100 {
                scatter = scatter.max((change - 6e-4).abs());
            }
        }
        assert!((sum - 0.18).abs() < 0.006, "{sum}");
        assert!(scatter < 0.001, "{scatter}");
        assert_eq!(track.advance(1.0, (3.18 + 0.085, 5e-5), 1.0), None);
    }
}
