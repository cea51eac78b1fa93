//! Ambiguities of signals that both receivers track on: states that last, with the position as one that does not.

use std::collections::BTreeSet;

use insd_base::{GpsTime, SatelliteEpoch, SatelliteId, SignalCode};
use nalgebra::{DMatrix, DVector, Vector3};

use super::difference::Difference;
use super::double::{DifferencedRows, DoubleDifferences};
use super::pairing::SignalPair;

/// Arcs are kept over an interruption of so many seconds at the most.
const LONGEST: f64 = 60.0;
/// 1-sigma of an ambiguity by one code, m; it is only where the filter begins.
const BEGIN: f64 = 30.0;
/// 1-sigma of an ambiguity's wandering by reflections, m per root of a second.
const WANDER: f64 = 3e-4;
/// How long errors of codes and phases last, s: reflections. They are counted anew only as far as they are new.
const ERRORS_LAST: f64 = 10.0;

/// A signal that is tracked.
#[derive(Clone, Copy, Debug)]
struct Arc {
    pair: SignalPair,
    locks: [Option<f64>; 2],
    is_new: bool,
}

/// Position and ambiguities (single differences, cycles) with their covariance.
#[derive(Clone, Debug, Default)]
pub(super) struct Arcs {
    tag: Option<GpsTime>,
    arcs: Vec<Arc>,
    pub(super) state: DVector<f64>,
    pub(super) covariance: DMatrix<f64>,
    /// What receivers said that they have lost since the last epoch that was used: the base's, by whom.
    lost: BTreeSet<(bool, SatelliteId, SignalCode)>,
    base: Option<GpsTime>,
    /// What the variance of a signal that goes on has to be multiplied by, so that errors that last are not averaged as if they did not.
    repeated: f64,
}

impl Arcs {
    /// Hears of losses, whether the epoch is used or not. The base's epoch may come more than once.
    pub(super) fn hear(&mut self, rover: &SatelliteEpoch, base: &SatelliteEpoch) {
        let new = self.base != Some(base.tag);
        self.base = Some(base.tag);
        for (is_base, epoch) in [(false, rover), (true, base)] {
            if is_base && !new {
                continue;
            }
            let slipped = epoch.signals.iter().filter(|own| own.slip || own.half_cycle);
            self.lost.extend(slipped.map(|own| (is_base, own.satellite, own.signal)));
        }
    }

    /// Goes on to an epoch: arcs that are not tracked on end, and new ones begin.
    pub(super) fn advance(&mut self, tag: GpsTime, differences: &DoubleDifferences) {
        let elapsed = self.tag.map_or(f64::INFINITY, |before| tag.since(before).as_seconds());
        if !(elapsed > 0.0 && elapsed < LONGEST) {
            self.arcs.clear();
        }
        self.tag = Some(tag);
        let last = (-elapsed / ERRORS_LAST).exp();
        self.repeated = (1.0 + last) / (1.0 - last);
        let before = std::mem::take(&mut self.arcs);
        let (state, covariance) = (self.state.clone(), self.covariance.clone());
        let mut sources = Vec::new();
        for single in differences.singles.iter().filter(|single| single.phase.is_some()) {
            let place = before.iter().position(|arc| arc.pair == single.pair);
            let place = place.filter(|place| self.goes_on(&before[*place], single, elapsed));
            let arc = Arc { pair: single.pair, locks: single.locks, is_new: place.is_none() };
            self.arcs.push(arc);
            sources.push((place, single.wavelength, begin(single)));
        }
        self.lost.clear();
        let size = 3 + sources.len();
        self.state = DVector::zeros(size);
        self.covariance = DMatrix::zeros(size, size);
        for (own, (place, wavelength, begin)) in sources.iter().enumerate() {
            let Some(place) = place else {
                self.state[3 + own] = *begin;
                self.covariance[(3 + own, 3 + own)] = (BEGIN / wavelength).powi(2);
                continue;
            };
            self.state[3 + own] = state[3 + place];
            for (other, (there, ..)) in sources.iter().enumerate() {
                let Some(there) = there else { continue };
                self.covariance[(3 + own, 3 + other)] = covariance[(3 + place, 3 + there)];
            }
            self.covariance[(3 + own, 3 + own)] += (WANDER / wavelength).powi(2) * elapsed;
        }
    }

    fn goes_on(&self, arc: &Arc, single: &Difference, elapsed: f64) -> bool {
        let pair = single.pair;
        let told = [(false, pair.rover), (true, pair.base)];
        let is_lost = told
            .iter()
            .any(|(is_base, signal)| self.lost.contains(&(*is_base, pair.satellite, *signal)));
        // lower bounds: they may stand, but not fall
        let kept = |(before, now): (&Option<f64>, &Option<f64>)| match (before, now) {
            (Some(before), Some(now)) => *now > 0.0 && (now >= before || *now >= elapsed),
            (None, Some(now)) => *now > 0.0,
            (_, None) => true,
        };
        !is_lost && arc.locks.iter().zip(&single.locks).all(kept)
    }

    /// The differences as they weigh for ambiguities that are carried on: of signals that go on only as far as their errors are new ones.
    pub(super) fn weighed(&self, differences: &DoubleDifferences) -> DoubleDifferences {
        let mut weighed = differences.clone();
        for single in &mut weighed.singles {
            if self.arcs.iter().any(|arc| arc.pair == single.pair && !arc.is_new) {
                single.code_variance *= self.repeated;
                single.phase_variance *= self.repeated;
            }
        }
        weighed
    }

    /// The position as it is known beforehand: not at all, or to a covariance.
    pub(super) fn place(&mut self, near: &Vector3<f64>, known: Option<nalgebra::Matrix3<f64>>) {
        const ANYWHERE: f64 = 1e3;
        self.state.fixed_rows_mut::<3>(0).copy_from(near);
        let size = self.state.len();
        self.covariance.view_mut((0, 0), (3, size)).fill(0.0);
        self.covariance.view_mut((0, 0), (size, 3)).fill(0.0);
        let covariance =
            known.unwrap_or_else(|| nalgebra::Matrix3::identity() * (ANYWHERE * ANYWHERE));
        self.covariance.fixed_view_mut::<3, 3>(0, 0).copy_from(&covariance);
    }

    /// A signal begins anew.
    pub(super) fn restart(&mut self, single: &Difference) {
        let Some(own) = self.state_of(single.pair) else { return };
        self.arcs[own - 3].is_new = true;
        self.state[own] = begin(single);
        self.covariance.row_mut(own).fill(0.0);
        self.covariance.column_mut(own).fill(0.0);
        self.covariance[(own, own)] = (BEGIN / single.wavelength).powi(2);
    }

    /// Where the ambiguity of a pair stands.
    pub(super) fn state_of(&self, pair: SignalPair) -> Option<usize> {
        self.arcs.iter().position(|arc| arc.pair == pair).map(|place| 3 + place)
    }

    /// Whether it began with this epoch.
    pub(super) fn is_new(&self, pair: SignalPair) -> bool {
        self.arcs.iter().any(|arc| arc.pair == pair && arc.is_new)
    }

    /// From states to double differences: for each ambiguity its own less that of its reference.
    pub(super) fn doubled(&self, differences: &DoubleDifferences) -> DMatrix<f64> {
        let count = differences.ambiguities().len();
        let mut doubled = DMatrix::zeros(count, self.state.len());
        for row in 0..count {
            let (of, less) = differences.singles_of(row);
            for (single, sign) in [(of, 1.0), (less, -1.0)] {
                if let Some(state) = self.state_of(differences.singles[single].pair) {
                    doubled[(row, state)] += sign;
                }
            }
        }
        doubled
    }

    /// How rows depend on the states.
    pub(super) fn design(&self, rows: &DifferencedRows, doubled: &DMatrix<f64>) -> DMatrix<f64> {
        let mut design = DMatrix::zeros(rows.residuals.len(), self.state.len());
        design.columns_mut(0, 3).copy_from(&rows.directions);
        for (row, ambiguity) in rows.ambiguities.iter().enumerate() {
            if let Some((place, wavelength)) = ambiguity {
                let own = design.row(row) + doubled.row(*place) * *wavelength;
                design.set_row(row, &own);
            }
        }
        design
    }
}

/// An ambiguity by phase and code alone, cycles.
fn begin(single: &Difference) -> f64 {
    single.phase.map_or(0.0, |phase| (phase - single.code) / single.wavelength)
}
