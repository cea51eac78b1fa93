//! How far wrong a position may be with a stated risk: protection levels by solution separation.
//!
//! Everything that may be so is a [`Hypothesis`]: nobody lies, or one fault that began at one instant. Each has a chance by the data, an
//! estimate of its own, apart from the one that is told, and a sigma of it. The level is the smallest L with
//!
//! sum over all of chance P(error > L | it) <= risk,   P(error > L | it) <= exp(-((L - apart) / std)^2 / 2),
//!
//! which holds for a component (2Q(x) <= exp(-x^2/2)) as for the distance of two with the sigma of both together, which is no less than that along the major
//! axis. Chances are those of the whole exposure: of nobody lying, so many independent errors as it holds; of a fault, that it begins within it.
//! What all together is less likely than [`NEGLIGIBLE`] of the risk is left out and its chance taken off the risk.
//! In the manner of solution separation (Blanch and others, IEEE Trans. Aerospace and Electronic Systems 51 (2015)), with the data's odds in place of a test
//! and its missed detections.

pub mod recursion;

use insd_base::{Protection, SolutionSigma};

/// Share of the risk that what is unlikely may take without being looked at.
const NEGLIGIBLE: f64 = 0.01;
/// Halvings of what a level is between.
const STEPS: usize = 40;
/// A level is not above this, m: nothing is known then.
const MOST: f64 = 1e6;

/// Something that may be so.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hypothesis {
    /// What it is; what is of one cause is one fault, that began at one instant or another.
    pub cause: usize,
    /// How often within the exposure: a probability, and of errors that are renewed so many times.
    pub chance: f64,
    /// How far apart its estimate is from the one that is told, m.
    pub apart: f64,
    /// 1-sigma of its estimate, m.
    pub std: f64,
}

/// What risk is taken for how long, and how often faults begin that nobody has found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RiskModel {
    /// Probability that an error is beyond its level within the exposure.
    pub risk: f64,
    /// Exposure, s.
    pub exposure: f64,
    /// Errors of a position that nobody falsifies are others after so long, s.
    pub renewed: f64,
    /// A receiver's position fails by itself, 1/h.
    pub receiver_fails: f64,
    /// A receiver is led astray, 1/h.
    pub receiver_deceived: f64,
    /// A satellite is wrong, 1/h each.
    pub satellite_fails: f64,
    /// All satellites of one constellation other than GPS are wrong, 1/h.
    pub constellation_fails: f64,
    /// A base stands elsewhere than it says, where nobody on board answers for its place: a probability.
    pub base_misplaced: f64,
    /// A log is wrong, 1/h.
    pub log_fails: f64,
    /// A compass is wrong, 1/h.
    pub heading_fails: f64,
    /// A triad of the IMU fails, 1/h.
    pub imu_fails: f64,
}

/// IMO A.915(22), appendix 2, for the risk and its time. Satellites and constellations: of the order that
/// integrity monitoring in aviation assumes of them. Receivers: failed positions of a constellation (Sensors 19 (2019) 4847, table 3). Interference where none is
/// expected, logs, compasses: assumed. Bases: assumed. Three axes of 50 000 h each for a triad.
impl Default for RiskModel {
    fn default() -> Self {
        RiskModel {
            risk: 1e-5,
            exposure: 10_800.0,
            renewed: 300.0,
            receiver_fails: 1e-4,
            receiver_deceived: 1e-5,
            satellite_fails: 1e-5,
            constellation_fails: 1e-4,
            base_misplaced: 1e-2,
            log_fails: 1e-4,
            heading_fails: 1e-4,
            imu_fails: 6e-5,
        }
    }
}

impl RiskModel {
    /// How many independent errors the exposure holds.
    #[must_use]
    pub fn renewals(&self) -> f64 {
        (self.exposure / self.renewed).max(1.0)
    }

    /// By how much levels where nobody lies are beyond [`Protection::of`], which is of the default risk and exposure, m: negative for a greater risk.
    /// An error is beyond so many sigmas `k` with `exp(-k^2/2)` at the most, and the exposure holds so many errors.
    #[must_use]
    pub fn beyond_usual(&self, sigma: &SolutionSigma) -> Protection {
        let sigmas = |own: &RiskModel| (2.0 * (own.renewals() / own.risk).ln().max(0.0)).sqrt();
        let more = sigmas(self) - sigmas(&RiskModel::default());
        let sigma = &sigma.position.0;
        Protection { horizontal: more * sigma.xy().norm(), vertical: more * sigma.z }
    }

    /// Chance that something begins within the exposure, of a rate, 1/h.
    #[must_use]
    pub fn chance(&self, rate: f64) -> f64 {
        (rate * self.exposure / 3600.0).min(1.0)
    }
}

/// Chance that an error is beyond a level, of what is sorted by cause. A fault passes through all ages within the exposure: that of one cause is its chance at
/// the worst of them.
fn beyond(all: &[Hypothesis], level: f64) -> f64 {
    let of = |own: &Hypothesis| {
        let away = (level - own.apart).max(0.0) / own.std.max(1e-9);
        own.chance * (-0.5 * away * away).exp()
    };
    all.chunk_by(|a, b| a.cause == b.cause).map(|one| one.iter().map(of).fold(0.0, f64::max)).sum()
}

/// The smallest level that an error is beyond with no more than a risk, m. Sorts what may be so, and forgets what is unlikely.
#[must_use]
pub fn level(all: &mut Vec<Hypothesis>, risk: f64) -> f64 {
    all.sort_by(|a, b| b.chance.total_cmp(&a.chance));
    let mut left = 0.0;
    while let Some(last) = all.last() {
        if left + last.chance > NEGLIGIBLE * risk {
            break;
        }
        left += last.chance;
        all.pop();
    }
    all.sort_by_key(|own| own.cause);
    let risk = risk - left;
    let (mut low, mut high) = (0.0, 1.0);
    while high < MOST && beyond(all, high) > risk {
        (low, high) = (high, 2.0 * high);
    }
    for _ in 0..STEPS {
        let middle = 0.5 * (low + high);
        if beyond(all, middle) > risk {
            low = middle;
        } else {
            high = middle;
        }
    }
    high.min(MOST)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(all: &[(f64, f64, f64)]) -> f64 {
        let own = |(cause, (chance, apart, std)): (usize, &(f64, f64, f64))| Hypothesis {
            cause,
            chance: *chance,
            apart: *apart,
            std: *std,
        };
        level(&mut all.iter().enumerate().map(own).collect(), 1e-5)
    }

    #[test]
    fn of_nobody_lying_a_level_is_five_and_a_half_sigmas() {
        let renewals = RiskModel::default().renewals();
        let level = of(&[(renewals, 0.0, 2.0)]);
        assert!((level - 11.0).abs() < 0.02, "{level}");
    }

    #[test]
    fn of_two_places_of_which_she_is_in_one_a_level_reaches_to_the_farther_one_and_its_errors() {
        let renewals = RiskModel::default().renewals();
        let level = of(&[(renewals, 0.0, 0.7), (renewals, 2.6, 1.0)]);
        assert!((2.6 + 5.0..2.6 + 5.5).contains(&level), "{level}");
    }

    #[test]
    fn another_risk_widens_or_narrows_a_level_as_far_as_errors_of_nobody_lying_ask() {
        let sigma = SolutionSigma {
            position: insd_base::Ned::new(1.5, 2.0, 3.0),
            ..SolutionSigma::default()
        };
        let usual = RiskModel::default();
        assert_eq!(usual.beyond_usual(&sigma), Protection::default());
        for (risk, exposure) in [(1e-7, 10_800.0), (1e-3, 10_800.0), (1e-5, 900.0)] {
            let own = RiskModel { risk, exposure, ..usual };
            let told = Protection::of(&sigma).plus(&own.beyond_usual(&sigma));
            let free = |std| Hypothesis { cause: 0, chance: own.renewals(), apart: 0.0, std };
            let [horizontal, vertical] =
                [2.5, 3.0].map(|std| level(&mut vec![free(std)], own.risk));
            // to the digits of 5.5; that of the height is of a narrower tail
            assert!((told.horizontal / horizontal - 1.0).abs() < 2e-3, "{told:?} {horizontal}");
            assert!((0.92..1.0).contains(&(told.vertical / vertical)), "{told:?} {vertical}");
        }
    }

    #[test]
    fn what_is_certain_is_within_the_level_and_what_is_rarer_than_the_risk_is_not_looked_at() {
        assert!(of(&[(1.0, 0.0, 1.0), (1.0, 100.0, 1.0)]) > 104.0);
        let alone = of(&[(1.0, 0.0, 1.0)]);
        assert!((of(&[(1.0, 0.0, 1.0), (1e-8, 1e4, 1e4)]) - alone).abs() < 1e-3);
    }

    #[test]
    fn a_fault_as_likely_as_the_risk_costs_little_and_one_a_thousand_times_likelier_its_tail() {
        let free = of(&[(1.0, 0.0, 1.0)]);
        let rare = of(&[(1.0, 0.0, 1.0), (9e-6, 0.0, 100.0)]);
        let usual = of(&[(1.0, 0.0, 1.0), (1e-2, 0.0, 100.0)]);
        assert!(rare < 8.0 * free && usual > 3.5 * 100.0, "{rare} {usual}");
    }

    #[test]
    fn an_error_that_is_as_unsure_as_stated_is_beyond_its_level_no_more_often_than_the_risk() {
        // two components of one metre, uniform angle: beyond L with exp(-L^2 / 2)
        let level =
            level(&mut vec![Hypothesis { cause: 0, chance: 1.0, apart: 0.0, std: 1.0 }], 1e-3);
        assert!(((-0.5 * level * level).exp() - 1e-3).abs() < 1e-6, "{level}");
    }

    #[test]
    fn one_fault_that_may_have_begun_at_many_instants_is_one() {
        let own = |cause, apart| Hypothesis { cause, chance: 1e-3, apart, std: 1.0 };
        let free = Hypothesis { cause: 9, chance: 1.0, apart: 0.0, std: 0.1 };
        let once = level(&mut vec![free, own(0, 5.0)], 1e-5);
        let often = level(&mut vec![own(0, 5.0), free, own(0, 5.0), own(0, 4.0)], 1e-5);
        let others = level(&mut vec![free, own(0, 5.0), own(1, 5.0)], 1e-5);
        assert!((once - often).abs() < 1e-6 && others > once, "{once} {often} {others}");
    }
}
