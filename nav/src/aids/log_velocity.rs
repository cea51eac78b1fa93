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
use nalgebra::{Matrix3, SMatrix, Vector1, Vector3};

use super::View;
use crate::error_state::{
    ATTITUDE, CURRENT, GYRO_BIAS, GYRO_DRIFT, GYRO_SCALE, LOG_MISALIGNMENT, LOG_SCALE, STATES,
    VELOCITY,
};
use crate::innovation::Innovation;

/// The predicted log velocity and its derivative, all three components.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prediction {
    /// Predicted output of the log, body axes, m/s.
    pub velocity: Vector3<f64>,
    /// Its derivative with respect to the error state.
    pub h: SMatrix<f64, 3, STATES>,
    /// Its derivative with respect to the lever arm, 1/s.
    pub by_lever: Matrix3<f64>,
    /// Covariance of the noise that the lever arm turns from rate to velocity, (m/s)^2.
    pub swing_noise: Matrix3<f64>,
}

/// Predicts the log; `lever` from the IMU to the log, body axes, m.
#[must_use]
pub fn predict(view: &View, reference: LogReference, lever: &Vector3<f64>) -> Prediction {
    let c_be = view.c_eb.transpose();
    let to_north_east = view.c_ne.fixed_rows::<2>(0).into_owned();
    let water = reference == LogReference::Water;
    let current_e = to_north_east.transpose() * view.nominal.current;
    let through = if water { view.nominal.velocity - current_e } else { view.nominal.velocity };
    let u = c_be * through + view.rate.cross(lever);
    let m = Vector3::new(0.0, view.nominal.log_misalignment.x, view.nominal.log_misalignment.y);
    let gain = (Matrix3::identity() - skew(&m)) * (1.0 + view.nominal.log_scale);
    let mut h = SMatrix::zeros();
    VELOCITY.set_columns(&mut h, &(gain * c_be));
    let by_gyro = gain * skew(lever);
    let by_attitude = gain * c_be * skew(&through) + by_gyro * view.earth_rate_by_attitude();
    ATTITUDE.set_columns(&mut h, &by_attitude);
    GYRO_BIAS.set_columns(&mut h, &by_gyro);
    GYRO_DRIFT.set_columns(&mut h, &by_gyro);
    let by_scale = by_gyro * Matrix3::from_diagonal(&view.inertial_rate);
    GYRO_SCALE.set_columns(&mut h, &by_scale);
    if water {
        CURRENT.set_columns(&mut h, &(-gain * c_be * to_north_east.transpose()));
    }
    LOG_SCALE.set_columns(&mut h, &(u - m.cross(&u)));
    let by_turn = skew(&u) * (1.0 + view.nominal.log_scale);
    LOG_MISALIGNMENT.set_columns(&mut h, &by_turn.fixed_columns::<2>(1).into_owned());
    let swing_noise = by_gyro * by_gyro.transpose() * view.rate_variance;
    let by_lever = gain * skew(&view.rate);
    Prediction { velocity: gain * u, h, by_lever, swing_noise }
}

/// Innovation of one component (0 forward, 1 starboard, 2 down), measured in m/s with sigma `std`.
///
/// A log may give any of the three; they are applied one after the other.
#[must_use]
pub fn component(prediction: &Prediction, axis: usize, measured: f64, std: f64) -> Innovation<1> {
    Innovation {
        z: Vector1::new(measured - prediction.velocity[axis]),
        h: prediction.h.fixed_rows::<1>(axis).into_owned(),
        r: Vector1::new(std * std + prediction.swing_noise[(axis, axis)]),
    }
}

/// Innovation of a complete velocity with sigma `std` of each component.
#[must_use]
pub fn complete(prediction: &Prediction, measured: &Vector3<f64>, std: f64) -> Innovation<3> {
    Innovation {
        z: measured - prediction.velocity,
        h: prediction.h,
        r: Matrix3::identity() * (std * std) + prediction.swing_noise,
    }
}

/// The three components if the log gave all of them.
#[must_use]
pub fn all_components(log: &LogVelocity) -> Option<Vector3<f64>> {
    Some(Vector3::new(log.u?, log.v?, log.w?))
}
