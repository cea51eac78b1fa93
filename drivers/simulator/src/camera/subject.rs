//! What a track is of.

use nalgebra::{Vector2, Vector3};
use rand_pcg::Pcg64;

use super::quay::Quay;
use super::trouble::{Trouble, anywhere};
use super::view::View;
use crate::random::{normal, uniform};

/// Water farther away shows nothing, m.
const WATER_RANGE: f64 = 150.0;
/// How fast what is seen of the water goes, all alike and each by itself, 1-sigma, m/s.
const WATER_SPEED: [f64; 2] = [1.0, 0.3];
/// Places in the image that are tried before there is no such point.
const TRIES: u32 = 30;

/// What a track is of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Subject {
    /// A point of the quay by its number.
    Fixed(usize),
    /// A drop on the lens, px.
    Drop(Vector2<f64>),
    /// Foam, glitter, small waves.
    Water(Drift),
    /// A point of a ship that passes.
    Ship(Drift),
    /// Nothing at all.
    Noise,
}

/// A point that moves: where it was at a time, s, axes of the quay, m, and its velocity, m/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Drift {
    since: f64,
    from: Vector3<f64>,
    velocity: Vector3<f64>,
}

impl Drift {
    fn at(&self, t: f64) -> Vector3<f64> {
        self.from + self.velocity * (t - self.since)
    }
}

impl Subject {
    /// Where in the image it is at time `t`, s; `None` where it is not seen.
    pub(super) fn place(
        &self,
        t: f64,
        view: &View,
        quay: &Quay,
        rng: &mut Pcg64,
    ) -> Option<Vector2<f64>> {
        match self {
            Subject::Fixed(number) => view.sees(&quay.point(*number)),
            Subject::Drop(at) => Some(*at),
            Subject::Water(drift) | Subject::Ship(drift) => view.sees(&drift.at(t)),
            Subject::Noise => Some(anywhere(view, rng)),
        }
    }

    /// Whether there is such a thing to be seen now.
    pub(super) fn is_there(&self, view: &View, quay: &Quay, trouble: &Trouble<'_>) -> bool {
        match self {
            Subject::Fixed(number) => {
                !trouble.is_water && !trouble.is_noise && quay.is_seen(*number, view)
            }
            Subject::Drop(_) => trouble.drops > 0.0,
            Subject::Water(_) => trouble.is_water,
            Subject::Ship(_) => trouble.ship.is_some(),
            Subject::Noise => trouble.is_noise,
        }
    }

    /// How often such a track is lost beside what all are: chance per second.
    pub(super) fn fading(&self) -> f64 {
        match self {
            Subject::Water(_) => 1.0,
            Subject::Noise => 3.0,
            _ => 0.0,
        }
    }

    /// Whether it is as sharp as ever through a wet lens.
    pub(super) fn is_on_lens(&self) -> bool {
        matches!(self, Subject::Drop(_))
    }
}

/// A point of the water at time `t`, s, that goes with the waves, `bearing` from the edge of the quay, rad.
pub(super) fn water(t: f64, view: &View, bearing: f64, rng: &mut Pcg64) -> Option<Subject> {
    let from = (0..TRIES).find_map(|_| {
        let direction = view.direction(&anywhere(view, rng));
        let point = view.place - direction * (view.place.z / direction.z);
        let is_near = (point - view.place).norm() < WATER_RANGE;
        (direction.z < 0.0 && is_near).then_some(point)
    })?;
    let [common, own] = WATER_SPEED;
    let (sin, cos) = bearing.sin_cos();
    let velocity =
        Vector3::new(common * cos + own * normal(rng), common * sin + own * normal(rng), 0.0);
    Some(Subject::Water(Drift { since: t, from, velocity }))
}

/// A point of the ship that passes, at time `t`, s.
pub(super) fn ship(t: f64, view: &View, trouble: &Trouble<'_>, rng: &mut Pcg64) -> Option<Subject> {
    let ship = trouble.ship?;
    let from = (0..TRIES).find_map(|_| ship.point(t, view, &anywhere(view, rng)))?;
    Some(Subject::Ship(Drift { since: t, from, velocity: ship.velocity }))
}

/// So many points of the quay that are in view and not in `taken`, at random.
pub(super) fn fixed(
    count: usize,
    taken: &[usize],
    view: &View,
    quay: &Quay,
    rng: &mut Pcg64,
) -> Vec<Subject> {
    let is_free = |number: &usize| taken.binary_search(number).is_err();
    let mut free: Vec<usize> =
        (0..quay.count()).filter(is_free).filter(|own| quay.is_seen(*own, view)).collect();
    let mut chosen = Vec::new();
    while chosen.len() < count && !free.is_empty() {
        let index = uniform(rng, 0.0, free.len() as f64) as usize;
        chosen.push(Subject::Fixed(free.swap_remove(index.min(free.len() - 1))));
    }
    chosen
}
