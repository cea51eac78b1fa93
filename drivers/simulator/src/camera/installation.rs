//! A camera as it was put up.

use crate::random::{Purpose, normal, normal3, stream};
use crate::scenario::Camera;

/// The camera with the errors of its mounting and of its clock in the voyage of a seed.
pub(crate) fn installed(camera: &Camera, seed: u64) -> Camera {
    let mut rng = stream(seed, Purpose::CameraMounting);
    let turn = normal3(&mut rng) * camera.mounting_std_deg;
    let late = normal(&mut rng) * camera.time_offset_std_s;
    let told = camera.mounting_error_deg;
    Camera {
        mounting_error_deg: [0, 1, 2].map(|axis| told[axis] + turn[axis]),
        time_offset_s: camera.time_offset_s + late,
        ..camera.clone()
    }
}
