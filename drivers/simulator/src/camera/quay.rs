//! The quay: an upright wall, what lies about behind its edge, and buildings.

use nalgebra::Vector3;
use rand_pcg::Pcg64;

use super::axes::QuayAxes;
use super::view::View;
use crate::random::{Purpose, stream, uniform};
use crate::scenario::{CameraQuay, Scenario};
use crate::track::{Track, start_of};

/// Points on a bollard, and how high they are above the edge at most, m.
const BOLLARD: (u32, f64) = (3, 0.6);
/// The lowest points of the wall above the water, m: it is wet below.
const WET: f64 = 0.3;
/// What lies about behind the edge reaches so far back and up, m.
const CLUTTER: [f64; 2] = [30.0, 3.0];
/// Widths of buildings, m.
const WIDTH: [f64; 2] = [12.0, 45.0];
/// The quay goes on so far beyond where the ship is, m.
const BEYOND: f64 = 250.0;
/// From sample to sample of the ship's way, s.
const INTERVAL: f64 = 5.0;

/// An upright face along the quay that hides what is behind it.
#[derive(Clone, Copy, Debug)]
struct Face {
    depth: f64,
    along: [f64; 2],
    top: f64,
}

impl Face {
    fn hides(&self, from: &Vector3<f64>, point: &Vector3<f64>) -> bool {
        let share = (self.depth - from.y) / (point.y - from.y);
        if !(0.0..1.0 - 1e-9).contains(&share) {
            return false;
        }
        let at = from + (point - from) * share;
        (self.along[0]..=self.along[1]).contains(&at.x) && at.z <= self.top
    }
}

/// All that is ashore.
#[derive(Clone, Debug)]
pub(super) struct Quay {
    pub(super) axes: QuayAxes,
    range: f64,
    faces: Vec<Face>,
    /// Points that can be told from others, m.
    points: Vec<Vector3<f64>>,
}

impl Quay {
    /// The quay of the berth of a scenario, as long as the ship's way; `None` where there is none.
    pub(super) fn new(
        scenario: &Scenario,
        spec: &CameraQuay,
        track: &Track,
        seed: u64,
    ) -> Option<Self> {
        let berth = scenario.berth()?;
        let axes = QuayAxes::new(berth, start_of(scenario).height - spec.water_below_imu_m);
        let samples =
            (0..=(scenario.duration() / INTERVAL) as u32).map(|own| f64::from(own) * INTERVAL);
        let way = samples.map(|t| axes.place(&track.at(t).position).x);
        let [low, high] =
            way.fold([0.0, axes.length], |[low, high], at| [low.min(at), high.max(at)]);
        let along = [low - BEYOND, high + BEYOND];
        let wall = Face { depth: 0.0, along, top: spec.edge_m };
        let mut quay = Quay { axes, range: spec.range_m, faces: vec![wall], points: Vec::new() };
        let mut rng = stream(seed, Purpose::CameraScene);
        quay.build_edge(spec, along, &mut rng);
        for at in berth.bollards(axes.length) {
            let (count, height) = BOLLARD;
            quay.strew(count, [[at, at + 0.5], [0.5, 1.0], [0.0, height]], spec.edge_m, &mut rng);
        }
        quay.build_behind(spec, along, &mut rng);
        Some(quay)
    }

    /// The wall, and what lies about behind it.
    fn build_edge(&mut self, spec: &CameraQuay, along: [f64; 2], rng: &mut Pcg64) {
        let count = ((along[1] - along[0]) / 100.0 * spec.points_per_100_m) as u32;
        self.strew(count, [along, [0.0, 0.0], [WET, spec.edge_m]], 0.0, rng);
        let [back, up] = CLUTTER;
        self.strew(count, [along, [1.0, back], [0.0, up]], spec.edge_m, rng);
    }

    fn build_behind(&mut self, spec: &CameraQuay, along: [f64; 2], rng: &mut Pcg64) {
        let count = ((along[1] - along[0]) / 100.0 * spec.buildings_per_100_m) as u32;
        for _ in 0..count {
            let depth = uniform(rng, spec.depth_m[0], spec.depth_m[1]);
            let left = uniform(rng, along[0], along[1]);
            let right = left + uniform(rng, WIDTH[0], WIDTH[1]);
            let height = uniform(rng, spec.height_m[0], spec.height_m[1]);
            let top = spec.edge_m + height;
            self.faces.push(Face { depth, along: [left, right], top });
            let box_of = [[left, right], [depth, depth], [0.0, height]];
            self.strew(spec.points_per_building, box_of, spec.edge_m, rng);
        }
    }

    /// Strews points evenly over a box, along, landward and above a floor, m.
    fn strew(&mut self, count: u32, sides: [[f64; 2]; 3], floor: f64, rng: &mut Pcg64) {
        for _ in 0..count {
            let [along, depth, above] = sides.map(|[low, high]| uniform(rng, low, high));
            self.points.push(Vector3::new(along, depth, floor + above));
        }
    }

    /// How many points there are.
    pub(super) fn count(&self) -> usize {
        self.points.len()
    }

    /// A point by its number, axes of the quay, m.
    pub(super) fn point(&self, number: usize) -> Vector3<f64> {
        self.points[number]
    }

    /// Whether a point, by its number, is in view: within the image, near enough, and not hidden.
    pub(super) fn is_seen(&self, number: usize, view: &View) -> bool {
        let point = &self.points[number];
        view.sees(point).is_some()
            && (point - view.place).norm() <= self.range
            && !self.faces.iter().any(|face| face.hides(&view.place, point))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_face_hides_what_is_behind_it_and_below_its_top() {
        let face = Face { depth: 30.0, along: [10.0, 20.0], top: 12.0 };
        let camera = Vector3::new(15.0, -20.0, 12.0);
        let hides = |x, y, z| face.hides(&camera, &Vector3::new(x, y, z));
        assert!(hides(15.0, 60.0, 5.0));
        assert!(!hides(15.0, 60.0, 20.0), "above");
        assert!(!hides(40.0, 60.0, 5.0), "beside");
        assert!(!hides(15.0, 30.0, 5.0), "its own");
        assert!(!hides(15.0, 10.0, 5.0), "before");
    }
}
