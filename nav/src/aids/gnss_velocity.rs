//! GNSS velocity at the antenna.
//!
//! Predicted: v + C_eb (omega_eb x l) in NED axes, with the slow part of the receiver's error as for
//! the position, the delay tau of
//! the epoch and a delay tau_v of its own: receivers give a velocity averaged or filtered over the time before
//! its stamp, and a ship in waves tells by how much, with her antenna's acceleration a:
//!
//! z_n = C_ne (dv - [C_eb (omega x l) x] phi + C_eb [l x] db_g) + diag(sigma_slow) x_slow
//!       - a_n (dtau + dtau_v) + white,
//!
//! db_g the gyro bias; in-run bias, scale factor and the Earth rate's share enter in the same way. Groves, 2nd ed., eqs. (14.103), (14.114).
//! Held by `every_measurement_matrix_agrees_with_perturbed_predictions`.

use insd_base::attitude::skew;
use nalgebra::{Matrix3, Vector3};

use super::View;
use crate::error_state::{
    ATTITUDE, GNSS_DELAY, GNSS_LEVER, GNSS_VELOCITY_DELAY, GNSS_VELOCITY_ERROR, GYRO_BIAS,
    GYRO_DRIFT, GYRO_SCALE, Innovation, Jacobian, VELOCITY,
};

/// A velocity with its sigmas split into white and slow parts, NED, m/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VelocityFix {
    /// Velocity of the antenna over the Earth.
    pub velocity: Vector3<f64>,
    /// 1-sigma of the white part.
    pub white: Vector3<f64>,
    /// 1-sigma of the slowly varying part.
    pub slow: Vector3<f64>,
    /// Acceleration of the antenna as predicted, NED, m/s^2.
    pub acceleration: Vector3<f64>,
}

/// Innovation of a GNSS velocity; `lever` from the IMU to the antenna, body axes, m.
#[must_use]
pub fn innovation(view: &View, fix: &VelocityFix, lever: &Vector3<f64>) -> Innovation {
    let swing_e = view.c_eb * view.rate.cross(lever);
    let predicted = view.c_ne * (view.nominal.velocity + swing_e);
    let delay = view.nominal.gnss_delay + view.nominal.gnss_velocity_delay;
    let expected_error = fix.slow.component_mul(&view.nominal.gnss_velocity_error);
    let mut h = Jacobian::none(3);
    h.set(VELOCITY, &view.c_ne);
    let by_gyro = view.c_nb() * skew(lever);
    let by_attitude = by_gyro * view.earth_rate_by_attitude() - view.c_ne * skew(&swing_e);
    h.set(ATTITUDE, &by_attitude);
    h.set(GYRO_BIAS, &by_gyro);
    h.set(GYRO_DRIFT, &by_gyro);
    let by_scale = by_gyro * Matrix3::from_diagonal(&view.inertial_rate);
    h.set(GYRO_SCALE, &by_scale);
    h.set(GNSS_LEVER, &(view.c_nb() * skew(&view.rate)));
    h.set(GNSS_DELAY, &-fix.acceleration);
    h.set(GNSS_VELOCITY_DELAY, &-fix.acceleration);
    h.set(GNSS_VELOCITY_ERROR, &Matrix3::from_diagonal(&fix.slow));
    let swing_noise = by_gyro * by_gyro.transpose() * view.rate_variance;
    let z = fix.velocity - predicted - expected_error + fix.acceleration * delay;
    let white = Matrix3::from_diagonal(&fix.white.component_mul(&fix.white));
    Innovation::new(&z, h, &(white + swing_noise))
}
