//! What is known of the displacement of a moored ship before it has been seen: kinds of sea, each as the products of
//! consecutive samples that it would give.
//!
//! A kind is a band of swaying on the moorings, even in the logarithm of the period, and a share of waves of 4 to 20 s,
//! which at a spacing of some seconds are nearly white. It counts as so many samples that were seen before the first
//! (a conjugate prior of the regression; Kadiyala and Karlsson, J. Applied Econometrics 12 (1997)), and the kinds are
//! weighed by how well each foretells the samples, one after the other, given what the filter knows of its own errors
//! (multiple models: Magill, IEEE Trans. Automatic Control 10 (1965)).

use std::f64::consts::TAU;
use std::sync::Arc;

use nalgebra::{Cholesky, DMatrix, DVector};

/// Bands of swaying, s. The first is for moorings of any kind.
const BANDS: [(f64, f64); 5] =
    [(25.0, 180.0), (20.0, 50.0), (40.0, 90.0), (60.0, 150.0), (100.0, 200.0)];
/// That of most ships (docs/systems.md, S1), and by how much it is likelier than another before anything was seen, as
/// logarithm.
const USUAL: (f64, f64) = BANDS[3];
const LIKELIER: f64 = 2.0;
/// Periods of waves, s.
const WAVES: (f64, f64) = (4.0, 20.0);
/// Shares of the swaying in the variance of the displacement.
const SWAYING: [f64; 2] = [0.9, 0.5];
/// What is white besides, over that variance.
const WHITE: f64 = 0.02;
/// Samples that a kind counts for.
pub(super) const SAMPLES: f64 = 60.0;
/// Samples that the stated displacement counts for at first, over how many seen ones it is forgotten, and by how much
/// its variance is taken larger: before anything was seen the kinds together claim more than each of them.
const STATED_SAMPLES: f64 = 4.0;
const STATED_UNTIL: f64 = 15.0;
const STATED_DOUBT: f64 = 1.25;
/// Intervals of the quadrature over a band.
const GRID: u32 = 200;

/// A kind of sea.
#[derive(Clone, Debug)]
struct Kind {
    /// Correlations of samples with those so many lags before.
    correlations: Vec<f64>,
    /// What it foretells from so many samples before.
    foretold: Vec<Foretold>,
    /// Logarithm of its odds before anything was seen.
    odds: f64,
}

/// What a kind of sea foretells of a component of the displacement from those before.
#[derive(Clone, Debug)]
pub struct Foretold {
    /// Factors of the samples before, newest first.
    pub lags: Vec<f64>,
    /// Variance of what it does not foretell, over that of the displacement.
    pub unexplained: f64,
}

/// The kinds of sea that a moored ship may lie in, for samples at a spacing.
#[derive(Clone, Debug)]
pub struct SeaPrior {
    kinds: Arc<Vec<Kind>>,
    /// Stated variance of one component of the displacement, m^2.
    variance: f64,
}

impl SeaPrior {
    /// For samples at a spacing, s, and models of up to `order` lags.
    #[must_use]
    pub fn new(spacing: f64, order: usize) -> Self {
        let correlations = |band: (f64, f64)| -> Vec<f64> {
            (0..=order).map(|lag| mean_cosine(band, lag as f64 * spacing)).collect()
        };
        let waves = correlations(WAVES);
        let kinds = BANDS.into_iter().flat_map(|band| {
            let odds = if band == USUAL { LIKELIER } else { 0.0 };
            let band = correlations(band);
            SWAYING.map(|swaying| Kind::new(&band, &waves, swaying, odds))
        });
        SeaPrior { kinds: Arc::new(kinds.collect()), variance: 0.0 }
    }

    /// The same where the displacement of one component is stated to be `std`, 1-sigma, m.
    #[must_use]
    pub fn stated(self, std: f64) -> Self {
        SeaPrior { variance: std * std, ..self }
    }

    /// What is stated, 1-sigma of a component, m.
    #[must_use]
    pub fn stated_std(&self) -> f64 {
        self.variance.sqrt()
    }

    /// Logarithms of the odds of the kinds before anything was seen.
    #[must_use]
    pub fn odds(&self) -> Vec<f64> {
        self.kinds.iter().map(|kind| kind.odds).collect()
    }

    /// What each kind foretells from so many samples before.
    pub fn foretold(&self, lags: usize) -> impl Iterator<Item = &Foretold> {
        self.kinds.iter().map(move |kind| &kind.foretold[lags])
    }

    /// Variance of one component of the displacement, m^2, when `weight` samples had a mean square of `seen`, m^2.
    #[must_use]
    pub fn variance(&self, weight: f64, seen: f64) -> f64 {
        let stated = STATED_SAMPLES * (-weight / STATED_UNTIL).exp();
        (stated * STATED_DOUBT * self.variance + weight * seen) / (stated + weight)
    }

    /// The products of samples and those before them that the kinds together are worth, if they have these logarithms of their odds, of a displacement
    /// of `variance`, m^2.
    pub(super) fn moments(&self, odds: &[f64], variance: f64) -> DMatrix<f64> {
        let most = odds.iter().copied().fold(f64::MIN, f64::max);
        let shares: Vec<f64> = odds.iter().map(|log| (log - most).exp()).collect();
        let scale = SAMPLES * variance / shares.iter().sum::<f64>();
        let mut products = vec![0.0; self.kinds[0].correlations.len()];
        for (kind, share) in self.kinds.iter().zip(&shares) {
            for (product, correlation) in products.iter_mut().zip(&kind.correlations) {
                *product += scale * share * correlation;
            }
        }
        block_toeplitz(&products)
    }
}

/// Products of the two components of samples, alike and independent, by how many lags lie between.
fn block_toeplitz(products: &[f64]) -> DMatrix<f64> {
    let size = 2 * products.len();
    DMatrix::from_fn(size, size, |i, j| {
        let is_same_axis = i % 2 == j % 2;
        if is_same_axis { products[(i / 2).abs_diff(j / 2)] } else { 0.0 }
    })
}

impl Kind {
    /// Of swaying and waves that are correlated so from lag to lag, and share the variance.
    fn new(band: &[f64], waves: &[f64], swaying: f64, odds: f64) -> Self {
        let mut correlations: Vec<f64> =
            band.iter().zip(waves).map(|(of, by)| swaying * of + (1.0 - swaying) * by).collect();
        correlations[0] += WHITE;
        let order = correlations.len() - 1;
        let foretold = (0..=order).map(|lags| Foretold::from(&correlations, lags)).collect();
        Kind { correlations, foretold, odds }
    }
}

impl Foretold {
    /// By the correlations of samples at every lag (the equations of Yule and Walker).
    fn from(correlations: &[f64], lags: usize) -> Self {
        let among = DMatrix::from_fn(lags, lags, |i, j| correlations[i.abs_diff(j)]);
        let across = DVector::from_fn(lags, |i, _| correlations[i + 1]);
        let solved = Cholesky::new(among).map(|root| root.solve(&across));
        let lags = solved.unwrap_or_else(|| DVector::zeros(lags));
        let unexplained = correlations[0] - across.dot(&lags);
        Foretold { lags: lags.as_slice().to_vec(), unexplained }
    }
}

/// Correlation over `apart` seconds of an oscillation whose period lies anywhere in a band.
fn mean_cosine((shortest, longest): (f64, f64), apart: f64) -> f64 {
    let ratio: f64 = longest / shortest;
    let (first, step) =
        (shortest * ratio.powf(0.5 / f64::from(GRID)), ratio.powf(1.0 / f64::from(GRID)));
    let periods = std::iter::successors(Some(first), |period| Some(period * step));
    let cosines = periods.take(GRID as usize).map(|period| (TAU * apart / period).cos());
    cosines.sum::<f64>() / f64::from(GRID)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn an_oscillation_is_correlated_as_a_cosine() {
        assert_relative_eq!(mean_cosine((60.0, 60.000_1), 15.0), 0.0, epsilon = 1e-5);
        assert_relative_eq!(mean_cosine((60.0, 60.000_1), 30.0), -1.0, epsilon = 1e-5);
    }

    #[test]
    fn the_likely_kind_is_what_the_model_begins_with() {
        let prior = SeaPrior::new(4.0, 12);
        let distance = |odds: &[f64], kind: usize| {
            let own = block_toeplitz(&prior.kinds[kind].correlations) * SAMPLES;
            (prior.moments(odds, 1.0) - own).norm()
        };
        for likely in 0..prior.kinds.len() {
            let odds: Vec<f64> = (0..prior.kinds.len())
                .map(|kind| if kind == likely { 30.0 } else { 0.0 })
                .collect();
            assert!(distance(&odds, likely) < 1e-6);
            assert!(distance(&prior.odds(), likely) > 1.0);
        }
    }

    #[test]
    fn a_slow_swaying_is_foretold_and_waves_are_not() {
        let correlations = |band| -> Vec<f64> {
            (0..=8).map(|lag| mean_cosine(band, f64::from(lag) * 4.0)).collect()
        };
        let (band, waves) = (correlations((100.0, 200.0)), correlations(WAVES));
        let of = |swaying: f64| Kind::new(&band, &waves, swaying, 0.0);
        let (slow, waves) = (of(0.98), of(0.0));
        assert!(slow.foretold[8].unexplained < 0.1, "{:?}", slow.foretold[8]);
        assert!(waves.foretold[8].unexplained > 0.5, "{:?}", waves.foretold[8]);
        assert_relative_eq!(slow.foretold[0].unexplained, 1.0 + WHITE, max_relative = 1e-9);
    }

    #[test]
    fn the_stated_displacement_is_forgotten_when_the_sea_was_seen() {
        let prior = SeaPrior::new(4.0, 2).stated(0.7);
        assert_relative_eq!(prior.variance(0.0, 0.0), STATED_DOUBT * 0.49, max_relative = 1e-12);
        assert_relative_eq!(prior.variance(200.0, 1e-4), 1e-4, max_relative = 0.05);
    }
}
