//! Velocity of a Doppler or electromagnetic log, bottom or water track.
//!
//! True velocity at the log in body axes: u = C_be (v - v_current) + omega_eb x l. The log gives
//!
//! (1 + k) (I - [m x]) u + white,   m = (0, m_y, m_z),
//!
//! with scale factor k and misalignment m (a turn about the forward axis cannot be told from data
//! of a ship that mostly moves forward). Linear in the errors:
//!
//! z = (1 + k)(I - [m x]) (C_be (dv + [v x] phi - dc) - ...) + u dk + [u x] dm.
//!
//! Groves, 2nd ed., section 16.3 (Doppler log in integrated navigation), extended by k, m and the
//! current. Held by `every_measurement_matrix_agrees_with_perturbed_predictions`.

use insd_base::attitude::skew;
use insd_base::{LogReference, LogVelocity};
use nalgebra::{Matrix2, Matrix3, Matrix3x2, Vector1, Vector2, Vector3};

use super::View;
use crate::error_state::{
    ATTITUDE, CURRENT, GYRO_BIAS, GYRO_DRIFT, GYRO_SCALE, Innovation, Jacobian, LOG_BY_SPEED,
    LOG_BY_TURN, LOG_MISALIGNMENT, LOG_SCALE, VELOCITY,
};

/// The predicted log velocity and its derivative, all three components.
#[derive(Clone, Debug, PartialEq)]
pub struct Prediction {
    /// Predicted output of the log, body axes, m/s.
    pub velocity: Vector3<f64>,
    /// Its derivative with respect to the error state.
    pub h: Jacobian,
    /// Its derivative with respect to the lever arm, 1/s.
    pub by_lever: Matrix3<f64>,
    /// Covariance of the noise that the lever arm turns from rate to velocity, (m/s)^2.
    pub swing_noise: Matrix3<f64>,
}

/// Predicts the log; `lever` from the IMU to the log, body axes, m; `turn` the rate of turn without that of the waves, rad/s.
#[must_use]
pub fn predict(
    view: &View,
    reference: LogReference,
    lever: &Vector3<f64>,
    turn: f64,
) -> Prediction {
    let c_be = view.c_eb.transpose();
    let to_north_east = view.c_ne.fixed_rows::<2>(0).into_owned();
    let water = reference == LogReference::Water;
    let current_e = to_north_east.transpose() * view.nominal.current;
    let through = if water { view.nominal.velocity - current_e } else { view.nominal.velocity };
    let u = c_be * through + view.rate.cross(lever);
    let m = Vector3::new(0.0, view.nominal.log_misalignment.x, view.nominal.log_misalignment.y);
    let linear = (Matrix3::identity() - skew(&m)) * (1.0 + view.nominal.log_scale);
    let (by_speed, by_turn) = (view.nominal.log_by_speed, view.nominal.log_by_turn);
    let (square, turns) = (u.x.abs() * u.x, Vector2::new(turn.abs(), turn));
    let own = (by_speed * square + by_turn.component_mul(&turns)).push(0.0);
    let mut gain = linear;
    let by_forward = by_speed * (2.0 * u.x.abs());
    (gain[(0, 0)], gain[(1, 0)]) = (gain[(0, 0)] + by_forward.x, gain[(1, 0)] + by_forward.y);
    let mut h = Jacobian::none(3);
    h.set(VELOCITY, &(gain * c_be));
    let by_gyro = gain * skew(lever);
    let by_attitude = gain * c_be * skew(&through) + by_gyro * view.earth_rate_by_attitude();
    h.set(ATTITUDE, &by_attitude);
    h.set(GYRO_BIAS, &by_gyro);
    h.set(GYRO_DRIFT, &by_gyro);
    let by_scale = by_gyro * Matrix3::from_diagonal(&view.inertial_rate);
    h.set(GYRO_SCALE, &by_scale);
    if water {
        h.set(CURRENT, &(-gain * c_be * to_north_east.transpose()));
    }
    h.set(LOG_SCALE, &(u - m.cross(&u)));
    let by_turn = skew(&u) * (1.0 + view.nominal.log_scale);
    h.set(LOG_MISALIGNMENT, &by_turn.fixed_columns::<2>(1).into_owned());
    let level = Matrix3x2::identity();
    h.set(LOG_BY_SPEED, &(level * square));
    h.set(LOG_BY_TURN, &(level * Matrix2::from_diagonal(&turns)));
    let swing_noise = by_gyro * by_gyro.transpose() * view.rate_variance;
    let by_lever = gain * skew(&view.rate);
    Prediction { velocity: linear * u + own, h, by_lever, swing_noise }
}

/// Innovation of one component (0 forward, 1 starboard, 2 down), measured in m/s with sigma `std`.
///
/// A log may give any of the three; they are applied one after the other.
#[must_use]
pub fn component(prediction: &Prediction, axis: usize, measured: f64, std: f64) -> Innovation {
    let z = Vector1::new(measured - prediction.velocity[axis]);
    let noise = Vector1::new(std * std + prediction.swing_noise[(axis, axis)]);
    Innovation::new(&z, prediction.h.select(&[axis]), &noise)
}

/// Innovation of a complete velocity with sigma `std` of each component.
#[must_use]
pub fn complete(prediction: &Prediction, measured: &Vector3<f64>, std: f64) -> Innovation {
    let noise = Matrix3::from_diagonal_element(std * std) + prediction.swing_noise;
    Innovation::new(&(measured - prediction.velocity), prediction.h.clone(), &noise)
}

/// The three components if the log gave all of them.
#[must_use]
pub fn all_components(log: &LogVelocity) -> Option<Vector3<f64>> {
    Some(Vector3::new(log.u?, log.v?, log.w?))
}
