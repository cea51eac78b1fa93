//! How noisy phases are: what they leave when the way of the antenna between two epochs some seconds apart is worked out of them alone.
//!
//! The budget of a receiver tells how its own noise is; what ship, hand and quay reflect goes round with the antenna and is found in the data alone.

use std::collections::VecDeque;

use insd_base::satellites::ArcPhase;
use insd_base::{BroadcastRecord, GpsTime, SatelliteId};
use nalgebra::Vector3;

use super::change::PhaseChange;
use super::displacement::CarrierDisplacement;
use crate::sight::Sight;

/// Epochs are held against those so long before, s: reflections last for seconds.
const APART: f64 = 4.0;
/// No epochs farther apart are, s: what is not noise would count.
const FARTHEST: f64 = 8.0;
/// So often, s.
const EVERY: f64 = 1.0;
/// So long it is remembered, s.
const MEMORY: f64 = 30.0;
/// No look shows more than so many times what is known: most of a few satellites may be reflected for a moment.
const RISE: f64 = 4.0;
/// What is known beforehand counts as so many residuals.
const PRIOR: f64 = 20.0;
/// For so long a reflection stays what it is, s.
const LASTS: f64 = 2.0;

/// A phase at an epoch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tracked {
    pub(super) satellite: SatelliteId,
    pub(super) record: BroadcastRecord,
    pub(super) sight: Sight,
    pub(super) phase: ArcPhase,
}

#[derive(Clone, Debug)]
struct Epoch {
    tag: GpsTime,
    antenna: Vector3<f64>,
    phases: Vec<Tracked>,
}

/// What phases scatter by, in terms of the variance that they are taken to have.
#[derive(Clone, Debug, Default)]
pub(super) struct Scatter {
    earlier: VecDeque<Epoch>,
    looked: Option<GpsTime>,
    squares: f64,
    freedoms: f64,
}

impl Scatter {
    /// By how much the variance of a phase is to be multiplied in an epoch so long after the one before, s, if there is one, where all are used as if their
    /// errors were independent: reflections go on from one to the next.
    pub(super) fn repeated(&self, elapsed: Option<f64>) -> f64 {
        let goes_on = elapsed.map_or(0.0, |elapsed| (-elapsed / LASTS).exp());
        let new = (1.0 - goes_on).max(1e-3) / (1.0 + goes_on);
        1.0 + (self.ratio() - 1.0) / new
    }

    /// By how much the variance of a phase of one epoch is to be multiplied.
    pub(super) fn ratio(&self) -> f64 {
        ((self.squares + PRIOR) / (self.freedoms + PRIOR)).max(1.0)
    }

    /// Whether an epoch is to be taken: not every one of those that are close together.
    pub(super) fn is_due(&self, tag: GpsTime) -> bool {
        let since = |before: GpsTime| tag.since(before).as_seconds();
        self.earlier.back().is_none_or(|last| !(0.0..EVERY).contains(&since(last.tag)))
    }

    /// Takes an epoch with the antenna at about this place, ECEF, m.
    pub(super) fn hear(&mut self, tag: GpsTime, antenna: &Vector3<f64>, phases: Vec<Tracked>) {
        let since = |before: GpsTime| tag.since(before).as_seconds();
        self.earlier.retain(|epoch| (0.0..FARTHEST).contains(&since(epoch.tag)));
        let before = self.earlier.iter().rfind(|epoch| since(epoch.tag) >= APART);
        if let Some(before) = before {
            let changes = changes(&before.phases, &phases);
            let moved = CarrierDisplacement::solve(&changes, &before.antenna);
            if let Some(moved) = moved.filter(|moved| moved.residuals.len() > 4) {
                let kept = (-self.looked.map_or(0.0, since) / MEMORY).exp();
                let freedoms = moved.residuals.len() as f64 - 4.0;
                let shown = variance(moved.residuals).min(RISE * self.ratio());
                self.squares = self.squares * kept + freedoms * shown;
                self.freedoms = self.freedoms * kept + freedoms;
                self.looked = Some(tag);
            }
        }
        self.earlier.push_back(Epoch { tag, antenna: *antenna, phases });
    }
}

/// Of residuals of a solution with four unknowns, by their median, as some of them may be of reflected satellites.
fn variance(mut residuals: Vec<f64>) -> f64 {
    /// Median of the square of a Gaussian variable.
    const MEDIAN: f64 = 0.454_936;
    let count = residuals.len();
    residuals.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
    let (low, high) = (residuals[(count - 1) / 2], residuals[count / 2]);
    let median = 0.5 * (low * low + high * high);
    median / MEDIAN * count as f64 / (count as f64 - 4.0)
}

/// Of satellites whose phase and orbit went on from one epoch to another.
fn changes(before: &[Tracked], now: &[Tracked]) -> Vec<PhaseChange> {
    let change = |now: &Tracked| {
        let before = before.iter().find(|before| {
            before.satellite == now.satellite
                && before.phase.arc == now.phase.arc
                && before.record == now.record
        })?;
        Some(PhaseChange {
            satellite: now.satellite,
            before: before.sight,
            now: now.sight,
            change: now.phase.phase.value - before.phase.phase.value,
            variance: now.phase.phase.variance + before.phase.phase.variance,
        })
    };
    now.iter().filter_map(change).collect()
}
