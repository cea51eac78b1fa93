//! GNSS position at the antenna.
//!
//! Predicted: p = r + C_eb l, measured minus predicted in NED axes. The error of the fix has a
//! white part and a slowly varying part that the filter estimates in units of its sigma:
//!
//! z_n = C_ne (dr - [C_eb l x] phi) + diag(sigma_slow) x_slow - v_n dtau + white,
//!
//! tau the delay of the epoch behind the IMU's time base and v the antenna's velocity.
//!
//! Groves, 2nd ed., eqs. (14.103), (14.113); correlated error: Brown and Hwang, Introduction to
//! Random Signals and Applied Kalman Filtering, 4th ed., section 5.2 (state augmentation).
//! Held by `every_measurement_matrix_agrees_with_perturbed_predictions`.

use insd_base::attitude::skew;
use insd_base::{Geodetic, earth};
use nalgebra::{Matrix3, Vector3};

use super::View;
use crate::error_state::{
    ATTITUDE, GNSS_DELAY, GNSS_LEVER, GNSS_POSITION_ERROR, Innovation, Jacobian, POSITION,
};

/// A fix with its sigmas split into white and slow parts, NED, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PositionFix {
    /// Position of the antenna.
    pub position: Geodetic,
    /// 1-sigma of the white part.
    pub white: Vector3<f64>,
    /// 1-sigma of the slowly varying part.
    pub slow: Vector3<f64>,
    /// Velocity of the antenna as predicted, NED, m/s.
    pub velocity: Vector3<f64>,
}

/// Innovation of a GNSS position; `lever` from the IMU to the antenna, body axes, m.
#[must_use]
pub fn innovation(view: &View, fix: &PositionFix, lever: &Vector3<f64>) -> Innovation {
    let arm_e = view.c_eb * lever;
    let difference = earth::ecef(&fix.position).0 - view.nominal.position - arm_e;
    let expected_error = fix.slow.component_mul(&view.nominal.gnss_position_error);
    let mut h = Jacobian::none(3);
    h.set(POSITION, &view.c_ne);
    h.set(ATTITUDE, &(-view.c_ne * skew(&arm_e)));
    h.set(GNSS_LEVER, &view.c_nb());
    h.set(GNSS_DELAY, &-fix.velocity);
    h.set(GNSS_POSITION_ERROR, &Matrix3::from_diagonal(&fix.slow));
    let z = view.c_ne * difference - expected_error + fix.velocity * view.nominal.gnss_delay;
    Innovation::new(&z, h, &Matrix3::from_diagonal(&fix.white.component_mul(&fix.white)))
}
