//! Figures of one component: how large its errors are, and whether its claims are honest.

use serde::{Deserialize, Serialize};

use super::component::{Component, Unit};
use super::errors::{EpochError, normalised};
use super::unknown;

/// Squared radii within which a consistent error lies in 68.27, 95.45 and 99.73 % of cases, for one
/// degree of freedom.
const ONE_DIMENSION: [f64; 3] = [1.0, 4.0, 9.0];
/// The same for two degrees of freedom: -2 ln(1 - p).
const TWO_DIMENSIONS: [f64; 3] = [2.295_749, 6.180_074, 11.829_158];

/// Errors and claims of one component over all epochs, in the unit people read.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Unit of the lengths below.
    pub unit: Unit,
    /// Epochs with an error.
    pub count: u64,
    /// Epochs where truth does not know the component.
    pub missing: u64,
    /// Epochs whose claimed sigma is not a positive number; they are in none of the claims below.
    pub without_claim: u64,
    /// Mean error; for the horizontal position mean distance.
    pub mean: f64,
    /// Root mean square error.
    pub rms: f64,
    /// 95 % of errors are at most this large.
    pub p95: f64,
    /// Largest error.
    pub max: f64,
    /// Mean claimed 1-sigma.
    #[serde(deserialize_with = "unknown::number")]
    pub mean_sigma: f64,
    /// Normalised estimation error squared per degree of freedom: mean of (error / sigma)^2, 1 for
    /// honest claims, more for boasts. Bar-Shalom, Li and Kirubarajan, Estimation with Applications
    /// to Tracking and Navigation, section 5.4.2.
    #[serde(deserialize_with = "unknown::number")]
    pub nees: f64,
    /// Share of errors within the claimed 1-sigma: 0.6827 for honest claims. For the horizontal
    /// position within the ellipse that should hold as many.
    #[serde(deserialize_with = "unknown::number")]
    pub coverage_1sigma: f64,
    /// Share within 2 sigma: 0.9545.
    #[serde(deserialize_with = "unknown::number")]
    pub coverage_2sigma: f64,
    /// Share within 3 sigma: 0.9973.
    #[serde(deserialize_with = "unknown::number")]
    pub coverage_3sigma: f64,
}

/// What one epoch says of one component.
#[derive(Clone, Copy, Debug)]
struct Observation {
    error: f64,
    sigma: f64,
    /// (error / sigma)^2 summed over the degrees of freedom.
    distance_sq: Option<f64>,
}

/// Summary of one component; `None` if no epoch has an error.
#[must_use]
pub fn summarise(epochs: &[EpochError], component: Component) -> Option<Summary> {
    let scale = component.scale();
    let observe = |epoch: &EpochError| {
        let (error, sigma) = (epoch.of(component)?, epoch.sigma_of(component));
        let distance_sq = normalised(error, sigma).map(|ratio| ratio * ratio);
        Some(Observation { error: error * scale, sigma: sigma * scale, distance_sq })
    };
    let observed: Vec<Observation> = epochs.iter().filter_map(observe).collect();
    let missing = epochs.len() - observed.len();
    figures(&observed, component.unit(), missing, ONE_DIMENSION, 1.0)
}

/// Summary of the horizontal position, a vector of two degrees of freedom.
#[must_use]
pub fn summarise_horizontal(epochs: &[EpochError]) -> Option<Summary> {
    let observe = |epoch: &EpochError| {
        Some(Observation {
            error: epoch.horizontal()?,
            sigma: epoch.horizontal_sigma(),
            distance_sq: epoch.horizontal_distance_sq(),
        })
    };
    let observed: Vec<Observation> = epochs.iter().filter_map(observe).collect();
    figures(&observed, Unit::Metre, epochs.len() - observed.len(), TWO_DIMENSIONS, 2.0)
}

fn figures(
    observed: &[Observation],
    unit: Unit,
    missing: usize,
    radii_sq: [f64; 3],
    freedom: f64,
) -> Option<Summary> {
    if observed.is_empty() {
        return None;
    }
    let claimed: Vec<(f64, f64)> =
        observed.iter().filter_map(|o| Some((o.sigma, o.distance_sq?))).collect();
    let mut sizes: Vec<f64> = observed.iter().map(|o| o.error.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    let [coverage_1sigma, coverage_2sigma, coverage_3sigma] =
        radii_sq.map(|radius| mean(claimed.iter().map(|(_, d)| f64::from(u8::from(*d <= radius)))));
    Some(Summary {
        unit,
        count: observed.len() as u64,
        missing: missing as u64,
        without_claim: (observed.len() - claimed.len()) as u64,
        mean: mean(observed.iter().map(|o| o.error)),
        rms: mean(observed.iter().map(|o| o.error * o.error)).sqrt(),
        p95: quantile(&sizes, 0.95),
        max: sizes.last().copied().unwrap_or(0.0),
        mean_sigma: mean(claimed.iter().map(|(sigma, _)| *sigma)),
        nees: mean(claimed.iter().map(|(_, d)| d / freedom)),
        coverage_1sigma,
        coverage_2sigma,
        coverage_3sigma,
    })
}

/// Arithmetic mean; NaN of nothing.
#[must_use]
pub fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (mut sum, mut count) = (0.0, 0_u64);
    for value in values {
        sum += value;
        count += 1;
    }
    sum / count as f64
}

/// The smallest of sorted values that at least a share `p` of them does not exceed.
#[must_use]
pub fn quantile(sorted: &[f64], p: f64) -> f64 {
    let rank = (p * sorted.len() as f64).ceil() as usize;
    sorted.get(rank.max(1) - 1).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::Time;
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    /// Errors drawn with 1-sigma `true_sigma`, claimed as `claimed`.
    fn drawn(true_sigma: f64, claimed: f64) -> Vec<EpochError> {
        let mut random = rand_pcg::Pcg64::seed_from_u64(7);
        let mut draw = || {
            let normal: f64 = StandardNormal.sample(&mut random);
            Some(true_sigma * normal)
        };
        (0..20_000)
            .map(|i| EpochError {
                time: Time::from_nanos(i),
                error: std::array::from_fn(|_| draw()),
                sigma: [claimed; 9],
            })
            .collect()
    }

    #[test]
    fn honest_claims_have_unit_nees_and_gaussian_coverage() {
        let epochs = drawn(2.0, 2.0);
        for summary in
            [summarise(&epochs, Component::Down).unwrap(), summarise_horizontal(&epochs).unwrap()]
        {
            assert!((summary.nees - 1.0).abs() < 0.03, "{summary:?}");
            assert!((summary.coverage_1sigma - 0.6827).abs() < 0.01, "{summary:?}");
            assert!((summary.coverage_2sigma - 0.9545).abs() < 0.005, "{summary:?}");
            assert!((summary.coverage_3sigma - 0.9973).abs() < 0.002, "{summary:?}");
        }
    }

    #[test]
    fn boasting_by_a_factor_of_two_shows_as_nees_of_four() {
        let summary = summarise(&drawn(2.0, 1.0), Component::Heading).unwrap();
        assert!((summary.nees - 4.0).abs() < 0.1);
        assert!((summary.rms - 2_f64.to_degrees()).abs() < 2.0);
    }

    #[test]
    fn the_figures_of_a_short_list_are_those_of_a_pocket_calculator() {
        let epoch =
            |error, sigma| EpochError { time: Time::START, error: [error; 9], sigma: [sigma; 9] };
        let epochs = [
            epoch(Some(3.0), 2.0),
            epoch(Some(-4.0), 1.0),
            epoch(Some(0.0), 0.0),
            epoch(None, 1.0),
        ];
        let summary = summarise(&epochs, Component::North).unwrap();
        assert_eq!((summary.count, summary.missing, summary.without_claim), (3, 1, 1));
        assert_eq!(summary.max, 4.0);
        assert_eq!(summary.mean_sigma, 1.5);
        assert_eq!(summary.nees, (2.25 + 16.0) / 2.0);
        assert_eq!(summary.coverage_2sigma, 0.5);
        assert!((summary.rms - (25.0_f64 / 3.0).sqrt()).abs() < 1e-12);
        assert_eq!(summarise(&epochs[3..], Component::North), None);
    }

    #[test]
    fn quantiles_are_members_of_the_list() {
        let sorted: Vec<f64> = (1..=100).map(f64::from).collect();
        assert_eq!(quantile(&sorted, 0.95), 95.0);
        assert_eq!(quantile(&sorted[..1], 0.95), 1.0);
        assert!(quantile(&[], 0.5).is_nan());
    }
}
