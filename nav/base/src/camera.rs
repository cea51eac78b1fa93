//! What a camera tells of a ship's motion: tracks of points at rest, or a visual odometry of another's making.

use std::fmt;

use nalgebra::{Matrix3, UnitQuaternion, Vector2, Vector3};

use crate::estimates::Estimate;
use crate::frames::Body;
use crate::time::Time;

/// How a camera looks at the world and where it sits. Camera axes: `x` right in the image, `y` down, `z` along the optical axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraModel {
    /// From the IMU, body axes, m.
    pub lever: Body,
    /// Turns a vector from camera axes to body axes.
    pub c_bc: Matrix3<f64>,
    /// Focal lengths, px: across and down.
    pub focal: Vector2<f64>,
    /// Where the optical axis meets the image, px.
    pub centre: Vector2<f64>,
    /// Width and height of the image, px.
    pub size: [u32; 2],
    /// Error of an image point, 1-sigma of each axis, px.
    pub pixel_std: f64,
}

/// A point of the world in one image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImagePoint {
    /// Its track: the same number is the same point, in an unbroken row of images; a point lost and found is another.
    pub track: u64,
    /// Right and down, undistorted, px, counted as [`CameraModel::centre`] is: with calibrations of OpenCV from the middle of the first pixel.
    pub at: Vector2<f64>,
}

/// One image, as what is left of it after tracking.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraFrame {
    /// When the middle of the image was exposed, as far as the camera's clock is right.
    pub time: Time,
    /// The points, each track once.
    pub points: Vec<ImagePoint>,
}

/// How a camera moved from one image to another, by a visual odometry that knows no scale: `x_from = rotation x_to + translation`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VisualOdometry {
    /// The later image.
    pub time: Time,
    /// The earlier image.
    pub since: Time,
    /// Another number is another scale, with no link to the one before.
    pub map: u32,
    /// Turns a vector from axes of the later camera to axes of the earlier one.
    pub rotation: UnitQuaternion<f64>,
    /// The later camera in axes of the earlier one, true metres times the map's scale.
    pub translation: Vector3<f64>,
    /// Error of the rotation, 1-sigma of each axis, rad; errors of steps are independent.
    pub rotation_std: f64,
    /// Error of the translation, 1-sigma of each axis, in its own units.
    pub translation_std: f64,
}

/// How far a camera is believed, where that changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum CameraTurn {
    /// Most of what it sees moves otherwise than the world does, or there is hardly anything to see: it is not used.
    Doubtful,
    /// What it sees agrees with the ship again, and is used.
    Agrees,
}

/// A camera as the navigator has it, for those who look on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraSight {
    /// When the last image was taken that the navigator used.
    pub time: Time,
    /// Points in that image; `None` where steps of a visual odometry are used.
    pub points: Option<usize>,
    /// Poses that are held, from which points were seen.
    pub poses: usize,
    /// Points that are held as places.
    pub landmarks: usize,
    /// What it sees is looked at and not used.
    pub is_doubted: bool,
    /// How it sits otherwise than configured: a small turn about forward, starboard, down, rad.
    pub turned: Body,
    /// Its 1-sigma.
    pub turned_sigma: Body,
    /// By how much images are taken later than they are stamped, s.
    pub delay: Estimate,
}

impl CameraTurn {
    /// A word for tables.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Doubtful => "doubtful",
            Self::Agrees => "agrees",
        }
    }
}

impl fmt::Display for CameraTurn {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Doubtful => {
                "it is not used: it sees too little, or what it sees is not at rest; the lens may be wet, or it sits otherwise than configured"
            }
            Self::Agrees => "what it sees agrees with the ship, and is used",
        })
    }
}

impl CameraModel {
    /// Where a point `h` (camera axes, m) is seen, px; `None` behind the camera.
    #[must_use]
    pub fn project(&self, h: &Vector3<f64>) -> Option<Vector2<f64>> {
        (h.z > 0.0).then(|| self.centre + self.focal.component_mul(&(h.xy() / h.z)))
    }

    /// The direction in which an image point lies: camera axes, a vector with `z` of one.
    #[must_use]
    pub fn ray(&self, at: &Vector2<f64>) -> Vector3<f64> {
        (at - self.centre).component_div(&self.focal).push(1.0)
    }

    /// Whether a point lies within the image.
    #[must_use]
    pub fn sees(&self, at: &Vector2<f64>) -> bool {
        let within = |v: f64, size: u32| (0.0..=f64::from(size)).contains(&v);
        within(at.x, self.size[0]) && within(at.y, self.size[1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera() -> CameraModel {
        CameraModel {
            lever: Body::default(),
            c_bc: Matrix3::identity(),
            focal: Vector2::new(800.0, 810.0),
            centre: Vector2::new(640.0, 360.0),
            size: [1280, 720],
            pixel_std: 0.5,
        }
    }

    #[test]
    fn a_ray_leads_back_to_the_point_that_was_seen() {
        let h = Vector3::new(3.0, -2.0, 25.0);
        let seen = camera().project(&h).unwrap();
        assert!((camera().ray(&seen) * h.z - h).norm() < 1e-12);
        assert!(camera().sees(&seen) && !camera().sees(&Vector2::new(-1.0, 3.0)));
    }

    #[test]
    fn what_is_behind_a_camera_is_not_seen() {
        assert_eq!(camera().project(&Vector3::new(0.0, 0.0, -1.0)), None);
    }
}
