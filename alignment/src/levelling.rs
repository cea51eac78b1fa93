//! Coarse levelling: which way is down, while the ship rolls and moves.
//!
//! Over a window of T seconds the gyros carry the body axes of the window's start along, and the
//! specific force summed in those axes is, whatever the attitude was on the way,
//!
//! sum = C (dv_n - g_n T)   (Earth rate over some seconds neglected),
//!
//! with dv_n the change of velocity over the window. For an assumed heading, roll and pitch follow in
//! closed form. Without a velocity the change is taken as zero, its neglect being part of the
//! claimed sigma. After Wu and Pan, Velocity/Position Integration Formula Part I, IEEE Trans. AES
//! 49 (2013), eq. (10): integration frees the direction of gravity from the sea.

use insd_base::attitude::Attitude;
use insd_base::{Geodetic, Time, earth};
use insd_nav::Increment;
use nalgebra::{UnitQuaternion, Vector3};

/// Sums over the levelling window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Levelling {
    start: Time,
    now: Time,
    turn: UnitQuaternion<f64>,
    sum: Vector3<f64>,
    rate: Option<Vector3<f64>>,
}

/// Mean specific force of the window in the body axes of its start, m/s^2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Level {
    /// Start of the window.
    pub time: Time,
    /// Mean specific force.
    pub force: Vector3<f64>,
    /// Angular rate at the start, rad/s.
    pub rate: Vector3<f64>,
}

impl Levelling {
    /// A window that starts with an increment.
    #[must_use]
    pub fn new(start: Time) -> Self {
        Levelling {
            start,
            now: start,
            turn: UnitQuaternion::identity(),
            sum: Vector3::zeros(),
            rate: None,
        }
    }

    /// Adds an increment.
    pub fn advance(&mut self, increment: &Increment) {
        let half = self.turn * UnitQuaternion::new(increment.rotation * 0.5);
        self.sum += half * increment.velocity;
        self.turn *= UnitQuaternion::new(increment.rotation);
        self.rate.get_or_insert(increment.end_rate);
        self.now = increment.to;
    }

    /// Length of the window so far, s.
    #[must_use]
    pub fn duration(&self) -> f64 {
        (self.now - self.start).as_seconds()
    }

    /// End of the window so far.
    #[must_use]
    pub fn now(&self) -> Time {
        self.now
    }

    /// The mean specific force in the axes of the window's start; `None` before there is any.
    #[must_use]
    pub fn level_at_start(&self) -> Option<Level> {
        let duration = self.duration();
        let rate = self.rate?;
        (duration > 0.0).then(|| Level { time: self.start, force: self.sum / duration, rate })
    }
}

impl Level {
    /// Roll and pitch for an assumed heading, rad, at a place, with the mean acceleration over the
    /// window in NED axes, m/s^2.
    ///
    /// With a = R_z(heading)^T (acceleration - gravity) the force must satisfy
    /// R_y(pitch) R_x(roll) f = a: the starboard component gives the roll, the others the pitch.
    #[must_use]
    pub fn attitude(
        &self,
        heading: f64,
        place: &Geodetic,
        acceleration: &Vector3<f64>,
    ) -> Attitude {
        let gravity = earth::normal_gravity(place.latitude, place.height);
        let (sin_h, cos_h) = heading.sin_cos();
        let north = acceleration.x;
        let east = acceleration.y;
        let wanted = Vector3::new(
            cos_h * north + sin_h * east,
            cos_h * east - sin_h * north,
            acceleration.z - gravity,
        );
        let wanted = wanted * (self.force.norm() / wanted.norm().max(1e-9));
        let f = &self.force;
        // f_y cos(roll) - f_z sin(roll) = a_y, with f_z negative for a ship that is not capsized
        let across = f.y.hypot(f.z).max(1e-9);
        let roll = (wanted.y / across).clamp(-1.0, 1.0).asin() - f.y.atan2(-f.z);
        let down = f.y * roll.sin() + f.z * roll.cos();
        // R_y(pitch): a_x = f_x cos + down sin, a_z = -f_x sin + down cos
        let pitch = f.x.atan2(-down) - wanted.x.atan2(-wanted.z);
        Attitude { roll, pitch, heading }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn roll_and_pitch_are_found_for_the_true_heading_under_acceleration() {
        let place = Geodetic::from_degrees(35.0, 139.0, 0.0);
        let truth = Attitude { roll: 0.3, pitch: -0.2, heading: 2.5 };
        let acceleration = Vector3::new(0.4, -0.3, 0.1);
        let gravity = Vector3::new(0.0, 0.0, earth::normal_gravity(place.latitude, place.height));
        let force = truth.c_nb().transpose() * (acceleration - gravity);
        let level = Level { time: Time::START, force, rate: Vector3::zeros() };
        let found = level.attitude(truth.heading, &place, &acceleration);
        assert_relative_eq!(found.roll, truth.roll, epsilon = 1e-9);
        assert_relative_eq!(found.pitch, truth.pitch, epsilon = 1e-9);
    }
}
