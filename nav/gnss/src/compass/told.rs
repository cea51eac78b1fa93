//! What is told of an epoch: the fix, rows for a filter, and what did not fit.

use std::collections::BTreeSet;

use nalgebra::{DMatrix, DVector};

use super::line::LineBias;
use super::model::Model;
use super::observe::Observed;
use super::outcome::{
    CompassFix, CompassInteger, CompassObjection, CompassRejection, CompassResidual,
};
use super::pose::CompassPose;
use super::prior::CompassPrior;
use super::rows::CompassRows;
use super::signal::Common;
use super::solve::{Misfit, Outcome};

/// A fix and what was left out of it.
pub(super) struct Told {
    pub(super) fix: CompassFix,
    pub(super) rejected: Vec<CompassRejection>,
}

pub(super) fn told(
    model: &Model<'_>,
    outcome: &Outcome,
    observed: &Observed,
    prior: &CompassPrior,
) -> Told {
    let mut fix = CompassFix {
        pose: outcome.pose,
        covariance: outcome.covariance,
        rows: rows(model, outcome, observed, prior),
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

/// Rows about the attitude that was known beforehand, else about what was found.
fn rows(
    model: &Model<'_>,
    outcome: &Outcome,
    observed: &Observed,
    prior: &CompassPrior,
) -> CompassRows {
    let pose = match (outcome.pose, prior.attitude) {
        (CompassPose::Attitude(_), Some(own)) => CompassPose::Attitude(own.c_nb),
        (pose, _) => pose,
    };
    let lines = &outcome.assumed;
    let kept: Vec<usize> = (0..model.commons.len()).filter(|place| outcome.used[*place]).collect();
    let lines_of = |place: &usize| model.commons[*place].heard.iter().map(|own| own.line);
    let biases: BTreeSet<LineBias> =
        kept.iter().flat_map(lines_of).filter(|line| !line.is_origin()).collect();
    let biases: Vec<LineBias> = biases.into_iter().collect();
    let count = kept.iter().map(|place| model.commons[*place].heard.len() - 1).sum();
    let of_line = |line: &LineBias| lines.place(line).map_or(0.0, |place| lines.mean[place]);
    let mut rows = CompassRows {
        residuals: DVector::zeros(count),
        attitude: DMatrix::zeros(count, 3),
        assumed: DVector::from_iterator(biases.len(), biases.iter().map(of_line)),
        lines: DMatrix::zeros(count, biases.len()),
        biases,
        covariance: DMatrix::zeros(count, count),
        of: Vec::with_capacity(count),
    };
    let offsets = model.offsets(&pose);
    for place in kept {
        let (common, first) = (&model.commons[place], rows.of.len());
        let against = &common.heard[0];
        let design = common.against_first() * model.design(common, &pose, lines);
        let by_pose = design.columns(0, 3) * observed.c_ne;
        let size = common.heard.len() - 1;
        rows.attitude.rows_mut(first, size).copy_from(&by_pose);
        rows.covariance.view_mut((first, first), (size, size)).copy_from(&common.covariance());
        for (row, own) in common.heard[1..].iter().enumerate() {
            let whole = outcome.integers[place][row] * common.wavelength;
            rows.residuals[first + row] =
                model.difference(common, (own, against), &offsets, lines) - whole;
            for (line, sign) in [(&own.line, 1.0), (&against.line, -1.0)] {
                if let Some(column) = rows.biases.iter().position(|bias| bias == line) {
                    rows.lines[(first + row, column)] += sign;
                }
            }
            rows.of.push((common.satellite, common.signal, own.antenna, against.antenna));
        }
    }
    rows
}
