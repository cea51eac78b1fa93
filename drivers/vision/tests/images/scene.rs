//! A wall of texture, seen by a pinhole that turns and moves: images with a truth.

use insd_base::Time;
use insd_vision::{CameraCalibration, CameraImage, Lens};
use nalgebra::{Isometry3, Vector2, Vector3};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// Side of the texture, px; it goes on periodically.
const SIDE: usize = 512;

/// A wall at a distance of `z = DISTANCE` of the first camera.
pub(crate) struct Wall {
    texture: Vec<f64>,
}

/// From the first camera to the wall, m.
pub(crate) const DISTANCE: f64 = 20.0;
/// Texels per metre of the wall.
const TEXELS: f64 = 30.0;

/// A camera of 320 x 240 pixels, for tests that are quick.
pub(crate) fn camera(lens: Lens) -> CameraCalibration {
    let (focal, centre) = (Vector2::new(300.0, 300.0), Vector2::new(159.5, 119.5));
    CameraCalibration { focal, centre, size: [320, 240], lens }
}

impl Wall {
    /// Blobs of all sizes, band limited so that they can be sampled.
    pub(crate) fn new(seed: u64) -> Self {
        let mut rng = Pcg64::seed_from_u64(seed);
        let mut texture = vec![110.0; SIDE * SIDE];
        for _ in 0..2500 {
            let [x, y] = [0; 2].map(|_| rng.random_range(0.0..SIDE as f64));
            let radius: f64 = rng.random_range(3.0..9.0);
            let height: f64 = rng.random_range(-60.0..60.0);
            let reach = (3.0 * radius) as i64;
            for (dy, dx) in (-reach..=reach).flat_map(|dy| (-reach..=reach).map(move |dx| (dy, dx)))
            {
                let [col, row] = [x as i64 + dx, y as i64 + dy];
                let off = Vector2::new(col as f64 - x, row as f64 - y) / radius;
                let at = wrapped(row) * SIDE + wrapped(col);
                texture[at] += height * (-off.norm_squared()).exp();
            }
        }
        Wall { texture }
    }

    fn level(&self, x: f64, y: f64) -> f64 {
        let (col, row) = (x.floor(), y.floor());
        let (fx, fy) = (x - col, y - row);
        let texel =
            |dx, dy| self.texture[wrapped(row as i64 + dy) * SIDE + wrapped(col as i64 + dx)];
        let above = texel(0, 0) * (1.0 - fx) + texel(1, 0) * fx;
        let below = texel(0, 1) * (1.0 - fx) + texel(1, 1) * fx;
        above * (1.0 - fy) + below * fy
    }

    /// What a camera sees whose pose turns its axes into those of the first one; with noise of `noise` grey levels.
    pub(crate) fn image(
        &self,
        camera: &CameraCalibration,
        pose: &Isometry3<f64>,
        noise: f64,
        rng: &mut Pcg64,
    ) -> Vec<u8> {
        let [width, height] = camera.size;
        let pixels = (0..height).flat_map(|row| (0..width).map(move |col| (col, row)));
        pixels
            .map(|(col, row)| {
                let at = Vector2::new(f64::from(col), f64::from(row));
                let level = camera.ray(&at).map_or(0.0, |ray| self.seen_along(pose, &ray));
                let noise: f64 =
                    (0..4).map(|_| rng.random_range(-1.0..1.0)).sum::<f64>() * noise * 0.87;
                (level + noise).round().clamp(0.0, 255.0) as u8
            })
            .collect()
    }

    fn seen_along(&self, pose: &Isometry3<f64>, ray: &Vector3<f64>) -> f64 {
        let on_wall = on_wall(pose, ray);
        self.level(on_wall.x * TEXELS, on_wall.y * TEXELS)
    }
}

fn wrapped(index: i64) -> usize {
    index.rem_euclid(SIDE as i64) as usize
}

/// Where a ray meets the wall, first camera's axes, m.
fn on_wall(pose: &Isometry3<f64>, ray: &Vector3<f64>) -> Vector3<f64> {
    let (origin, direction) = (pose.translation.vector, pose.rotation * ray);
    origin + direction * ((DISTANCE - origin.z) / direction.z)
}

/// Where the point of the wall that is seen at a pixel (undistorted) from one pose is seen from another.
pub(crate) fn carried(
    camera: &CameraCalibration,
    from: &Isometry3<f64>,
    to: &Isometry3<f64>,
    at: &Vector2<f64>,
) -> Vector2<f64> {
    let ray = (at - camera.centre).component_div(&camera.focal).push(1.0);
    let seen = to.inverse() * nalgebra::Point3::from(on_wall(from, &ray));
    camera.centre + camera.focal.component_mul(&(seen.coords.xy() / seen.z))
}

/// An image of these pixels at a time, s.
pub(crate) fn picture<'a>(camera: &CameraCalibration, t: f64, pixels: &'a [u8]) -> CameraImage<'a> {
    CameraImage { time: Time::from_seconds(t), size: camera.size, pixels }
}
