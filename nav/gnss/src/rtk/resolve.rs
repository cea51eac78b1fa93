//! From real ambiguities to integers that are believed.

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
/// Fewest differences of phase: three make a position, and one has to check it.
const FEWEST: usize = 4;
/// The most that residuals may be above their assumed variance.
const LEVEL: f64 = 6.0;

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
        if kept.len() < FEWEST {
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
    covariance: &DMatrix<f64>,
    prior: Option<&RoverPrior>,
) -> Result<(), RtkRefusal> {
    // chi-square of three, once in ten thousand
    const FAR: f64 = 21.1;
    let Some((expected, of_prior)) = prior.and_then(|p| Some((p.position, p.covariance?))) else {
        return Ok(());
    };
    let off = position - expected;
    let both: Matrix3<f64> = of_prior + covariance.fixed_view::<3, 3>(0, 0);
    let distance = both.cholesky().map_or(0.0, |factor| off.dot(&factor.solve(&off)));
    if distance > FAR {
        return Err(RtkRefusal::Prior { off: off.norm(), sigmas: distance.sqrt() });
    }
    Ok(())
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
        let freedom = self.float.misfit.1 + self.kept.len();
        let level = (self.float.misfit.0 + best.distance) / freedom as f64;
        if level > LEVEL {
            return Err(RtkRefusal::Residuals { level, limit: LEVEL });
        }
        let (position, after) = self.conditioned(&measured, &covariance, best)?;
        let (runner_up, _) = self.conditioned(&measured, &covariance, second)?;
        let integers = self.kept.iter().zip(&best.integers);
        agree(&position, &after, prior)?;
        Ok(RtkFix {
            position,
            covariance: after.fixed_view::<3, 3>(0, 0) * level.max(1.0),
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

    /// Position and covariance of all, if these are the integers.
    fn conditioned(
        &self,
        measured: &DVector<f64>,
        covariance: &DMatrix<f64>,
        vector: &IntegerVector,
    ) -> Result<(Vector3<f64>, DMatrix<f64>), RtkRefusal> {
        let size = self.float.covariance.nrows();
        let gain = DMatrix::from_fn(size, self.kept.len(), |i, j| {
            self.float.covariance[(i, 3 + self.kept[j])]
        });
        let factor = covariance.clone().cholesky().ok_or(RtkRefusal::Geometry)?;
        let off = DVector::from_fn(measured.len(), |i, _| measured[i] - vector.integers[i] as f64);
        let step = &gain * factor.solve(&off);
        let position = self.float.position - Vector3::new(step[0], step[1], step[2]);
        let after = &self.float.covariance - &gain * factor.solve(&gain.transpose());
        Ok((position, after))
    }
}
