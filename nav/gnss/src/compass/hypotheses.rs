//! Poses that are still possible, and what epochs say of each.

use nalgebra::Matrix3;

use super::fit::Freed;
use super::level::tilt;
use super::prior::CompassPrior;
use super::settings::{CompassSettings, CompassShape};
use super::solve::{Outcome, Start};

/// How much the assumed variance of phases is worth, in measurements.
const WORTH: f64 = 3.0;
/// How long errors of phases last, s: reflections. Epochs count as evidence only as far as their errors are new.
const ERRORS_LAST: f64 = 10.0;
/// A hypothesis with less of a chance is given up.
const LEAST: f64 = 1e-9;
/// At most so many are carried.
pub(super) const MOST: usize = 512;

/// A pose that is possible, and what has been seen of it.
#[derive(Clone, Debug)]
pub(super) struct Hypothesis {
    pub(super) outcome: Outcome,
    /// What was done to its last epoch to make it fit.
    pub(super) freed: Freed,
    /// One epoch alone speaks for it.
    pub(super) is_new: bool,
    misfit: f64,
    /// Measurements that have borne on it, beyond what they had to tell.
    pub(super) count: f64,
}

impl Hypothesis {
    /// One that an epoch begins.
    pub(super) fn new((outcome, freed): (Outcome, Freed), prior: &CompassPrior) -> Self {
        let (misfit, count) = evidence(&outcome, prior);
        Self { outcome, freed, is_new: true, misfit, count }
    }

    /// Where the next epoch begins: turned as is told, or as uncertain as an array is that may have turned by itself.
    pub(super) fn predicted(
        &self,
        settings: &CompassSettings,
        shape: &CompassShape,
        (elapsed, turn): (f64, Option<&Matrix3<f64>>),
    ) -> Start {
        // gyros that are good for ten degrees an hour, and more for the time between
        const BY_GYROS: f64 = 1e-3;
        let length = match shape {
            CompassShape::Baseline { length } => length.map_or(1.0, |(length, _)| length),
            CompassShape::Body(_) => 1.0,
        };
        let std = if turn.is_some() { BY_GYROS } else { settings.turning } * length;
        let wandered = Matrix3::identity() * (std * std * elapsed);
        let mut lines = self.outcome.lines.clone();
        lines.advance(elapsed, settings.line_walk);
        let pose = self.outcome.pose;
        let pose = turn.map_or(pose, |turn| pose.turned(turn));
        Start { pose, covariance: self.outcome.covariance + wandered, lines }
    }

    /// What another epoch makes of it.
    pub(super) fn followed(
        &self,
        (outcome, freed): (Outcome, Freed),
        elapsed: f64,
        prior: &CompassPrior,
    ) -> Self {
        let new = 1.0 - (-elapsed / ERRORS_LAST).exp();
        let (misfit, count) = evidence(&outcome, prior);
        let (misfit, count) = (self.misfit + new * misfit, self.count + new * count);
        Self { outcome, freed, is_new: false, misfit, count }
    }

    /// The logarithm of how likely what was seen is, the variance of the noise being unknown: it falls with the misfit as Student's distribution does.
    fn likelihood(&self) -> f64 {
        -0.5 * (WORTH + self.count) * ((WORTH + self.misfit) / WORTH).ln()
    }
}

/// Misfit and measurements of an epoch, those of the prior among them: a hypothesis that has the hull elsewhere than it is known to be is less likely.
fn evidence(outcome: &Outcome, prior: &CompassPrior) -> (f64, f64) {
    let (misfit, count) = outcome.evidence();
    tilt(outcome, prior).map_or((misfit, count), |tilt| (misfit + tilt, count + 2.0))
}

/// Keeps what is possible, likeliest first, of those that have the antennas nearer to each other than this, m, one. Gives back the chance that the first is wrong.
pub(super) fn weighed(all: &mut Vec<Hypothesis>, shape: &CompassShape, near: f64) -> f64 {
    // measurements that all have are what they are compared by: one that has fewer is no likelier for that
    let count = all.iter().map(|own| own.count).fold(0.0, f64::max);
    for own in &mut *all {
        let missing = count - own.count;
        own.misfit += missing;
        own.count = count;
    }
    all.sort_by(|a, b| b.likelihood().total_cmp(&a.likelihood()));
    let Some(best) = all.first().map(Hypothesis::likelihood) else { return 1.0 };
    let mut kept: Vec<Hypothesis> = Vec::new();
    for own in all.drain(..) {
        let is_likely = (own.likelihood() - best).exp() >= LEAST;
        let is_new = |other: &Hypothesis| own.outcome.pose.apart(&other.outcome.pose, shape) > near;
        if is_likely && kept.len() < MOST && kept.iter().all(is_new) {
            kept.push(own);
        }
    }
    *all = kept;
    let others: f64 = all[1..].iter().map(|own| (own.likelihood() - best).exp()).sum();
    others / (1.0 + others)
}
