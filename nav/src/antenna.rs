//! Acceleration of the GNSS antenna from its predicted velocity of the last moments.
//!
//! A receiver whose velocity is late by tau as a rule tells a mean over the last T = 2 tau. So the acceleration that goes with a delay is
//! the one with which a mean over T is late by T / 2,
//!
//! a = (v - mean of v over T) / (T / 2),
//!
//! and not (v(t) - v(t - T)) / T, which takes what is told to be of two velocities and nothing between them. The two differ with the
//! change of the acceleration, as does the swing of an antenna when a car brakes: a lever arm is found a third of a metre too long by it.
//! Held by `of_what_is_told_of_a_mean_nothing_is_left`.

use insd_base::Time;
use nalgebra::Vector3;

/// Predicted velocities that are kept.
const KEPT: usize = 24;
/// Velocities closer together than this are not kept both, s.
const LEAST: f64 = 0.045;
/// The mean is over so long at least, s: over less, the noise of small gyros that a long lever arm makes large is
/// mistaken for motion, and a receiver that is late for one that is not; and at most, s.
const SHORTEST: f64 = 0.4;
const LONGEST: f64 = 1.0;

/// The last predicted velocities of the antenna, ECEF axes, the newest first.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct AntennaMotion {
    velocities: [Option<(Time, Vector3<f64>)>; KEPT],
}

impl AntennaMotion {
    /// Notes a predicted velocity, m/s.
    pub fn note(&mut self, time: Time, velocity: &Vector3<f64>) {
        let fresh = self.velocities[0].is_none_or(|(last, _)| (time - last).as_seconds() >= LEAST);
        if fresh {
            self.velocities.rotate_right(1);
            self.velocities[0] = Some((time, *velocity));
        }
    }

    /// Acceleration up to now, m/s^2, of a receiver with a velocity that is `late` by so much, s; zero before anything is known.
    #[must_use]
    pub fn acceleration(&self, now: Time, velocity: &Vector3<f64>, late: f64) -> Vector3<f64> {
        let whole = (2.0 * late).clamp(SHORTEST, LONGEST);
        let (mut span, mut last, mut passed) = (0.0, *velocity, Vector3::zeros());
        for (time, before) in self.velocities.iter().flatten() {
            let step = (now - *time).as_seconds() - span;
            if step <= 0.0 {
                continue;
            }
            let share = ((whole - span) / step).min(1.0);
            let then = last.lerp(before, share);
            passed += (then + last) * (0.5 * share * step);
            (span, last) = (span + share * step, then);
            if share < 1.0 {
                break;
            }
        }
        if span < LEAST { Vector3::zeros() } else { (velocity - passed / span) * (2.0 / span) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::Span;

    /// The antenna's motion up to a time, s, noted ten times a second, of a velocity over time, s.
    fn seen(until: u32, late: f64, velocity: impl Fn(f64) -> f64) -> Vector3<f64> {
        let mut motion = AntennaMotion::default();
        let at = |step: u32| 0.1 * f64::from(step);
        let of = |step: u32| Vector3::new(velocity(at(step)), 0.0, 0.0);
        for step in 0..until {
            motion.note(Time::START + Span::from_seconds(at(step)), &of(step));
        }
        motion.acceleration(Time::START + Span::from_seconds(at(until)), &of(until), late)
    }

    #[test]
    fn a_steady_acceleration_is_what_it_is_and_of_one_velocity_none_is_known() {
        let steady = |until, late| seen(until, late, |t| 3.0 + 2.0 * t).x;
        for late in [-0.1, 0.0, 0.2, 3.0] {
            assert!((steady(30, late) - 2.0).abs() < 1e-9, "{late}");
        }
        assert!((steady(2, 0.2) - 2.0).abs() < 1e-9, "of what there is");
        assert_eq!(steady(0, 0.2), 0.0);
    }

    #[test]
    fn of_what_is_told_of_a_mean_nothing_is_left() {
        // she brakes harder and harder: v = -t^3, of which the mean over the last 0.6 s is told
        let velocity = |t: f64| -t.powi(3);
        let mean = -(2.0_f64.powi(4) - 1.4_f64.powi(4)) / 4.0 / 0.6;
        let left = velocity(2.0) - 0.3 * seen(20, 0.3, velocity).x - mean;
        assert!(left.abs() < 0.02, "{left}");
        let of_two = 0.5 * (velocity(2.0) + velocity(1.4));
        assert!((of_two - mean).abs() > 0.25);
    }
}
