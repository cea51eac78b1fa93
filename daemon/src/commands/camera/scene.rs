//! The newest image of a camera with what was made of it drawn over it.

use std::collections::BTreeMap;

use insd_capture::{Sketch, TimedImage};
use insd_vision::{CameraCalibration, Hints, Tracked};
use nalgebra::{Unit, Vector3};

/// What is drawn of the way of a track, images.
const TRAIL: usize = 10;
const GREEN: [u8; 3] = [60, 230, 90];
const YELLOW: [u8; 3] = [250, 220, 60];
const RED: [u8; 3] = [255, 70, 70];

/// The newest image that was used, and how its points came to where they are.
#[derive(Default)]
pub(super) struct Scene {
    image: Option<TimedImage>,
    down: Option<Unit<Vector3<f64>>>,
    trails: BTreeMap<u64, Vec<[f64; 2]>>,
}

impl Scene {
    /// Takes in an image with the points that were followed into it.
    pub(super) fn add(&mut self, image: TimedImage, tracked: &Tracked, hints: &Hints) {
        let mut before = std::mem::take(&mut self.trails);
        for track in &tracked.seen {
            let mut trail = before.remove(&track.id).unwrap_or_default();
            trail.push(track.at.map(f64::from));
            let too_old = trail.len().saturating_sub(TRAIL);
            trail.drain(..too_old);
            self.trails.insert(track.id, trail);
        }
        (self.image, self.down) = (Some(image), hints.down);
    }

    /// The newest image with the way of each point and the horizon; `None` before the first.
    pub(super) fn draw(&self, camera: &CameraCalibration) -> Option<Sketch> {
        let image = self.image.as_ref()?;
        let mut sketch = Sketch::over(image.size, &image.pixels);
        for trail in self.trails.values() {
            trail.windows(2).for_each(|step| sketch.line(step[0], step[1], GREEN));
            let colour = if trail.len() > 1 { GREEN } else { YELLOW };
            trail.last().into_iter().for_each(|at| sketch.cross(*at, colour));
        }
        let horizon = self.down.map(|down| horizon(camera, &down)).unwrap_or_default();
        horizon.windows(2).for_each(|step| sketch.line(step[0], step[1], RED));
        Some(sketch)
    }
}

/// Where the horizon is seen, px: level directions from 80 deg to the left of where the camera looks to 80 deg to the right.
fn horizon(camera: &CameraCalibration, down: &Unit<Vector3<f64>>) -> Vec<[f64; 2]> {
    let axis = Vector3::z();
    let Some(ahead) = Unit::try_new(axis - down.into_inner() * down.dot(&axis), 1e-6) else {
        return Vec::new();
    };
    let right = down.cross(&ahead);
    let direction = |degrees: i32| {
        let (sin, cos) = f64::from(degrees).to_radians().sin_cos();
        ahead.into_inner() * cos + right * sin
    };
    let pixels = (-80..=80).filter_map(|degrees| camera.pixel(&direction(degrees)));
    pixels.map(|pixel| [pixel.x, pixel.y]).collect()
}

#[cfg(test)]
mod tests {
    use insd_vision::Lens;
    use nalgebra::Vector2;

    use super::*;

    #[test]
    fn a_level_camera_sees_the_horizon_at_its_middle() {
        let (focal, centre) = (Vector2::new(500.0, 500.0), Vector2::new(320.0, 240.0));
        let camera = CameraCalibration { focal, centre, size: [640, 480], lens: Lens::STRAIGHT };
        let level = horizon(&camera, &Vector3::y_axis());
        assert!(level.len() > 100 && level.iter().all(|at| (at[1] - 240.0).abs() < 1e-9));
        assert!(level[0][0] < 0.0 && level[level.len() - 1][0] > 640.0);
        assert!(horizon(&camera, &Vector3::z_axis()).is_empty());
    }
}
