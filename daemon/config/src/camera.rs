//! A camera: `[camera]`, how it looks at the world.

use std::path::PathBuf;

use insd_base::units::DEG;
use insd_base::{Body, CameraModel};
use insd_nav::config::{CameraAid, OdometryModel};
use nalgebra::{Matrix3, Rotation3, Vector2};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Error of an image point where nobody says, px.
const PIXEL_STD: f64 = 1.0;

/// A camera whose front end is a sensor of kind `camera`. Camera axes: x right in the image, y down, z along the optical axis.
#[derive(Clone, Debug, PartialEq, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CameraSection {
    /// Name of the `[[sensor]]` of kind `camera` that tells what it sees.
    pub sensor: String,
    /// Where it sits, from the IMU: forward, starboard, down, m.
    pub lever_m: [f64; 3],
    /// How it is turned from one that looks ahead and level: clockwise, up, to starboard, deg.
    pub mounting_deg: Option<[f64; 3]>,
    /// The same as a rotation from camera axes to forward, starboard, down, instead.
    pub rotation_body_from_camera: Option<[[f64; 3]; 3]>,
    /// Its intrinsics, px: `[[fx, 0, cx], [0, fy, cy], [0, 0, 1]]`, of points without the distortion of the lens.
    pub k: [[f64; 3]; 3],
    /// Width and height of its images, px.
    pub size_px: [u32; 2],
    /// Error of an image point, 1-sigma of each axis, px.
    pub pixel_std: Option<f64>,
    /// How well it is known how it sits, 1-sigma, deg.
    pub axes_std_deg: Option<f64>,
    /// By how much its images may be taken later than they are stamped, beyond `latency_s` of the sensor, 1-sigma, s.
    pub delay_std_s: Option<f64>,
    /// A picture of what it sees, PNG or JPEG, that its front end writes anew again and again: shown on the page to who asks for it.
    pub picture: Option<PathBuf>,
    /// What of it is used.
    #[serde(default, rename = "use")]
    pub way: CameraTold,
    /// Of increments: by how much the scale of a map is other than one, 1-sigma, ratio.
    pub log_scale_std: Option<f64>,
    /// By what it wanders, ratio per root of a second.
    pub log_scale_walk_sqrt_s: Option<f64>,
}

/// What of a camera is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CameraTold {
    /// Tracks of its points (PINSD,TRK).
    #[default]
    Tracks,
    /// How it moved from image to image, by a visual odometry (PINSD,VO).
    Increments,
}

/// A key, and what was expected of it.
pub type CameraFault = (&'static str, &'static str);

impl CameraSection {
    /// The camera as an aid.
    ///
    /// # Errors
    /// Which key is no camera's, and what was expected.
    pub fn aid(&self) -> Result<CameraAid, CameraFault> {
        let [forward, starboard, down] = self.lever_m;
        if !self.lever_m.iter().all(|length| length.abs() <= 1000.0) {
            return Err(("lever_m", "[forward, starboard, down] in m, each within +-1000"));
        }
        let k = rows(&self.k);
        if !(k[(0, 0)] > 0.0 && k[(1, 1)] > 0.0 && k.iter().all(|x| x.is_finite())) {
            return Err(("k", "[[fx, 0, cx], [0, fy, cy], [0, 0, 1]] with fx and fy above zero"));
        }
        if self.size_px.contains(&0) {
            return Err(("size_px", "width and height, above zero"));
        }
        if self.picture.as_ref().is_some_and(|path| !path.is_absolute()) {
            return Err(("picture", "the whole path of a file, from / on"));
        }
        self.look_at_sigmas()?;
        let model = CameraModel {
            lever: Body::new(forward, starboard, down),
            c_bc: self.c_bc()?,
            focal: Vector2::new(k[(0, 0)], k[(1, 1)]),
            centre: Vector2::new(k[(0, 2)], k[(1, 2)]),
            size: self.size_px,
            pixel_std: self.pixel_std.unwrap_or(PIXEL_STD),
        };
        let usual = CameraAid::new(model);
        Ok(CameraAid {
            axes_std: self.axes_std_deg.map_or(usual.axes_std, |std| std * DEG),
            delay_std: self.delay_std_s.unwrap_or(usual.delay_std),
            odometry: (self.way == CameraTold::Increments).then(|| self.odometry()),
            ..usual
        })
    }

    /// From camera axes to body axes.
    fn c_bc(&self) -> Result<Matrix3<f64>, CameraFault> {
        let given = self.rotation_body_from_camera.as_ref().map(rows);
        let turned = self.mounting_deg.map(|[roll, pitch, yaw]| {
            let ahead = Matrix3::new(0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0);
            Rotation3::from_euler_angles(roll * DEG, pitch * DEG, yaw * DEG).into_inner() * ahead
        });
        match (given, turned) {
            (Some(c_bc), None) => {
                let is_orthogonal = (c_bc.transpose() * c_bc - Matrix3::identity()).amax() < 1e-3;
                let expected = "a rotation, rows of three numbers";
                let is_rotation = is_orthogonal && c_bc.determinant() > 0.0;
                is_rotation.then_some(c_bc).ok_or(("rotation_body_from_camera", expected))
            }
            (None, Some(c_bc)) => {
                let is_finite = c_bc.iter().all(|x| x.is_finite());
                is_finite.then_some(c_bc).ok_or(("mounting_deg", "three angles"))
            }
            _ => Err(("mounting_deg", "either this or rotation_body_from_camera")),
        }
    }

    fn look_at_sigmas(&self) -> Result<(), CameraFault> {
        let sigmas = [
            ("pixel_std", self.pixel_std),
            ("axes_std_deg", self.axes_std_deg),
            ("delay_std_s", self.delay_std_s),
            ("log_scale_std", self.log_scale_std),
            ("log_scale_walk_sqrt_s", self.log_scale_walk_sqrt_s),
        ];
        let is_none = |std: &f64| !(*std > 0.0 && std.is_finite());
        let wrong = sigmas.into_iter().find(|(_, std)| std.as_ref().is_some_and(is_none));
        wrong.map_or(Ok(()), |(key, _)| Err((key, "a number above zero")))
    }

    /// Its visual odometry. The logarithm of a scale is off by what the scale is, as a ratio, to the first order.
    fn odometry(&self) -> OdometryModel {
        let usual = OdometryModel::default();
        OdometryModel {
            scale_std: self.log_scale_std.unwrap_or(usual.scale_std),
            scale_walk: self.log_scale_walk_sqrt_s.unwrap_or(usual.scale_walk),
        }
    }
}

fn rows(m: &[[f64; 3]; 3]) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| m[i][j])
}
