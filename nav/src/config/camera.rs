//! What the filter assumes of a camera.

use insd_base::CameraModel;
use insd_base::units::DEG;

/// How well a camera sits as configured where nobody says, 1-sigma, rad, and its stamps are right, 1-sigma, s.
const CAMERA_AXES_STD: f64 = 1.0 * DEG;
const CAMERA_DELAY_STD: f64 = 0.02;

/// A camera, and how well it is known how it sits and when its images are taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraAid {
    /// How it looks at the world.
    pub model: CameraModel,
    /// Small rotations about body axes by which it sits otherwise, 1-sigma, rad.
    pub axes_std: f64,
    /// By how much its images are taken later than they are stamped, 1-sigma, s.
    pub delay_std: f64,
    /// The visual odometry that tells how it moved, where that is used in place of its points.
    pub odometry: Option<OdometryModel>,
}

impl CameraAid {
    /// One that was put up by eye, and whose images are stamped by who receives them.
    #[must_use]
    pub fn new(model: CameraModel) -> Self {
        let (axes_std, delay_std) = (CAMERA_AXES_STD, CAMERA_DELAY_STD);
        CameraAid { model, axes_std, delay_std, odometry: None }
    }
}

/// A visual odometry that knows no scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OdometryModel {
    /// By how much the scale of a map is other than one, 1-sigma, ratio.
    pub scale_std: f64,
    /// By what it wanders, ratio per root of a second.
    pub scale_walk: f64,
}

impl Default for OdometryModel {
    /// Those of the visual odometry of the berthing source.
    fn default() -> Self {
        OdometryModel { scale_std: 0.3, scale_walk: 1e-3 }
    }
}
