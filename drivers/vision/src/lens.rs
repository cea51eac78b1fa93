//! How a lens bends: from a direction to the pixel that sees it, and back.

use insd_base::{Body, CameraModel};
use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};

/// The distortion of a lens, on the plane `z = 1` of camera axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lens {
    /// Radial and tangential, OpenCV's: `x' = x c + 2 p1 x y + p2 (r2 + 2 x2)`, `y' = y c + p1 (r2 + 2 y2) + 2 p2 x y`,
    /// `c = (1 + k1 r2 + k2 r4 + k3 r6) / (1 + k4 r2 + k5 r4 + k6 r6)`.
    RadialTangential {
        /// `k1` to `k6`.
        k: [f64; 6],
        /// `p1`, `p2`.
        p: [f64; 2],
    },
    /// Fisheye, Kannala and Brandt 2006: `x' = x theta_d / r`, `theta_d = theta (1 + k1 theta2 + k2 theta4 + k3 theta6 + k4 theta8)`,
    /// `theta = atan r`.
    Equidistant {
        /// `k1` to `k4`.
        k: [f64; 4],
    },
}

/// What a calibration tells of a camera: all of its model but where it sits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraCalibration {
    /// Focal lengths, px: across and down.
    pub focal: Vector2<f64>,
    /// Where the optical axis meets the image, px.
    pub centre: Vector2<f64>,
    /// Width and height of the image, px.
    pub size: [u32; 2],
    /// How its lens bends.
    pub lens: Lens,
}

/// Steps of the iterations that have to converge.
const STEPS: usize = 30;
/// When an iteration has converged, on the plane `z = 1`.
const CONVERGED: f64 = 1e-12;
/// Beyond this angle from the optical axis (rad) a pinhole's image of a fisheye is mostly stretch.
const WIDEST: f64 = 1.4;

impl Lens {
    /// A lens that does not bend.
    pub const STRAIGHT: Lens = Lens::RadialTangential { k: [0.0; 6], p: [0.0; 2] };

    /// Where the direction `(x, y, 1)` is seen, on the plane `z = 1`.
    #[must_use]
    pub fn distort(&self, x: &Vector2<f64>) -> Vector2<f64> {
        match self {
            Lens::RadialTangential { k, p } => radial_tangential(k, p, x).0,
            Lens::Equidistant { k } => {
                let r = x.norm();
                if r < 1e-12 { *x } else { x * (bent_angle(k, r.atan()).0 / r) }
            }
        }
    }

    /// The direction that is seen at `seen`; `None` where the model folds over or does not reach.
    #[must_use]
    pub fn undistort(&self, seen: &Vector2<f64>) -> Option<Vector2<f64>> {
        match self {
            Lens::RadialTangential { k, p } => newton(k, p, seen),
            Lens::Equidistant { k } => {
                let bent = seen.norm();
                if bent < 1e-12 {
                    return Some(*seen);
                }
                let theta =
                    straight_angle(k, bent).filter(|theta| (0.0..WIDEST).contains(theta))?;
                Some(seen * (theta.tan() / bent))
            }
        }
    }
}

/// The distorted point and its derivative.
fn radial_tangential(
    k: &[f64; 6],
    p: &[f64; 2],
    at: &Vector2<f64>,
) -> (Vector2<f64>, Matrix2<f64>) {
    let (x, y) = (at.x, at.y);
    let r2 = at.norm_squared();
    let above = 1.0 + r2 * (k[0] + r2 * (k[1] + r2 * k[2]));
    let below = 1.0 + r2 * (k[3] + r2 * (k[4] + r2 * k[5]));
    let above_by_r2 = k[0] + r2 * (2.0 * k[1] + 3.0 * r2 * k[2]);
    let below_by_r2 = k[3] + r2 * (2.0 * k[4] + 3.0 * r2 * k[5]);
    let c = above / below;
    let c_by_r2 = (above_by_r2 - c * below_by_r2) / below;
    let shift = Vector2::new(
        2.0 * p[0] * x * y + p[1] * (r2 + 2.0 * x * x),
        p[0] * (r2 + 2.0 * y * y) + 2.0 * p[1] * x * y,
    );
    let mixed = 2.0 * (p[0] * x + p[1] * y);
    let tangential = Matrix2::new(
        2.0 * p[0] * y + 6.0 * p[1] * x,
        mixed,
        mixed,
        6.0 * p[0] * y + 2.0 * p[1] * x,
    );
    let jacobian = Matrix2::identity() * c + at * at.transpose() * (2.0 * c_by_r2) + tangential;
    (at * c + shift, jacobian)
}

/// The point that is distorted to `seen`, by Newton's method from `seen` on.
fn newton(k: &[f64; 6], p: &[f64; 2], seen: &Vector2<f64>) -> Option<Vector2<f64>> {
    let mut at = *seen;
    for _ in 0..STEPS {
        let (bent, jacobian) = radial_tangential(k, p, &at);
        let step = jacobian.try_inverse()? * (seen - bent);
        at += step;
        if step.norm() < CONVERGED {
            // a lens that folds over shows the point on its wrong side
            let unfolded = radial_tangential(k, p, &at).1.determinant() > 0.0;
            return unfolded.then_some(at);
        }
    }
    None
}

/// `theta_d` and its derivative by `theta`.
fn bent_angle(k: &[f64; 4], theta: f64) -> (f64, f64) {
    let t2 = theta * theta;
    let bent = theta * (1.0 + t2 * (k[0] + t2 * (k[1] + t2 * (k[2] + t2 * k[3]))));
    let slope = 1.0 + t2 * (3.0 * k[0] + t2 * (5.0 * k[1] + t2 * (7.0 * k[2] + t2 * 9.0 * k[3])));
    (bent, slope)
}

fn straight_angle(k: &[f64; 4], bent: f64) -> Option<f64> {
    let mut theta = bent;
    for _ in 0..STEPS {
        let (value, slope) = bent_angle(k, theta);
        if slope <= 0.0 {
            return None;
        }
        let step = (bent - value) / slope;
        theta += step;
        if step.abs() < CONVERGED {
            return Some(theta);
        }
    }
    None
}

impl CameraCalibration {
    /// The model of the camera where it sits: `lever` from the IMU in body axes, `c_bc` from camera axes to body axes.
    #[must_use]
    pub fn mounted(&self, lever: Body, c_bc: Matrix3<f64>, pixel_std: f64) -> CameraModel {
        let CameraCalibration { focal, centre, size, .. } = *self;
        CameraModel { lever, c_bc, focal, centre, size, pixel_std }
    }

    /// Where a pinhole without this lens sees what is seen at `pixel`, px.
    #[must_use]
    pub fn undistort(&self, pixel: &Vector2<f64>) -> Option<Vector2<f64>> {
        let ray = self.ray(pixel)?;
        Some(self.centre + self.focal.component_mul(&ray.xy()))
    }

    /// The direction that is seen at `pixel`: camera axes, a vector with `z` of one.
    #[must_use]
    pub fn ray(&self, pixel: &Vector2<f64>) -> Option<Vector3<f64>> {
        let on_plane = (pixel - self.centre).component_div(&self.focal);
        self.lens.undistort(&on_plane).map(|x| x.push(1.0))
    }

    /// The pixel that sees a direction (camera axes); `None` behind the camera.
    #[must_use]
    pub fn pixel(&self, direction: &Vector3<f64>) -> Option<Vector2<f64>> {
        if direction.z <= 0.0 {
            return None;
        }
        let bent = self.lens.distort(&(direction.xy() / direction.z));
        Some(self.centre + self.focal.component_mul(&bent))
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    use super::*;

    const BENT: Lens =
        Lens::RadialTangential { k: [-0.28, 0.07, 0.0, 0.0, 0.0, 0.0], p: [2e-4, 2e-5] };
    const FISHEYE: Lens = Lens::Equidistant { k: [-0.01, 0.02, -0.01, 0.002] };

    #[test]
    fn opencv_distorts_the_same_point_to_the_same_place() {
        // by hand from the formula: x = 0.3, y = -0.2, r2 = 0.13
        let seen = BENT.distort(&Vector2::new(0.3, -0.2));
        assert_relative_eq!(seen.x, 0.289_417_1, epsilon = 1e-7);
        assert_relative_eq!(seen.y, -0.192_917_0, epsilon = 1e-7);
    }

    #[test]
    fn a_straight_fisheye_shows_angles() {
        let seen = Lens::Equidistant { k: [0.0; 4] }.distort(&Vector2::new(1.0, 0.0));
        assert_relative_eq!(seen.x, std::f64::consts::FRAC_PI_4, epsilon = 1e-12);
    }

    #[test]
    fn the_derivative_agrees_with_perturbed_points() {
        let (k, p) = ([-0.2, 0.05, 0.01, 0.02, -0.01, 0.003], [1e-3, -2e-3]);
        let at = Vector2::new(0.4, -0.3);
        let (_, jacobian) = radial_tangential(&k, &p, &at);
        for axis in 0..2 {
            let step = Vector2::ith(axis, 1e-6);
            let [ahead, behind] = [at + step, at - step].map(|x| radial_tangential(&k, &p, &x).0);
            assert_relative_eq!(
                (ahead - behind) / 2e-6,
                jacobian.column(axis).into_owned(),
                epsilon = 1e-8
            );
        }
    }

    #[test]
    fn a_point_beyond_the_fold_of_a_lens_is_told_as_none() {
        let folds = Lens::RadialTangential { k: [-0.28, 0.0, 0.0, 0.0, 0.0, 0.0], p: [0.0; 2] };
        assert_eq!(folds.undistort(&Vector2::new(0.9, 0.0)), None);
        assert_eq!(FISHEYE.undistort(&Vector2::new(2.5, 0.0)), None);
    }

    proptest! {
        #[test]
        fn what_is_distorted_is_undistorted_again(x in -0.7..0.7_f64, y in -0.5..0.5_f64) {
            for lens in [Lens::STRAIGHT, BENT, FISHEYE] {
                let at = Vector2::new(x, y);
                let back = lens.undistort(&lens.distort(&at)).unwrap();
                prop_assert!((back - at).norm() < 1e-9, "{lens:?}: {back:?}");
            }
        }
    }
}
