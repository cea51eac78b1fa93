//! What is learnt of gaps of one length.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// What is learnt of gaps of one length.
#[derive(Clone, Copy, Debug, PartialEq, Default, Serialize, Deserialize)]
pub(super) struct Lag {
    /// Gaps that were made up.
    count: u32,
    /// Means of the truth times the rates on both sides over the mean, and times the slope before.
    pub(super) cross: [Vector3<f64>; 2],
    /// Mean square of the rates, of both together, of the slope, each times the length.
    pub(super) ends: Vector3<f64>,
    pub(super) both: Vector3<f64>,
    pub(super) slope: Vector3<f64>,
    /// Mean square of the change of the rate from one side to the other.
    pub(super) change: Vector3<f64>,
    /// Mean square of the error.
    pub(super) error: Vector3<f64>,
}

/// What is seen of one quantity on both sides of a gap.
#[derive(Clone, Copy)]
pub(super) struct Sides {
    pub(super) length: f64,
    pub(super) before: Vector3<f64>,
    pub(super) after: Vector3<f64>,
    pub(super) slope: Vector3<f64>,
    pub(super) mean: Vector3<f64>,
}

impl Sides {
    /// What the rates differ from the mean by, times the length.
    pub(super) fn ends(&self) -> Vector3<f64> {
        ((self.before + self.after) * 0.5 - self.mean) * self.length
    }
}

/// Spacing of made-up gaps, s; the shortest of them.
pub(super) const TICK: f64 = 0.25;
/// Lengths of gaps that are made up, in ticks: two in each octave, up to 32 s.
pub(super) const LENGTHS: [u32; LAGS] = [1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128];
pub(super) const LAGS: usize = 14;
/// Time over which it is learnt, s, or so many of its own lengths: a turn brings other waves within a
/// minute, and of long gaps there are few.
const MEMORY: f64 = 60.0;
const TIMES: f64 = 8.0;
/// Errors of made-up gaps closer together than this have much in common, s.
const ALIKE: f64 = 4.0;
/// Independent gaps that must have been seen.
const SEEN: f64 = 4.0;
/// Within this time the motion of a ship goes on nearly evenly, s.
pub(super) const WAVE: f64 = 2.0;
/// Share of the power of the motion that is taken as noise of what is seen of it at its ends.
const NOISE: f64 = 0.003;

impl Lag {
    pub(super) fn learn(
        &mut self,
        index: usize,
        sides: &Sides,
        truth: &Vector3<f64>,
        made_up: &Vector3<f64>,
    ) {
        let (ends, slope) = (sides.ends(), sides.slope * sides.length);
        let (beside, error) = (truth - sides.mean * sides.length, truth - made_up);
        let change = sides.after - sides.before;
        self.count = self.count.saturating_add(1);
        let share = (1.0 / f64::from(self.count)).max(TICK / memory(index));
        let average = |mean: &mut Vector3<f64>, a: &Vector3<f64>, b: &Vector3<f64>| {
            *mean += (a.component_mul(b) - *mean) * share;
        };
        average(&mut self.cross[0], &ends, &beside);
        average(&mut self.cross[1], &slope, &beside);
        average(&mut self.ends, &ends, &ends);
        average(&mut self.both, &ends, &slope);
        average(&mut self.slope, &slope, &slope);
        average(&mut self.change, &change, &change);
        average(&mut self.error, &error, &error);
    }

    /// The shares by least squares, each with a little noise on what is seen.
    pub(super) fn shares(&self, index: usize) -> [Vector3<f64>; 2] {
        let length = length_of(index);
        if !self.is_learnt(index) {
            return [Vector3::repeat((WAVE / length).min(1.0)), Vector3::zeros()];
        }
        let [mut by_ends, mut by_slope] = [Vector3::zeros(); 2];
        for axis in 0..3 {
            let power = self.ends[axis] + 0.25 * length * length * self.change[axis];
            let (a, d) = (self.ends[axis] + NOISE * power, self.slope[axis] * (1.0 + NOISE));
            let (b, (x, y)) = (self.both[axis], (self.cross[0][axis], self.cross[1][axis]));
            let determinant = a * d - b * b;
            if determinant > 0.0 {
                by_ends[axis] = (d * x - b * y) / determinant;
                by_slope[axis] = (a * y - b * x) / determinant;
            }
        }
        [by_ends, by_slope]
    }

    /// Gaps seen that had little in common.
    pub(super) fn independent(&self, index: usize) -> f64 {
        (f64::from(self.count) * TICK).min(memory(index)) / length_of(index).max(ALIKE)
    }

    pub(super) fn is_learnt(&self, index: usize) -> bool {
        self.independent(index) >= SEEN
    }
}

/// Time over which gaps of a length are learnt, s.
fn memory(index: usize) -> f64 {
    MEMORY.max(TIMES * length_of(index))
}

pub(super) fn length_of(index: usize) -> f64 {
    LENGTHS.get(index).map_or(0.0, |ticks| TICK * f64::from(*ticks))
}

/// The made-up length below a length, and how far it is to the next on a logarithmic scale, 0..1.
pub(super) fn place_of(length: f64) -> (usize, f64) {
    let above = (1..LAGS - 1).find(|index| length_of(*index) > length).unwrap_or(LAGS - 1);
    let (low, high) = (length_of(above - 1), length_of(above));
    let along = (length / low).ln() / (high / low).ln();
    (above - 1, along.clamp(0.0, 1.0))
}
