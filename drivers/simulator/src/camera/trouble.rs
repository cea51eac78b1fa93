//! What is wrong with the camera, and before it, at a time.

use nalgebra::{Vector2, Vector3};
use rand_pcg::Pcg64;

use super::view::{Rig, View};
use crate::random::uniform;
use crate::scenario::{Camera, CameraFault};

/// A ship that passes: how fast, how long beside what keeps her in view, how high, and how far away at least and at most, m/s and m.
const SPEED: f64 = 1.5;
const LENGTH: f64 = 40.0;
const HEIGHT: f64 = 10.0;
const RANGE: [f64; 2] = [8.0, 60.0];
/// Then comes the next one, s.
const PASSAGE: f64 = 60.0;

/// A wet lens makes errors so many times as large.
const BLUR: f64 = 4.0;

/// A ship that passes: an upright face that moves along itself.
#[derive(Clone, Copy, Debug)]
pub(super) struct PassingShip {
    /// Its middle at the time `at`, at the water, axes of the quay, m.
    middle: Vector3<f64>,
    at: f64,
    /// Where it goes, m/s.
    pub(super) velocity: Vector3<f64>,
    length: f64,
    /// When the next one comes, s.
    end: f64,
}

impl PassingShip {
    /// One after the other as long as a fault lasts in a voyage of `duration`, s.
    fn all(fault: &CameraFault, rig: &Rig<'_>, duration: f64) -> Vec<Self> {
        let end = fault.t1_s.unwrap_or(duration).min(duration);
        let count = ((end - fault.t0_s) / PASSAGE).ceil().max(1.0) as u32;
        let begin = |number: u32| fault.t0_s + f64::from(number) * PASSAGE;
        (0..count).map(|own| Self::new([begin(own), begin(own + 1).min(end)], rig)).collect()
    }

    /// One that is in the middle of the image in the middle of a span of time.
    fn new([begin, end]: [f64; 2], rig: &Rig<'_>) -> Self {
        let at = f64::midpoint(begin, end);
        let view = rig.view(at);
        let level = |axis: usize| {
            let axis = view.c_qc.column(axis);
            Vector3::new(axis.x, axis.y, 0.0).try_normalize(1e-6).unwrap_or_else(Vector3::x)
        };
        let (right, ahead) = (level(0), level(2));
        // between the camera and the quay
        let to_quay = if ahead.y > 0.1 { -view.place.y / ahead.y } else { f64::INFINITY };
        let range = (to_quay / 2.0).clamp(RANGE[0], RANGE[1]);
        let middle = view.place + ahead * range;
        PassingShip {
            middle: Vector3::new(middle.x, middle.y, 0.0),
            at,
            velocity: right * SPEED,
            length: LENGTH + SPEED * (end - begin),
            end,
        }
    }

    /// A point of the hull at time `t`, s, that is seen at a place in the image, axes of the quay, m.
    pub(super) fn point(&self, t: f64, view: &View, at: &Vector2<f64>) -> Option<Vector3<f64>> {
        let along = self.velocity / SPEED;
        let normal = along.cross(&Vector3::z());
        let direction = view.direction(at);
        let middle = self.middle + self.velocity * (t - self.at);
        let share = normal.dot(&(middle - view.place)) / normal.dot(&direction);
        let point = view.place + direction * share;
        let is_hull = (point - middle).dot(&along).abs() < self.length / 2.0;
        (share > 0.0 && is_hull && (0.0..HEIGHT).contains(&point.z)).then_some(point)
    }
}

/// What is wrong at one time.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Trouble<'a> {
    pub(super) is_blinded: bool,
    pub(super) is_frozen: bool,
    /// Nothing but water is seen.
    pub(super) is_water: bool,
    pub(super) is_noise: bool,
    /// Which share of the points are drops.
    pub(super) drops: f64,
    /// Which share of the points are on a ship that passes.
    pub(super) on_ship: f64,
    pub(super) ship: Option<&'a PassingShip>,
}

impl Trouble<'_> {
    /// How many times as large errors are as through a dry lens.
    pub(super) fn blur(&self) -> f64 {
        if self.drops > 0.0 { BLUR } else { 1.0 }
    }
}

/// All that goes wrong in a voyage.
#[derive(Clone, Debug)]
pub(super) struct Troubles {
    faults: Vec<(CameraFault, Vec<PassingShip>)>,
}

impl Troubles {
    pub(super) fn new(camera: &Camera, rig: &Rig<'_>, duration: f64) -> Self {
        let of = |fault: &CameraFault| {
            let ships = fault.ship_passing.map(|_| PassingShip::all(fault, rig, duration));
            (*fault, ships.unwrap_or_default())
        };
        Troubles { faults: camera.fault.iter().map(of).collect() }
    }

    /// What is wrong at time `t`, s.
    pub(super) fn at(&self, t: f64) -> Trouble<'_> {
        let mut trouble = Trouble::default();
        for (fault, ships) in self.faults.iter().filter(|(fault, _)| fault.holds(t)) {
            trouble.is_blinded |= fault.blinded;
            trouble.is_frozen |= fault.frozen;
            trouble.is_water |= fault.water;
            trouble.is_noise |= fault.noise;
            trouble.drops = trouble.drops.max(fault.wet_lens.unwrap_or(0.0));
            if let Some(share) = fault.ship_passing {
                let now = ships.iter().find(|ship| t < ship.end).or(ships.last());
                (trouble.on_ship, trouble.ship) = (share, now);
            }
        }
        trouble
    }
}

/// Anywhere in the image, px.
pub(super) fn anywhere(view: &View, rng: &mut Pcg64) -> Vector2<f64> {
    let [width, height] = view.size();
    Vector2::new(uniform(rng, 0.0, width), uniform(rng, 0.0, height))
}
