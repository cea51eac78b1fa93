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
//!
//! **Motion under way.** A log tells the velocity in the ship's own axes: it looks the same whichever way attitude, velocity and
//! current are turned together, an error phi of the attitude goes together with dv = phi x v and dc = phi_D k x c. When v and c
//! are corrected, so is what goes together with phi (the covariance is then that of the invariant error of Barrau and Bonnabel,
//! IEEE Trans. Automatic Control 62 (2017), section IV). Left alone, a heading that is off by ten degrees seems to be
//! measured by each turn of a ship that has nothing but her log.

use nalgebra::{Matrix3, Vector2, Vector3};

use insd_estimation::Key;

use crate::error_state::{
    ACCEL_BIAS, ACCEL_DRIFT, ATTITUDE, CAMERA_AXES, CAMERA_POSES, CURRENT, Covariance, Errors,
    GYRO_BIAS, GYRO_DRIFT, LANDMARK_POINTS, LANDMARKS, ODOMETRY_POSES, POSE_STATES, POSES,
    POSITION, VELOCITY, VO_POSES,
};

/// Turns the covariance of the biases from one estimate of the attitude, C_eb, to another.
pub fn turn_biases(p: &mut Covariance, from: &Matrix3<f64>, to: &Matrix3<f64>) {
    let turn = to.transpose() * from;
    for block in [GYRO_BIAS, GYRO_DRIFT, ACCEL_BIAS, ACCEL_DRIFT, CAMERA_AXES] {
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

/// Keeps a turn of all that moves unknown when a log corrects the velocity, ECEF axes, and the current, north and east, by these, m/s,
/// which the covariance has absorbed; `down` is the unit vector down, ECEF axes.
pub fn keep_course_unknown(
    p: &mut Covariance,
    velocity: &Vector3<f64>,
    current: &Vector2<f64>,
    down: &Vector3<f64>,
) {
    ATTITUDE.add_to(VELOCITY, p, &-velocity.cross_matrix());
    let across = Vector2::new(-current.y, current.x) * down.transpose();
    ATTITUDE.add_to(CURRENT, p, &across);
}

/// Keeps a turn of camera and scene together unknown when a camera corrects places and velocity by `error`, which the covariance has absorbed:
/// an error of the camera's attitude, phi + C_eb m with m that of how it sits, goes together with dp = (phi + C_eb m) x p of each place, and is seen
/// as little after a correction of p as before. A turn of the ship alone, about a camera that stays, changes no place.
pub fn keep_scene_unknown(p: &mut Covariance, error: &Errors, c_eb: &Matrix3<f64>) {
    let layout = p.layout().clone();
    if error.layout() != &layout {
        return;
    }
    let axes = layout.start(CAMERA_AXES.key());
    let Some((attitude, axes)) = layout.start(ATTITUDE.key()).zip(axes) else { return };
    let places = |key: Key, count: usize, apart: usize| {
        let start = layout.start(key);
        (0..count).filter_map(move |index| Some(start? + apart * index))
    };
    let moved = places(POSITION.key(), 1, 3)
        .chain(places(VELOCITY.key(), 1, 3))
        .chain(places(POSES.key(), CAMERA_POSES, POSE_STATES))
        .chain(places(LANDMARK_POINTS.key(), LANDMARKS, 3))
        .chain(places(VO_POSES.key(), ODOMETRY_POSES, POSE_STATES));
    let matrix = p.matrix_mut();
    for start in moved {
        let by = -error.values().fixed_rows::<3>(start).cross_matrix();
        let turn = matrix.fixed_rows::<3>(attitude) + c_eb * matrix.fixed_rows::<3>(axes);
        let more = by * turn;
        let mut rows = matrix.fixed_rows_mut::<3>(start);
        rows += more;
        let columns = matrix.fixed_columns::<3>(axes) * c_eb.transpose();
        let turn = matrix.fixed_columns::<3>(attitude) + columns;
        let more = turn * by.transpose();
        let mut columns = matrix.fixed_columns_mut::<3>(start);
        columns += more;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, UnitQuaternion};

    #[test]
    fn what_is_known_of_heading_and_bias_together_stays_in_ecef_axes() {
        let mut before = crate::error_state::no_covariance();
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

    #[test]
    fn a_turn_of_all_that_moves_stays_what_a_log_does_not_see() {
        let mut p = crate::error_state::no_covariance();
        let down = Vector3::new(0.6, 0.0, 0.8);
        let (before, correction) = (Vector3::new(4.0, -2.0, 1.0), Vector3::new(0.5, 1.0, -0.2));
        // nothing is unknown but a turn by one radian
        let turned = |velocity: &Vector3<f64>| down.cross(velocity);
        let mut unknown = Errors::zeros(p.layout());
        unknown.set(ATTITUDE, &down);
        unknown.set(VELOCITY, &turned(&before));
        let unknown = unknown.to_column();
        *p.matrix_mut() = &unknown * unknown.transpose();
        keep_course_unknown(&mut p, &correction, &Vector2::zeros(), &down);
        let after = ATTITUDE.covariance_with(VELOCITY, &p);
        let expected = down * turned(&(before + correction)).transpose();
        assert!((after - expected).amax() < 1e-12, "{after} {expected}");
    }
}
