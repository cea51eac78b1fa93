//! What a step of a visual odometry tells of the two poses that it lies between.
//!
//! With the poses C_i (body to Earth), p_i at the times of both images, moved on by the delay, the lever arm l, C_bc as the camera sits, the scale S of the map, and
//! w = p_2 + C_2 l - p_1 - C_1 l the way of the camera, a step says
//!
//! t = S C_cb C_1^T w + noise,   R = C_cb C_1^T C_2 C_bc Exp(noise) (the source's d and Theta, docs/systems.md S4, from keyframe to keyframe).
//!
//! For attitude errors C_true = Exp(psi) C: dt = S C_cb C_1^T (dp_2 - \[C_2 l\]x psi_2 - dp_1 + (\[C_1 l\]x + \[w\]x) psi_1) + t/S dS, and the turn is off by
//! C_cb C_2^T (psi_2 - psi_1). Of a mounting that is turned by m, dt = S C_cb \[C_1^T w\]x m and C_cb (I - C_2^T C_1) m.

use insd_base::VisualOdometry;
use insd_base::attitude::skew;
use nalgebra::{Matrix3, Matrix6x3, Rotation3, SMatrix, SVector, UnitQuaternion, Vector3, Vector6};

use super::sight::{Eye, Pose};
use crate::error_state::POSE_STATES;

/// Rows of a step: the way, in units of its map, and the turn, rad; axes of the earlier camera, and of the later one.
pub const STEP_ROWS: usize = 6;
/// Rows of a step by the states of one pose.
pub type ByPose = SMatrix<f64, STEP_ROWS, POSE_STATES>;

/// What a step tells, and the derivatives of what was expected.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepTold {
    /// Measured less expected.
    pub z: Vector6<f64>,
    /// By position and attitude of the IMU at the earlier image.
    pub by_before: ByPose,
    /// At the later one.
    pub by_now: ByPose,
    /// By how the camera sits.
    pub by_axes: Matrix6x3<f64>,
    /// By the delay.
    pub by_delay: Vector6<f64>,
    /// By the scale of the map.
    pub by_scale: Vector6<f64>,
    /// 1-sigma of each row, as it is stated.
    pub sigma: Vector6<f64>,
}

/// One end of a step.
struct End {
    pose: Pose,
    c_be: Matrix3<f64>,
    /// From the IMU to the camera, ECEF axes, m.
    lever: Vector3<f64>,
    /// What the stamped attitude turns that of the image by.
    meanwhile: Matrix3<f64>,
}

impl End {
    fn new(eye: &Eye, stamped: &Pose) -> Self {
        let pose = stamped.later(eye.delay());
        let c_eb = pose.attitude.to_rotation_matrix().into_inner();
        let meanwhile = Rotation3::new(pose.rate * eye.delay()).into_inner();
        End { pose, c_be: c_eb.transpose(), lever: c_eb * eye.model().lever.0, meanwhile }
    }

    /// Rows by its pose, from those of way and turn by the attitude at the image and of the way by the position; and what the delay changes.
    fn by_pose(&self, way: [&Matrix3<f64>; 2], turn: &Matrix3<f64>) -> (ByPose, Vector6<f64>) {
        let [by_position, by_attitude] = way;
        let mut by = ByPose::zeros();
        by.fixed_view_mut::<3, 3>(0, 0).copy_from(by_position);
        by.fixed_view_mut::<3, 3>(0, 3).copy_from(&(by_attitude * self.meanwhile));
        by.fixed_view_mut::<3, 3>(3, 3).copy_from(&(turn * self.meanwhile));
        let along = by_position * self.pose.velocity + by_attitude * self.pose.rate;
        (by, stacked(&along, &(turn * self.pose.rate)))
    }
}

/// What a step tells that lies between two poses, in a map of this scale. Derivatives by all else are those at the scale `about`, to which the scale may be found to be other.
#[must_use]
pub fn told(
    eye: &Eye,
    [before, now]: [&Pose; 2],
    step: &VisualOdometry,
    [scale, about]: [f64; 2],
) -> StepTold {
    let ends = [before, now].map(|pose| End::new(eye, pose));
    let [one, other] = &ends;
    let c_cb = eye.c_bc().transpose();
    let c_ce = c_cb * one.c_be;
    let way = other.pose.position - one.pose.position + other.lever - one.lever;
    let unscaled = c_ce * way;
    let expected = c_ce * other.c_be.transpose() * eye.c_bc();
    let expected = UnitQuaternion::from_matrix(&expected);
    let z = stacked(
        &(step.translation - unscaled * scale),
        &(expected.inverse() * step.rotation).scaled_axis(),
    );
    let by_place = c_ce * about;
    let turn = c_cb * other.c_be;
    let by_arms = [skew(&one.lever) + skew(&way), -skew(&other.lever)].map(|arm| by_place * arm);
    let (by_before, early) = one.by_pose([&-by_place, &by_arms[0]], &-turn);
    let (by_now, late) = other.by_pose([&by_place, &by_arms[1]], &turn);
    let mut by_axes = Matrix6x3::zeros();
    let seen_way = c_cb * skew(&(one.c_be * way)) * about;
    by_axes.fixed_rows_mut::<3>(0).copy_from(&(seen_way * eye.by_axes()));
    let seen_turn = c_cb * (Matrix3::identity() - other.c_be * one.c_be.transpose());
    by_axes.fixed_rows_mut::<3>(3).copy_from(&(seen_turn * eye.by_axes()));
    let sigma = [step.translation_std, step.rotation_std].map(Vector3::repeat);
    StepTold {
        z,
        by_before,
        by_now,
        by_axes,
        by_delay: early + late,
        by_scale: stacked(&unscaled, &Vector3::zeros()),
        sigma: stacked(&sigma[0], &sigma[1]),
    }
}

fn stacked(way: &Vector3<f64>, turn: &Vector3<f64>) -> Vector6<f64> {
    SVector::from_fn(|row, _| if row < 3 { way[row] } else { turn[row - 3] })
}

/// Whether numbers can be a step.
#[must_use]
pub fn is_step(step: &VisualOdometry) -> bool {
    /// No camera on a ship moves farther between images that see the same, in units of a map.
    const FARTHEST: f64 = 1e6;
    let is_std = |std: f64| std > 0.0 && std.is_finite();
    let turn = step.rotation.as_ref().norm();
    step.since < step.time
        && step.translation.norm() < FARTHEST
        && (turn - 1.0).abs() < 1e-3
        && is_std(step.translation_std)
        && is_std(step.rotation_std)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::sight::tests::{model, pose};
    use insd_base::Time;

    const SCALE: f64 = 1.3;

    fn poses() -> [Pose; 2] {
        let turn = UnitQuaternion::new(Vector3::new(0.02, -0.03, 0.05));
        let before = pose();
        let moved = before.position + before.attitude * Vector3::new(1.2, 0.3, -0.1);
        let now = Pose { position: moved, attitude: turn * before.attitude, ..before };
        [before, Pose { rate: now.rate * 0.5, velocity: now.velocity * 1.1, ..now }]
    }

    fn eye(axes: &Vector3<f64>, delay: f64) -> Eye {
        Eye::new(&model(), axes, delay)
    }

    /// The step that an eye sees between two poses.
    fn seen(eye: &Eye, [before, now]: &[Pose; 2]) -> VisualOdometry {
        let ([c_1, r_1], [c_2, r_2]) = (placed(eye, before), placed(eye, now));
        let turn = UnitQuaternion::from_matrix(&(r_1 * r_2.transpose()));
        VisualOdometry {
            time: Time::from_seconds(1.0),
            since: Time::from_seconds(0.5),
            map: 0,
            rotation: turn,
            translation: r_1 * (c_2.column(0) - c_1.column(0)) * SCALE,
            rotation_std: 3e-4,
            translation_std: 0.02,
        }
    }

    /// The centre as the first column, and the axes.
    fn placed(eye: &Eye, pose: &Pose) -> [Matrix3<f64>; 2] {
        let (centre, c_ce) = eye.placed(pose);
        [Matrix3::from_columns(&[centre, centre, centre]), c_ce]
    }

    #[test]
    fn what_is_seen_without_error_is_what_is_expected() {
        let eye = eye(&Vector3::new(0.01, -0.02, 0.03), 0.04);
        let [before, now] = poses();
        let told = told(&eye, [&before, &now], &seen(&eye, &poses()), [SCALE, SCALE]);
        assert!(told.z.norm() < 1e-7, "{}", told.z);
    }

    /// Derivative of what is seen by one thing, by differences, beside what was expected to be seen.
    fn slope(seen_at: impl Fn(f64) -> VisualOdometry) -> Vector6<f64> {
        let by = 1e-4;
        let [less, more] = [seen_at(-by), seen_at(by)];
        let turn = (less.rotation.inverse() * more.rotation).scaled_axis();
        stacked(&(more.translation - less.translation), &turn) / (2.0 * by)
    }

    #[test]
    fn derivatives_of_a_step_agree_with_differences() {
        let (axes, delay) = (Vector3::new(0.01, -0.02, 0.03), 0.04);
        let own = eye(&axes, delay);
        let [before, now] = poses();
        let told = told(&own, [&before, &now], &seen(&own, &poses()), [SCALE, SCALE]);
        let close = |what: &str, by: Vector6<f64>, expected: Vector6<f64>| {
            assert!((by - expected).norm() < 2e-4, "{what}: {by} {expected}");
        };
        for column in 0..POSE_STATES {
            let moved = |pose: &Pose, by: f64| {
                let mut error = SVector::<f64, POSE_STATES>::zeros();
                error[column] = by;
                pose.corrected(&error)
            };
            let by = slope(|by| seen(&own, &[moved(&before, by), now]));
            close("before", by, told.by_before.column(column).into_owned());
            let by = slope(|by| seen(&own, &[before, moved(&now, by)]));
            close("now", by, told.by_now.column(column).into_owned());
        }
        for axis in 0..3 {
            let mut turn = Vector3::zeros();
            turn[axis] = 1.0;
            let by = slope(|by| seen(&eye(&(axes + turn * by), delay), &poses()));
            close("axes", by, told.by_axes.column(axis).into_owned());
        }
        close("delay", slope(|by| seen(&eye(&axes, delay + by), &poses())), told.by_delay);
    }

    #[test]
    fn what_cannot_be_a_step_is_none() {
        let good = seen(&eye(&Vector3::zeros(), 0.0), &poses());
        assert!(is_step(&good));
        assert!(!is_step(&VisualOdometry { since: good.time, ..good }));
        assert!(!is_step(&VisualOdometry { translation_std: 0.0, ..good }));
        assert!(!is_step(&VisualOdometry { rotation_std: f64::NAN, ..good }));
        assert!(!is_step(&VisualOdometry { translation: Vector3::repeat(f64::NAN), ..good }));
    }
}
