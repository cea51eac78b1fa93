//! Whether accelerometers sense gravity.
//!
//! A ship stays on the sea: the mean of her acceleration over seconds is nearly zero, and the mean of the
//! magnitude of specific force is gravity, however she is mounted, rolls or turns. A magnitude that stays
//! away from it is none: a block that nobody fills, g where m/s^2 should be, a broken accelerometer.

use insd_wire::imu::ImuMotion;

/// Gravity on the sea, m/s^2; it differs by 0.3 % from place to place.
const GRAVITY: f64 = 9.81;
/// Time over which the mean is taken, s.
const WINDOW: f64 = 10.0;
/// How far the mean may be from gravity, ratio: bias and scale of the worst accelerometers, and what a
/// heavy sea adds to the magnitude.
const APART: f64 = 0.12;
/// Increments are divided by the interval that the installer stated, which may be wrong by some factor and
/// is found out elsewhere: of them only what no wrong interval explains is refused, ratio.
const FACTOR: f64 = 4.0;
/// By how much more while the mean is young, and how soon that passes, s: a wave may have been caught.
const YOUNG: f64 = 0.4;
const GROWS: f64 = 4.0;

/// The mean magnitude of specific force.
#[derive(Clone, Copy, Debug, Default)]
pub struct Gravity {
    mean: f64,
    /// Time over which it was taken, s.
    seconds: f64,
}

impl Gravity {
    /// Takes the motion over an interval, s, and says whether the mean may be gravity. What is no number
    /// changes nothing and is not.
    pub fn bears(&mut self, motion: &ImuMotion, interval: f64) -> bool {
        let (vector, unit, is_rate) = match motion {
            ImuMotion::Rates { accel, .. } => (accel, 1.0, true),
            ImuMotion::Increments { delta_velocity, .. } => (delta_velocity, interval, false),
        };
        let force = vector.iter().map(|own| own * own).sum::<f64>().sqrt() / unit;
        if !force.is_finite() {
            return false;
        }
        self.seconds += interval;
        self.mean += (force - self.mean) * interval / self.seconds.min(WINDOW);
        let (apart, ratio) = (APART + YOUNG * (-self.seconds / GROWS).exp(), self.mean / GRAVITY);
        if is_rate { (ratio - 1.0).abs() < apart } else { (1.0 / FACTOR..FACTOR).contains(&ratio) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether each sample of 60 s at 100 Hz is taken.
    fn taken(force: impl Fn(f64) -> [f64; 3]) -> Vec<bool> {
        let mut gravity = Gravity::default();
        let motion =
            |k: u32| ImuMotion::Rates { gyro: [0.0; 3], accel: force(f64::from(k) * 0.01) };
        (0..6000).map(|k| gravity.bears(&motion(k), 0.01)).collect()
    }

    #[test]
    fn a_ship_in_a_heavy_sea_is_never_doubted() {
        for phase in [0.0, 1.5, 3.0, 4.5] {
            let heave = |t: f64| 3.0 * (0.9 * t + phase).sin();
            let all = taken(|t| [1.5 * (0.5 * t).sin(), 2.0 * (0.7 * t).cos(), -9.8 - heave(t)]);
            assert!(all.iter().all(|taken| *taken), "{phase}");
        }
        // on her side, with the worst accelerometers there are
        assert!(taken(|_| [0.1, 10.1, 0.3]).iter().all(|taken| *taken));
    }

    #[test]
    fn what_is_no_gravity_is_refused_within_seconds_and_zeros_at_once() {
        assert!(taken(|_| [0.0; 3]).iter().all(|taken| !taken));
        assert!(taken(|_| [0.0, 0.0, -1.0]).iter().all(|taken| !taken), "in g");
        let coarse = taken(|_| [0.0, 0.0, 8.0]);
        assert!(coarse[900..].iter().all(|taken| !taken), "8.00 m/s^2");
        let mut gravity = Gravity::default();
        let untold = ImuMotion::Rates { gyro: [0.0; 3], accel: [f64::NAN; 3] };
        assert!(!gravity.bears(&untold, 0.01));
    }

    #[test]
    fn increments_are_divided_by_an_interval_that_may_be_wrong() {
        let of = |down: f64| ImuMotion::Increments {
            delta_theta: [0.0; 3],
            delta_velocity: [0.0, 0.0, -down * 0.005],
        };
        for (down, good) in [(9.81, true), (2.0 * 9.81, true), (0.0, false), (1.0, false)] {
            let mut gravity = Gravity::default();
            assert!((0..2000).all(|_| gravity.bears(&of(down), 0.005) == good), "{down}");
        }
    }
}
