//! From real ambiguities to integers that are believed.

use std::collections::BTreeSet;

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::double::DoubleDifferences;
use super::float::Float;
use super::outcome::{RtkFix, RtkRefusal};
use super::prior::RoverPrior;
use super::settings::RtkSettings;
use crate::integers::{IntegerRefusal, IntegerSearch, IntegerVector};

/// How many measurements the assumed noise is worth against what is seen of it.
const WORTH: f64 = 3.0;
/// Candidates that are weighed against each other.
const CANDIDATES: usize = 20;
/// Fewest satellites beside the references: three make a position, and one has to check it.
const FEWEST: usize = 4;
/// Fewest of a part: which one is at fault has to show.
const FEWEST_OF_PART: usize = 5;
/// The most that residuals may be above their assumed variance.
const LEVEL: f64 = 4.0;

/// Searches integers for the whole, then without the satellites of poorest phases, one more each time, until a part passes. Each attempt has its share of
/// the risk.
pub(super) fn resolve(
    differences: &DoubleDifferences,
    float: &Float,
    settings: &RtkSettings,
    prior: Option<&RoverPrior>,
) -> Result<RtkFix, RtkRefusal> {
    let mut kept: Vec<usize> = (0..float.ambiguities.len()).collect();
    let mut refusal = None;
    for attempt in 1..=settings.attempts.max(1) {
        let allowed = settings.share(attempt);
        let fewest = if attempt == 1 { FEWEST } else { FEWEST_OF_PART };
        if satellites(differences, &kept) < fewest {
            break;
        }
        let tried = Attempt { differences, float, kept: &kept, is_whole: attempt == 1 };
        match tried.fix(settings, allowed, prior) {
            Ok(fix) => return Ok(RtkFix { attempts: attempt, ..fix }),
            // what the whole was refused for is what is told
            Err(why) => refusal = refusal.or(Some(why)),
        }
        let Some(poorest) = poorest(differences, &kept) else { break };
        kept.retain(|place| satellite(differences, *place) != poorest);
    }
    Err(refusal.unwrap_or(RtkRefusal::TooFewPhases { phases: float.ambiguities.len() }))
}

/// What is known beforehand and what integers make of it must not contradict each other.
fn agree(
    position: &Vector3<f64>,
    covariance: &Matrix3<f64>,
    prior: Option<&RoverPrior>,
) -> Result<(), RtkRefusal> {
    // chi-square of three, once in ten thousand
    const FAR: f64 = 21.1;
    let Some((expected, of_prior)) = prior.and_then(|p| Some((p.position, p.covariance?))) else {
        return Ok(());
    };
    let off = position - expected;
    let both: Matrix3<f64> = of_prior + covariance;
    let distance = both.cholesky().map_or(0.0, |factor| off.dot(&factor.solve(&off)));
    if distance > FAR {
        return Err(RtkRefusal::Prior { off: off.norm(), sigmas: distance.sqrt() });
    }
    Ok(())
}

fn satellites(differences: &DoubleDifferences, kept: &[usize]) -> usize {
    let all: BTreeSet<_> = kept.iter().map(|place| satellite(differences, *place)).collect();
    all.len()
}

fn satellite(differences: &DoubleDifferences, ambiguity: usize) -> insd_base::SatelliteId {
    differences.ambiguities()[ambiguity].pair.satellite
}

/// The satellite of the phase with the greatest variance.
fn poorest(differences: &DoubleDifferences, kept: &[usize]) -> Option<insd_base::SatelliteId> {
    let variance = |place: &&usize| {
        let (of, _) = differences.singles_of(**place);
        differences.singles[of].phase_variance
    };
    let poorest = kept.iter().max_by(|a, b| variance(a).total_cmp(&variance(b)))?;
    Some(satellite(differences, *poorest))
}

/// Some of the ambiguities are to be integers.
struct Attempt<'a> {
    differences: &'a DoubleDifferences,
    float: &'a Float,
    kept: &'a [usize],
    is_whole: bool,
}

impl Attempt<'_> {
    fn fix(
        &self,
        settings: &RtkSettings,
        allowed: f64,
        prior: Option<&RoverPrior>,
    ) -> Result<RtkFix, RtkRefusal> {
        let measured = DVector::from_iterator(
            self.kept.len(),
            self.kept.iter().map(|k| self.float.ambiguities[*k]),
        );
        let covariance = self.covariance();
        let search = IntegerSearch::new(&measured, &covariance).map_err(RtkRefusal::Search)?;
        let success = search.success();
        if !self.is_whole && success < settings.success {
            return Err(RtkRefusal::Ratio { doubt: 1.0 - success, allowed });
        }
        let found = search.nearest(CANDIDATES).map_err(RtkRefusal::Search)?;
        let [best, second, ..] = found.as_slice() else {
            return Err(RtkRefusal::Search(IntegerRefusal::Malformed));
        };
        let doubt = self.doubt(&found);
        if doubt > allowed {
            return Err(RtkRefusal::Ratio { doubt, allowed });
        }
        let Fixed { position, covariance, level } = self.fixed(best)?;
        if level > LEVEL {
            return Err(RtkRefusal::Residuals { level, limit: LEVEL });
        }
        let runner_up = self.fixed(second)?.position;
        let integers = self.kept.iter().zip(&best.integers);
        agree(&position, &covariance, prior)?;
        Ok(RtkFix {
            position,
            covariance: covariance * level.max(1.0),
            runner_up,
            doubt,
            ratio: second.distance / best.distance.max(1e-9),
            success,
            integers: integers.map(|(k, z)| (self.differences.ambiguities()[*k], *z)).collect(),
            attempts: 1,
            level,
        })
    }

    fn covariance(&self) -> DMatrix<f64> {
        let count = self.kept.len();
        DMatrix::from_fn(count, count, |i, j| {
            self.float.covariance[(3 + self.kept[i], 3 + self.kept[j])]
        })
    }

    /// The chance that the nearest integers are wrong, all others weighed against them. With noise of an assumed variance that is worth so many measurements the
    /// likelihood of integers falls with their misfit as Student's distribution does, not as Gauss': what a ratio has to be is less the more there is to
    /// check it, and much more where little is.
    fn doubt(&self, found: &[IntegerVector]) -> f64 {
        let (misfit, freedom) = self.float.misfit;
        let (chi_square, count) = self.shared(&found[0]);
        let power = (WORTH + count + (freedom + self.kept.len()) as f64) / 2.0;
        let total = |vector: &IntegerVector| WORTH + chi_square + misfit + vector.distance;
        let best = total(&found[0]);
        let others: f64 = found[1..].iter().map(|other| (best / total(other)).powf(power)).sum();
        others / (1.0 + others)
    }

    /// What is known of the noise by earlier codes, unless these integers leave more than that noise: then it does not hold for phases.
    fn shared(&self, best: &IntegerVector) -> (f64, f64) {
        let (chi_square, count) = self.float.known;
        let level = (WORTH + chi_square) / (WORTH + count);
        let law = ChiSquared::new(self.kept.len() as f64);
        let is_alike = law.is_ok_and(|law| law.sf(best.distance / level) > 1e-3);
        if is_alike { (chi_square, count) } else { (0.0, 0.0) }
    }

    /// The position by the phases of this epoch alone, if these are the integers: what is not fixed has no part in it.
    fn fixed(&self, vector: &IntegerVector) -> Result<Fixed, RtkRefusal> {
        let mut ambiguities = self.float.ambiguities.clone();
        for (place, integer) in self.kept.iter().zip(&vector.integers) {
            ambiguities[*place] = *integer as f64;
        }
        let rows = self.differences.rows(&self.float.position, &ambiguities);
        let count = self.kept.len();
        let place = |own: usize| self.differences.codes() + self.kept[own];
        let directions = DMatrix::from_fn(count, 3, |i, j| rows.directions[(place(i), j)]);
        let residuals = DVector::from_fn(count, |i, _| rows.residuals[place(i)]);
        let noise = DMatrix::from_fn(count, count, |i, j| rows.covariance[(place(i), place(j))]);
        let factor = noise.cholesky().ok_or(RtkRefusal::Geometry)?;
        let weighed = factor.solve(&directions);
        let normal: Matrix3<f64> =
            (directions.transpose() * &weighed).fixed_view::<3, 3>(0, 0).into();
        let covariance = normal.try_inverse().ok_or(RtkRefusal::Geometry)?;
        let pulled = weighed.transpose() * &residuals;
        let step = covariance * pulled.fixed_rows::<3>(0);
        let left = &residuals - &directions * step;
        let level = left.dot(&factor.solve(&left)) / (count - 3) as f64;
        Ok(Fixed { position: self.float.position + step, covariance, level })
    }
}

/// A position by phases whose integers are known.
struct Fixed {
    position: Vector3<f64>,
    covariance: Matrix3<f64>,
    /// Variance of the residuals over that assumed.
    level: f64,
}
