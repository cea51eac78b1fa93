//! What no sensor can tell must stay unknown to the filter: corrections of the estimate change what
//! the covariance means, and it is changed with them.
//!
//! **Biases.** A heading error and a gyro bias to the east cannot be told apart, nor can tilt and
//! accelerometer bias. What the covariance knows of the two together holds along ECEF axes, C_eb db,
//! and must not change when the estimate of C_eb does. Left in body axes, each correction of the
//! heading would turn the direction that nothing measures a little into one that is measured, and
//! the filter would grow sure of what nothing tells it (the inconsistency of Huang, Mourikis and
//! Roumeliotis, Int. J. Robotics Research 29 (2010), section 3). Therefore
//!
//! db_new = C_new^T C_old db_old.
//!
//! **Motion about the berth.** At the berth the motion looks the same whichever way the axes are
//! turned about down ([`crate::aids::berth`]): an error phi_D k of the heading goes together with
//! dp = phi_D k x d of the position from the berth and dv = phi_D k x v. When d and v are corrected,
//! so is what goes together with the heading error.

use nalgebra::{Matrix3, Vector3};

use crate::error_state::{
    ACCEL_BIAS, ACCEL_DRIFT, ATTITUDE, Covariance, Errors, GYRO_BIAS, GYRO_DRIFT, POSITION,
    VELOCITY,
};

/// Turns the covariance of the biases from one estimate of the attitude, C_eb, to another.
pub fn turn_biases(p: &mut Covariance, from: &Matrix3<f64>, to: &Matrix3<f64>) {
    let turn = to.transpose() * from;
    for block in [GYRO_BIAS, GYRO_DRIFT, ACCEL_BIAS, ACCEL_DRIFT] {
        block.transform(p, &turn);
    }
}

/// Keeps a turn about the berth unknown when position and velocity are corrected by `error`, which
/// the covariance has absorbed; `down` is the unit vector down, ECEF axes.
pub fn keep_turn_unknown(p: &mut Covariance, error: &Errors, down: &Vector3<f64>) {
    for block in [POSITION, VELOCITY] {
        // phi_D = down . phi
        let across = down.cross(&error.of(block)) * down.transpose();
        ATTITUDE.add_to(block, p, &across);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, UnitQuaternion};

    #[test]
    fn what_is_known_of_heading_and_bias_together_stays_in_ecef_axes() {
        let mut before = crate::declaration::no_covariance();
        let states = before.states();
        let root = DMatrix::from_fn(states, states, |i, j| ((i * 3 + j * 7) as f64).sin());
        *before.matrix_mut() = &root * root.transpose();
        let old = UnitQuaternion::from_euler_angles(0.1, -0.2, 1.0);
        let new = UnitQuaternion::new(Vector3::new(0.0, 0.05, -0.1)) * old;
        let (old, new) = (old.to_rotation_matrix(), new.to_rotation_matrix());
        let mut after = before.clone();
        turn_biases(&mut after, old.matrix(), new.matrix());
        let cross = |p: &Covariance, c_eb: &Matrix3<f64>| {
            ATTITUDE.covariance_with(GYRO_BIAS, p) * c_eb.transpose()
        };
        let (was, is) = (cross(&before, old.matrix()), cross(&after, new.matrix()));
        assert!((was - is).amax() < 1e-12);
    }
}
