//! What is told of an epoch: the fix, rows for a filter, and what did not fit.

use std::collections::BTreeSet;

use insd_base::satellites::{AntennaPhase, AntennaSignal};

use super::model::Model;
use super::observe::Observed;
use super::outcome::{
    CompassFix, CompassInteger, CompassObjection, CompassRejection, CompassResidual,
};
use super::signal::{Common, Heard};
use super::solve::{Misfit, Outcome};

/// A fix and what was left out of it.
pub(super) struct Told {
    pub(super) fix: CompassFix,
    pub(super) rejected: Vec<CompassRejection>,
}

pub(super) fn told(model: &Model<'_>, outcome: &Outcome, observed: &Observed) -> Told {
    let mut fix = CompassFix {
        pose: outcome.pose,
        covariance: outcome.covariance,
        signals: signals(model, outcome, observed),
        integers: Vec::new(),
        residuals: Vec::new(),
        chi_square: outcome.misfit,
        doubt: 0.0,
        success: outcome.success,
        satellites: 0,
    };
    let mut satellites = BTreeSet::new();
    for (place, common) in model.commons.iter().enumerate().filter(|(p, _)| outcome.used[*p]) {
        satellites.insert(common.satellite);
        let (satellite, signal, against) =
            (common.satellite, common.signal, common.heard[0].antenna);
        for (own, cycles) in common.heard[1..].iter().zip(&outcome.integers[place]) {
            let (antenna, cycles) = (own.antenna, *cycles as i64);
            fix.integers.push(CompassInteger { satellite, signal, antenna, against, cycles });
        }
        for (own, residual) in common.heard.iter().zip(&about_mean(common, outcome, place)) {
            let (antenna, sigma) = (own.antenna, own.variance.sqrt());
            let residual = *residual;
            fix.residuals.push(CompassResidual { satellite, signal, antenna, residual, sigma });
        }
    }
    fix.satellites = satellites.len();
    let rejected = outcome.misfits.iter().map(|own| rejection(model, outcome, own)).collect();
    Told { fix, rejected }
}

/// What is left of the phase of each antenna against their mean, m.
fn about_mean(common: &Common, outcome: &Outcome, place: usize) -> Vec<f64> {
    let left: Vec<f64> =
        std::iter::once(0.0).chain(outcome.residuals[place].iter().copied()).collect();
    let weights: Vec<f64> = common.heard.iter().map(|own| 1.0 / own.variance).collect();
    let sum: f64 = left.iter().zip(&weights).map(|(left, weight)| left * weight).sum();
    let mean = sum / weights.iter().sum::<f64>();
    left.into_iter().map(|left| left - mean).collect()
}

fn rejection(model: &Model<'_>, outcome: &Outcome, misfit: &Misfit) -> CompassRejection {
    let common = &model.commons[misfit.common];
    let left = about_mean(common, outcome, misfit.common);
    let sigmas = |place: &usize| left[*place].abs() / common.heard[*place].variance.sqrt();
    let worst = (0..left.len()).max_by(|a, b| sigmas(a).total_cmp(&sigmas(b)));
    // of two antennas nobody can tell which
    let antenna = worst.filter(|_| left.len() > 2).map(|place| common.heard[place].antenna);
    let (residual, times) = (misfit.residual, misfit.times);
    CompassRejection {
        satellite: common.satellite,
        signal: common.signal,
        antenna,
        why: CompassObjection::Contradicts { residual, times },
    }
}

/// Signals that fit, whole cycles taken out.
fn signals(model: &Model<'_>, outcome: &Outcome, observed: &Observed) -> Vec<AntennaSignal> {
    let kept = (0..model.commons.len()).filter(|place| outcome.used[*place]);
    let all = kept.map(|place| {
        let common = &model.commons[place];
        let first = common.heard[0].phase;
        let cycles = std::iter::once(0.0).chain(outcome.integers[place].iter().copied());
        let phase = |(own, cycles): (&Heard, f64)| AntennaPhase {
            lever: model.lever(own.antenna),
            phase: own.phase - first - cycles * common.wavelength,
            variance: own.variance,
            line: Some(own.line).filter(|line| !line.is_origin()),
            clock: model.own_clock(own.antenna),
        };
        AntennaSignal {
            satellite: common.satellite,
            signal: common.signal,
            wavelength: common.wavelength,
            gradient: -(observed.c_ne.transpose() * common.line_of_sight),
            phases: common.heard.iter().zip(cycles).map(phase).collect(),
        }
    });
    all.collect()
}
