//! The estimate itself: position, velocity, attitude and every sensor error, around which the error
//! state is linear.

use insd_base::earth;
use insd_base::{Ecef, Geodetic};
use nalgebra::{Matrix3, Rotation2, UnitQuaternion, Vector1, Vector2, Vector3, Vector4};
use serde::{Deserialize, Serialize};

use crate::error_state::{
    ACCEL_BIAS, ACCEL_DRIFT, ACCEL_SCALE, ATTITUDE, BERTH_OFFSET, CURRENT, ErrorState, GNSS_DELAY,
    GNSS_LEVER, GNSS_POSITION_ERROR, GNSS_VELOCITY_DELAY, GNSS_VELOCITY_ERROR, GYRO_BIAS,
    GYRO_DRIFT, GYRO_SCALE, HEADING_ERROR, LOG_MISALIGNMENT, LOG_SCALE, POSITION, SEA_LEVEL, SWAY,
    SWAY_VELOCITY, VELOCITY,
};

/// Estimated values of everything in the error state; units and axes as stated there.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Nominal {
    /// Position of the IMU, ECEF, m.
    pub position: Vector3<f64>,
    /// Velocity over the Earth, ECEF axes, m/s.
    pub velocity: Vector3<f64>,
    /// Rotation from body to ECEF axes.
    pub attitude: UnitQuaternion<f64>,
    /// Gyro turn-on bias, rad/s.
    pub gyro_bias: Vector3<f64>,
    /// Gyro in-run bias, rad/s.
    pub gyro_drift: Vector3<f64>,
    /// Gyro scale factor, ratio.
    pub gyro_scale: Vector3<f64>,
    /// Accelerometer turn-on bias, m/s^2.
    pub accel_bias: Vector3<f64>,
    /// Accelerometer in-run bias, m/s^2.
    pub accel_drift: Vector3<f64>,
    /// Accelerometer scale factor, ratio.
    pub accel_scale: Vector3<f64>,
    /// Slow GNSS position error, NED, sigmas.
    pub gnss_position_error: Vector3<f64>,
    /// Slow GNSS velocity error, NED, sigmas.
    pub gnss_velocity_error: Vector3<f64>,
    /// Correction of the stated lever arm of the GNSS antenna, body axes, m.
    pub gnss_lever: Vector3<f64>,
    /// Delay of GNSS epochs behind the IMU's time base, s.
    pub gnss_delay: f64,
    /// Delay of the GNSS velocity behind the position, s.
    pub gnss_velocity_delay: f64,
    /// Water current, north and east, m/s.
    pub current: Vector2<f64>,
    /// Mean place from the named berth, north and east, m.
    pub berth_offset: Vector2<f64>,
    /// Slow swaying about that place, north and east of each oscillator, m.
    pub sway: Vector4<f64>,
    /// Velocity of that swaying, m/s.
    pub sway_velocity: Vector4<f64>,
    /// Log scale factor, ratio.
    pub log_scale: f64,
    /// Log misalignment about starboard and down, rad.
    pub log_misalignment: Vector2<f64>,
    /// Mean height, m.
    pub sea_level: f64,
    /// Slow error of a reference's heading, sigmas.
    pub heading_error: f64,
}

impl Nominal {
    /// An estimate of place, motion and attitude with all sensor errors taken as zero.
    #[must_use]
    pub fn at(position: &Geodetic, v_n: &Vector3<f64>, c_nb: &Matrix3<f64>) -> Self {
        let c_en = earth::c_ne(position).transpose();
        Nominal {
            position: earth::ecef(position).0,
            velocity: c_en * v_n,
            attitude: UnitQuaternion::from_matrix(&(c_en * c_nb)),
            gyro_bias: Vector3::zeros(),
            gyro_drift: Vector3::zeros(),
            gyro_scale: Vector3::zeros(),
            accel_bias: Vector3::zeros(),
            accel_drift: Vector3::zeros(),
            accel_scale: Vector3::zeros(),
            gnss_position_error: Vector3::zeros(),
            gnss_velocity_error: Vector3::zeros(),
            gnss_lever: Vector3::zeros(),
            gnss_delay: 0.0,
            gnss_velocity_delay: 0.0,
            current: Vector2::zeros(),
            berth_offset: Vector2::zeros(),
            sway: Vector4::zeros(),
            sway_velocity: Vector4::zeros(),
            log_scale: 0.0,
            log_misalignment: Vector2::zeros(),
            sea_level: position.height,
            heading_error: 0.0,
        }
    }

    /// Whether it can be a ship's: numbers only, on the Earth, a rotation that is one.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        let far = (self.position.norm() / earth::SEMI_MAJOR - 1.0).abs();
        let rotation = (self.attitude.as_ref().norm() - 1.0).abs();
        let none = Nominal { attitude: UnitQuaternion::identity(), ..*self };
        let zero = Nominal::at(
            &Geodetic::from_degrees(0.0, 0.0, 0.0),
            &Vector3::zeros(),
            &Matrix3::identity(),
        );
        far < 0.01 && rotation < 1e-6 && zero.error_to(&none).iter().all(|x| x.is_finite())
    }

    /// Slow swaying, both oscillators together, north and east, m.
    #[must_use]
    pub fn swaying(&self) -> Vector2<f64> {
        self.sway.fixed_rows::<2>(0) + self.sway.fixed_rows::<2>(2)
    }

    /// Geodetic position of the IMU.
    #[must_use]
    pub fn geodetic(&self) -> Geodetic {
        earth::geodetic(&Ecef(self.position))
    }

    /// Rotation from body to ECEF axes.
    #[must_use]
    pub fn c_eb(&self) -> Matrix3<f64> {
        self.attitude.to_rotation_matrix().into_inner()
    }

    /// Moves the estimate by an error vector: estimated + error = true. The swaying of a moored ship
    /// is held in the axes of the computed heading and turns with it ([`crate::aids::berth`]).
    pub fn inject(&mut self, error: &ErrorState) {
        self.position += POSITION.of(error);
        self.velocity += VELOCITY.of(error);
        self.attitude = UnitQuaternion::new(ATTITUDE.of(error)) * self.attitude;
        self.gyro_bias += GYRO_BIAS.of(error);
        self.gyro_drift += GYRO_DRIFT.of(error);
        self.gyro_scale += GYRO_SCALE.of(error);
        self.accel_bias += ACCEL_BIAS.of(error);
        self.accel_drift += ACCEL_DRIFT.of(error);
        self.accel_scale += ACCEL_SCALE.of(error);
        self.gnss_position_error += GNSS_POSITION_ERROR.of(error);
        self.gnss_velocity_error += GNSS_VELOCITY_ERROR.of(error);
        self.gnss_lever += GNSS_LEVER.of(error);
        self.gnss_delay += GNSS_DELAY.of(error).x;
        self.gnss_velocity_delay += GNSS_VELOCITY_DELAY.of(error).x;
        self.current += CURRENT.of(error);
        let turn = turn_about_down(&ATTITUDE.of(error), &self.position);
        self.berth_offset = turn * self.berth_offset + BERTH_OFFSET.of(error);
        self.sway = turned(&turn, &self.sway) + SWAY.of(error);
        self.sway_velocity = turned(&turn, &self.sway_velocity) + SWAY_VELOCITY.of(error);
        self.log_scale += LOG_SCALE.of(error).x;
        self.log_misalignment += LOG_MISALIGNMENT.of(error);
        self.sea_level += SEA_LEVEL.of(error).x;
        self.heading_error += HEADING_ERROR.of(error).x;
    }

    /// The error vector that moves this estimate onto another: the inverse of [`Self::inject`].
    #[must_use]
    pub fn error_to(&self, other: &Nominal) -> ErrorState {
        let mut error = ErrorState::zeros();
        POSITION.set(&mut error, &(other.position - self.position));
        VELOCITY.set(&mut error, &(other.velocity - self.velocity));
        let turn = other.attitude * self.attitude.inverse();
        ATTITUDE.set(&mut error, &turn.scaled_axis());
        GYRO_BIAS.set(&mut error, &(other.gyro_bias - self.gyro_bias));
        GYRO_DRIFT.set(&mut error, &(other.gyro_drift - self.gyro_drift));
        GYRO_SCALE.set(&mut error, &(other.gyro_scale - self.gyro_scale));
        ACCEL_BIAS.set(&mut error, &(other.accel_bias - self.accel_bias));
        ACCEL_DRIFT.set(&mut error, &(other.accel_drift - self.accel_drift));
        ACCEL_SCALE.set(&mut error, &(other.accel_scale - self.accel_scale));
        let position_error = other.gnss_position_error - self.gnss_position_error;
        GNSS_POSITION_ERROR.set(&mut error, &position_error);
        let velocity_error = other.gnss_velocity_error - self.gnss_velocity_error;
        GNSS_VELOCITY_ERROR.set(&mut error, &velocity_error);
        GNSS_LEVER.set(&mut error, &(other.gnss_lever - self.gnss_lever));
        GNSS_DELAY.set(&mut error, &Vector1::new(other.gnss_delay - self.gnss_delay));
        let delay = other.gnss_velocity_delay - self.gnss_velocity_delay;
        GNSS_VELOCITY_DELAY.set(&mut error, &Vector1::new(delay));
        CURRENT.set(&mut error, &(other.current - self.current));
        let about_down = turn_about_down(&turn.scaled_axis(), &other.position);
        let offset = other.berth_offset - about_down * self.berth_offset;
        BERTH_OFFSET.set(&mut error, &offset);
        SWAY.set(&mut error, &(other.sway - turned(&about_down, &self.sway)));
        let velocity = other.sway_velocity - turned(&about_down, &self.sway_velocity);
        SWAY_VELOCITY.set(&mut error, &velocity);
        LOG_SCALE.set(&mut error, &Vector1::new(other.log_scale - self.log_scale));
        LOG_MISALIGNMENT.set(&mut error, &(other.log_misalignment - self.log_misalignment));
        SEA_LEVEL.set(&mut error, &Vector1::new(other.sea_level - self.sea_level));
        let heading_error = other.heading_error - self.heading_error;
        HEADING_ERROR.set(&mut error, &Vector1::new(heading_error));
        error
    }
}

/// The part of a small rotation, ECEF axes, that turns the horizontal axes at a place.
///
/// Down is minus the normal of the ellipsoid, which is along (x/a^2, y/a^2, z/b^2).
fn turn_about_down(rotation: &Vector3<f64>, place: &Vector3<f64>) -> Rotation2<f64> {
    let flat = 1.0 - earth::ECCENTRICITY_SQ;
    let up = Vector3::new(place.x, place.y, place.z / flat).normalize();
    Rotation2::new(-rotation.dot(&up))
}

/// North and east of both oscillators, turned.
fn turned(turn: &Rotation2<f64>, sway: &Vector4<f64>) -> Vector4<f64> {
    let component = |i: usize| (turn.matrix() * sway.fixed_rows::<2>(i & 2))[i & 1];
    Vector4::from_fn(|i, _| component(i))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error_state::STATES;
    use approx::assert_relative_eq;

    #[test]
    fn injecting_the_error_to_another_estimate_reaches_it() {
        let here = Geodetic::from_degrees(35.0, 139.0, 10.0);
        let start = Nominal::at(&here, &Vector3::new(1.0, 2.0, 0.1), &Matrix3::identity());
        let error = ErrorState::from_fn(|i, _| 1e-3 * (i as f64 + 1.0) / STATES as f64);
        let mut moved = start;
        moved.inject(&error);
        assert_relative_eq!(start.error_to(&moved), error, epsilon = 1e-9);
    }
}
