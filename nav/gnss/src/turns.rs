//! How a hull turns and where down is, by its IMU alone.

use insd_base::{ImuSample, Time};
use nalgebra::{Matrix3, UnitQuaternion, Vector3};

use crate::compass::AttitudePrior;

/// Waves and turns are averaged over so long, s.
const LEVEL_TIME: f64 = 30.0;
/// How level a hull is known to be after that, 1-sigma, rad: an acceleration of 0.5 m/s^2.
const LEVEL_STD: f64 = 0.05;

/// How the antennas of a ship turn with her. Gyros tell it with a bias and without a heading: 1000 deg/h turn the axis that points down by 0.15 mm of a phase in a second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turns {
    sum: f64,
    /// From axes of the hull now to those at the start.
    axes: UnitQuaternion<f64>,
    /// Specific force, in the axes at the start, averaged, m/s^2.
    force: Vector3<f64>,
    /// When it was heard first and last.
    heard: Option<(Time, Time)>,
}

impl Default for Turns {
    fn default() -> Self {
        Self { sum: 0.0, axes: UnitQuaternion::identity(), force: Vector3::zeros(), heard: None }
    }
}

impl Turns {
    /// Takes a sample of the IMU.
    pub fn hear(&mut self, sample: &ImuSample) {
        let (turned, pushed) = (sample.delta_theta.0, sample.delta_velocity.0);
        if !turned.iter().chain(pushed.iter()).all(|x| x.is_finite()) {
            return;
        }
        self.sum += turned.z;
        self.axes *= UnitQuaternion::from_scaled_axis(turned);
        self.axes.renormalize_fast();
        let Some((first, last)) = self.heard.replace((sample.time, sample.time)) else { return };
        self.heard = Some((first, sample.time));
        let step = (sample.time - last).as_seconds();
        if step > 0.0 && step < LEVEL_TIME {
            let lasted = (sample.time - first).as_seconds().min(LEVEL_TIME);
            let force = self.axes * (pushed / step);
            self.force += (force - self.force) * (step / lasted.max(step));
        }
    }

    /// What she has turned by so far, rad, clockwise as seen from above.
    #[must_use]
    pub fn so_far(&self) -> f64 {
        self.sum
    }

    /// From the hull's axes now to those at the start.
    #[must_use]
    pub fn axes(&self) -> Matrix3<f64> {
        self.axes.to_rotation_matrix().into_inner()
    }

    /// How the hull stands as far as gravity tells it, its heading unknown; `None` before waves are averaged out.
    #[must_use]
    pub fn level(&self) -> Option<AttitudePrior> {
        let (first, last) = self.heard?;
        if (last - first).as_seconds() < LEVEL_TIME {
            return None;
        }
        let down = -(self.axes.inverse() * self.force).try_normalize(1.0)?;
        let ahead = (Vector3::x() - down * down.x).try_normalize(0.1)?;
        let c_nb = Matrix3::from_columns(&[ahead, down.cross(&ahead), down]).transpose();
        let std = Vector3::new(LEVEL_STD, LEVEL_STD, f64::INFINITY);
        Some(AttitudePrior { c_nb, std })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::{Attitude, Body};

    #[test]
    fn a_hull_that_rolls_and_turns_is_known_to_be_level_as_it_is() {
        let hull = |t: f64| Attitude {
            roll: 0.1 * (0.7 * t).sin() + 0.03,
            pitch: -0.02,
            heading: 0.02 * t,
        };
        let mut turns = Turns::default();
        let step = 0.01;
        for sample in 1..=6000 {
            let t = f64::from(sample) * step;
            let (before, now) = (hull(t - step).c_nb(), hull(t).c_nb());
            let turned = UnitQuaternion::from_matrix(&(before.transpose() * now)).scaled_axis();
            let force = now.transpose() * Vector3::new(0.0, 0.0, -9.81);
            turns.hear(&ImuSample {
                time: Time::from_seconds(t),
                delta_theta: Body(turned),
                delta_velocity: Body(force * step),
            });
        }
        let found = Attitude::from_c_nb(&turns.level().unwrap().c_nb);
        let truth = hull(60.0);
        assert!((found.roll - truth.roll).abs() < 0.002, "{found:?} {truth:?}");
        assert!((found.pitch - truth.pitch).abs() < 0.002, "{found:?} {truth:?}");
        assert!((turns.so_far() - 1.2).abs() < 0.02, "{}", turns.so_far());
    }
}
