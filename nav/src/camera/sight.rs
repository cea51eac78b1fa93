//! Where a point of the world is seen, and what that depends on.
//!
//! With the pose C (body to Earth) and p at the time of the image, moved on by the delay t_d, the mounting C_bc and a small rotation m of it:
//!
//! h = (Exp(m) C_bc)^T (C^T (f - p) - l),   z = pi(h) + noise (Mourikis and Roumeliotis 2007, eqs. (17)-(18)).
//!
//! For the attitude error of this filter, C_true = Exp(psi) C:  dh/dpsi = R \[f - p\]x, dh/dp = -R, dh/df = R with R = (Exp(m) C_bc)^T C^T;
//! dh/dm = (Exp(m) C_bc)^T \[b\]x with b = C^T (f - p) - l; dh/dt_d = dh/dp v + dh/dpsi w.

use insd_base::CameraModel;
use insd_base::attitude::skew;
use nalgebra::{Matrix2x3, Matrix3, Rotation3, SMatrix, SVector, UnitQuaternion, Vector2, Vector3};

use crate::aids::View;
use crate::error_state::POSE_STATES;

/// Where the IMU was and how it moved when an image was taken, ECEF axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Position of the IMU, m.
    pub position: Vector3<f64>,
    /// Body to ECEF axes.
    pub attitude: UnitQuaternion<f64>,
    /// Velocity, m/s.
    pub velocity: Vector3<f64>,
    /// Angular rate over the Earth, ECEF axes, rad/s.
    pub rate: Vector3<f64>,
}

impl Pose {
    /// That of an estimate.
    #[must_use]
    pub fn of(view: &View) -> Self {
        Pose {
            position: view.nominal.position,
            attitude: view.nominal.attitude,
            velocity: view.nominal.velocity,
            rate: view.c_eb * view.rate,
        }
    }

    /// The same after corrections of position and attitude, m and rad.
    #[must_use]
    pub fn corrected(&self, by: &SVector<f64, POSE_STATES>) -> Self {
        let turn = UnitQuaternion::new(by.fixed_rows::<3>(3).into_owned());
        Pose {
            position: self.position + by.fixed_rows::<3>(0),
            attitude: turn * self.attitude,
            ..*self
        }
    }

    /// The same so much later, s.
    #[must_use]
    pub fn later(&self, delay: f64) -> Self {
        Pose {
            position: self.position + self.velocity * delay,
            attitude: UnitQuaternion::new(self.rate * delay) * self.attitude,
            ..*self
        }
    }
}

/// A camera as it is estimated to sit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eye {
    model: CameraModel,
    /// Camera to body axes.
    c_bc: Matrix3<f64>,
    /// What a change of the rotation vector turns it by.
    by_axes: Matrix3<f64>,
    axes: Vector3<f64>,
    delay: f64,
}

/// Where a point is seen, px, and the derivatives of that.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointSight {
    /// Right and down, px.
    pub at: Vector2<f64>,
    /// By position and attitude of the IMU.
    pub by_pose: SMatrix<f64, 2, POSE_STATES>,
    /// By the point, ECEF.
    pub by_point: Matrix2x3<f64>,
    /// By how the camera sits.
    pub by_axes: Matrix2x3<f64>,
    /// By the delay.
    pub by_delay: Vector2<f64>,
}

impl Eye {
    /// A camera that sits otherwise than configured by a small rotation about body axes, rad, and whose images are late by so much, s.
    #[must_use]
    pub fn new(model: &CameraModel, axes: &Vector3<f64>, delay: f64) -> Self {
        let c_bc = Rotation3::new(*axes).into_inner() * model.c_bc;
        let by_axes = left_jacobian(axes);
        Eye { model: *model, c_bc, by_axes, axes: *axes, delay }
    }

    /// The same that sits otherwise still, and is later still.
    #[must_use]
    pub fn moved(&self, axes: &Vector3<f64>, delay: f64) -> Self {
        let axes = self.axes + axes;
        let straight = Rotation3::new(self.axes).into_inner().transpose() * self.c_bc;
        let c_bc = Rotation3::new(axes).into_inner() * straight;
        Eye { c_bc, by_axes: left_jacobian(&axes), axes, delay: self.delay + delay, ..*self }
    }

    /// The camera itself.
    #[must_use]
    pub fn model(&self) -> &CameraModel {
        &self.model
    }

    /// Camera to body axes, as it sits.
    #[must_use]
    pub fn c_bc(&self) -> Matrix3<f64> {
        self.c_bc
    }

    /// By what a change of the rotation vector turns it.
    #[must_use]
    pub fn by_axes(&self) -> Matrix3<f64> {
        self.by_axes
    }

    /// By how much images are taken later than they are stamped, s.
    #[must_use]
    pub fn delay(&self) -> f64 {
        self.delay
    }

    /// Where its centre is, ECEF, m, and how it is turned (ECEF to camera axes), when the IMU has this pose at the stamped time.
    #[must_use]
    pub fn placed(&self, pose: &Pose) -> (Vector3<f64>, Matrix3<f64>) {
        let taken = pose.later(self.delay);
        let c_eb = taken.attitude.to_rotation_matrix().into_inner();
        (taken.position + c_eb * self.model.lever.0, self.c_bc.transpose() * c_eb.transpose())
    }

    /// How a point is seen; `None` where it is not before the camera.
    #[must_use]
    pub fn sight(&self, pose: &Pose, point: &Vector3<f64>) -> Option<PointSight> {
        let taken = pose.later(self.delay);
        let c_be = taken.attitude.to_rotation_matrix().into_inner().transpose();
        let away = point - taken.position;
        let body = c_be * away - self.model.lever.0;
        let c_cb = self.c_bc.transpose();
        let h = c_cb * body;
        let at = self.model.project(&h)?;
        let by_h = projection(&self.model, &h);
        let by_point = by_h * c_cb * c_be;
        let by_attitude = by_point * skew(&away);
        let mut by_pose = SMatrix::<f64, 2, POSE_STATES>::zeros();
        by_pose.fixed_columns_mut::<3>(0).copy_from(&-by_point);
        let meanwhile = Rotation3::new(taken.rate * self.delay);
        by_pose.fixed_columns_mut::<3>(3).copy_from(&(by_attitude * meanwhile.matrix()));
        Some(PointSight {
            at,
            by_pose,
            by_point,
            by_axes: by_h * c_cb * skew(&body) * self.by_axes,
            by_delay: by_attitude * taken.rate - by_point * taken.velocity,
        })
    }
}

/// Exp(m + dm) = Exp(J dm) Exp(m): J to the second order (Barfoot, State Estimation for Robotics, eq. (7.77)).
fn left_jacobian(rotation: &Vector3<f64>) -> Matrix3<f64> {
    let turn = skew(rotation);
    Matrix3::identity() + turn * 0.5 + turn * turn / 6.0
}

/// Derivative of an image point, px, by the point in camera axes.
#[must_use]
pub fn projection(model: &CameraModel, h: &Vector3<f64>) -> Matrix2x3<f64> {
    let (across, down) = (model.focal.x / h.z, model.focal.y / h.z);
    Matrix2x3::new(across, 0.0, -across * h.x / h.z, 0.0, down, -down * h.y / h.z)
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use insd_base::{Body, Geodetic, earth};

    /// A camera that looks over the starboard bow and a little down.
    pub(crate) fn model() -> CameraModel {
        let forward = Rotation3::from_euler_angles(0.0, 0.0, 0.5).into_inner();
        CameraModel {
            lever: Body::new(10.0, 2.0, -6.0),
            c_bc: forward * Matrix3::new(0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0),
            focal: Vector2::new(800.0, 810.0),
            centre: Vector2::new(640.0, 360.0),
            size: [1280, 720],
            pixel_std: 0.5,
        }
    }

    pub(crate) fn pose() -> Pose {
        let place = Geodetic::from_degrees(35.0, 139.0, 20.0);
        let c_en = earth::c_ne(&place).transpose();
        let c_nb = Rotation3::from_euler_angles(0.02, -0.03, 1.1).into_inner();
        Pose {
            position: earth::ecef(&place).0,
            attitude: UnitQuaternion::from_matrix(&(c_en * c_nb)),
            velocity: c_en * Vector3::new(1.0, 1.5, 0.1),
            rate: c_en * Vector3::new(0.01, -0.02, 0.05),
        }
    }

    #[test]
    fn derivatives_agree_with_differences() {
        let (axes, delay) = (Vector3::new(0.01, -0.02, 0.03), 0.04);
        let eye = Eye::new(&model(), &axes, delay);
        let (centre, c_ce) = eye.placed(&pose());
        let point = centre + c_ce.tr_mul(&Vector3::new(4.0, -3.0, 30.0));
        let sight = eye.sight(&pose(), &point).unwrap();
        let step = 1e-4;
        let slope =
            |seen: &dyn Fn(f64) -> PointSight| (seen(step).at - seen(-step).at) / (2.0 * step);
        for column in 0..POSE_STATES {
            let own = slope(&|by| {
                let mut error = SVector::<f64, POSE_STATES>::zeros();
                error[column] = by;
                eye.sight(&pose().corrected(&error), &point).unwrap()
            });
            assert!((own - sight.by_pose.column(column)).norm() < 2e-2, "{column}: {own}");
        }
        let along = |axis: usize, by: f64| {
            let mut error = Vector3::zeros();
            error[axis] = by;
            error
        };
        for axis in 0..3 {
            let own = slope(&|by| eye.sight(&pose(), &(point + along(axis, by))).unwrap());
            assert!((own - sight.by_point.column(axis)).norm() < 2e-2, "{axis}: {own}");
            let own = slope(&|by| {
                let eye = Eye::new(&model(), &(axes + along(axis, by)), delay);
                eye.sight(&pose(), &point).unwrap()
            });
            assert!((own - sight.by_axes.column(axis)).norm() < 2e-2, "{axis}: {own}");
        }
        let late = |by: f64| Eye::new(&model(), &axes, delay + by).sight(&pose(), &point).unwrap();
        let own = slope(&late);
        assert!((own - sight.by_delay).norm() < 2e-2, "{own} {}", sight.by_delay);
    }

    #[test]
    fn a_turn_of_everything_about_the_vertical_and_a_shift_are_not_seen() {
        let eye = Eye::new(&model(), &Vector3::zeros(), 0.0);
        let (centre, c_ce) = eye.placed(&pose());
        let point = centre + c_ce.tr_mul(&Vector3::new(-4.0, 1.0, 20.0));
        let sight = eye.sight(&pose(), &point).unwrap();
        let axis = pose().position.normalize();
        let mut turn = SVector::<f64, POSE_STATES>::zeros();
        turn.fixed_rows_mut::<3>(0).copy_from(&axis.cross(&pose().position));
        turn.fixed_rows_mut::<3>(3).copy_from(&axis);
        let seen = sight.by_pose * turn + sight.by_point * axis.cross(&point);
        assert!(seen.norm() < 1e-5, "{seen}");
    }
}
