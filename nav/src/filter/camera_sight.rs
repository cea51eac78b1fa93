//! What the filter has of a camera, for those who look on.

use insd_base::{Body, CameraSight, Estimate};

use super::Filter;
use crate::error_state::{CAMERA_AXES, CAMERA_DELAY};

impl Filter {
    /// The camera as it is used; `None` while none of its images is.
    #[must_use]
    pub fn camera_sight(&self) -> Option<CameraSight> {
        let (nominal, p) = (&self.state.nominal, &self.state.covariance);
        if !p.has(CAMERA_AXES) {
            return None;
        }
        let (camera, odometry) = (&self.camera, &self.odometry);
        let seen = camera.last.as_ref();
        let standing = if seen.is_some() { camera.standing } else { odometry.standing };
        let held = odometry.poses.iter().flatten().count();
        Some(CameraSight {
            time: seen.map(|frame| frame.time).or(odometry.heard)?,
            points: seen.map(|frame| frame.points.len()),
            poses: if seen.is_some() { camera.window.poses.len() } else { held },
            landmarks: camera.landmarks.iter().flatten().count(),
            is_doubted: standing.is_doubted(),
            turned: Body(nominal.camera_axes),
            turned_sigma: Body(CAMERA_AXES.stds(p)),
            delay: Estimate { value: nominal.camera_delay, sigma: CAMERA_DELAY.std(p) },
        })
    }
}
