//! What a camera makes of a voyage, as it is handed out.

use insd_base::{CameraFrame, VisualOdometry};
use serde::Serialize;

use super::view::told_mounting;
use crate::scenario::{Camera, CameraFault};

/// What a voyage says of its camera: the `[camera]` table of `voyage.toml`, whose keys and units these are.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FootageSpec {
    /// From the IMU, body axes.
    pub lever_arm_m: [f64; 3],
    /// Camera axes (right, down, along the optical axis) to body axes, row by row, as it is told.
    pub rotation_body_from_camera: [[f64; 3]; 3],
    /// Focal lengths and centre, as computer vision writes them.
    pub k: [[f64; 3]; 3],
    /// Width and height of the image.
    pub size_px: [u32; 2],
    /// White noise of a point, 1-sigma of each axis.
    pub pixel_std: f64,
    /// Logarithm of the scale of a map, 1-sigma.
    pub log_scale_std: f64,
    /// Its random walk.
    pub log_scale_walk_sqrt_s: f64,
}

impl FootageSpec {
    /// What a scenario says of it.
    pub(super) fn of(camera: &Camera) -> Self {
        let (focal, [width, height]) = (camera.focal_px, camera.size_px.map(f64::from));
        let mounting = told_mounting(camera);
        FootageSpec {
            lever_arm_m: camera.lever_arm_m,
            rotation_body_from_camera: [0, 1, 2]
                .map(|row| [0, 1, 2].map(|column| mounting[(row, column)])),
            k: [[focal, 0.0, width / 2.0], [0.0, focal, height / 2.0], [0.0, 0.0, 1.0]],
            size_px: camera.size_px,
            pixel_std: camera.pixel_std,
            log_scale_std: camera.log_scale_std,
            log_scale_walk_sqrt_s: camera.log_scale_walk_sqrt_s,
        }
    }
}

/// What a camera makes of a voyage.
#[derive(Clone, Debug, PartialEq)]
pub struct Footage {
    /// What is known of the camera.
    pub spec: FootageSpec,
    /// Its images.
    pub frames: Vec<CameraFrame>,
    /// What a visual odometry makes of them, from keyframe to keyframe.
    pub odometry: Vec<VisualOdometry>,
    /// Interval of its keyframes, s; the first is one interval after the start.
    pub keyframe_interval: f64,
}

/// What was wrong with the camera; t0 <= t < t1, s.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct InjectedCameraFault {
    /// Key of its kind in the scenario.
    pub kind: &'static str,
    /// Beginning, s.
    pub t0_s: f64,
    /// End, excluded, s.
    pub t1_s: f64,
    /// Its size, in the unit of its key, where it has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub size: Option<f64>,
}

/// What nobody on board is told of the camera: for those who judge.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FootageTruth {
    /// How it is turned from where it is said to look, about forward, starboard and down.
    pub mounting_error_deg: [f64; 3],
    /// An image was taken so much later than is said.
    pub time_offset_s: f64,
    /// Faults.
    pub faults: Vec<InjectedCameraFault>,
}

/// What was done to a camera in a voyage of `duration`, s.
pub(crate) fn truth(camera: &Camera, duration: f64) -> FootageTruth {
    let injected = |fault: &CameraFault| InjectedCameraFault {
        kind: fault.kind(),
        t0_s: fault.t0_s,
        t1_s: fault.t1_s.unwrap_or(duration).min(duration),
        size: fault.size(),
    };
    FootageTruth {
        mounting_error_deg: camera.mounting_error_deg,
        time_offset_s: camera.time_offset_s,
        faults: camera.fault.iter().map(injected).collect(),
    }
}
