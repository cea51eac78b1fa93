//! What is known of the displacement of a moored ship before it has been seen: kinds of sea, each as the products of
//! consecutive samples that it would give.
//!
//! A kind is a band of swaying on the moorings, even in the logarithm of the period, and a share of waves of 4 to 20 s,
//! which at a spacing of some seconds are nearly white. It counts as so many samples that were seen before the first
//! (a conjugate prior of the regression; Kadiyala and Karlsson, J. Applied Econometrics 12 (1997)), and the kinds are
//! weighed by how well they foretold what was seen since (their marginal likelihood; Bishop, Pattern Recognition and
//! Machine Learning, section 3.4).

use std::f64::consts::TAU;
use std::sync::Arc;

use nalgebra::{Cholesky, DMatrix};

/// Bands of swaying, s. The first is for moorings of any kind.
const BANDS: [(f64, f64); 5] =
    [(25.0, 180.0), (20.0, 50.0), (40.0, 90.0), (60.0, 150.0), (100.0, 200.0)];
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
const STATED_DOUBT: f64 = 1.5;
/// Intervals of the quadrature over a band.
const GRID: u32 = 200;

/// A kind of sea.
#[derive(Clone, Debug)]
struct Kind {
    /// Products of samples and those before them, of [`SAMPLES`] samples of a displacement of 1 m.
    moments: DMatrix<f64>,
    /// Logarithm of the evidence of these alone.
    evidence: f64,
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
        let of = |band: (f64, f64), swaying: f64| Kind::new(band, swaying, spacing, order);
        let kinds = BANDS.into_iter().flat_map(|band| SWAYING.map(|swaying| of(band, swaying)));
        SeaPrior { kinds: Arc::new(kinds.collect()), variance: 0.0 }
    }

    /// The same where the displacement of one component is stated to be `std`, 1-sigma, m.
    #[must_use]
    pub fn stated(self, std: f64) -> Self {
        SeaPrior { variance: std * std, ..self }
    }

    /// Variance of the displacement when `weight` samples had a mean square of `seen`, m^2.
    pub(super) fn variance(&self, weight: f64, seen: f64) -> f64 {
        let stated = STATED_SAMPLES * (-weight / STATED_UNTIL).exp();
        (stated * STATED_DOUBT * self.variance + weight * seen) / (stated + weight)
    }

    /// The products that the kinds together are worth when the sums of products `moments` of samples with this weight
    /// were seen, of a displacement of `variance`, m^2.
    pub(super) fn moments(
        &self,
        moments: &DMatrix<f64>,
        weight: f64,
        variance: f64,
    ) -> DMatrix<f64> {
        let surprise = |kind: &Kind| {
            let after = &kind.moments * variance + moments;
            evidence(&after, SAMPLES + weight).map_or(f64::NEG_INFINITY, |log| log - kind.evidence)
        };
        let logs: Vec<f64> = self.kinds.iter().map(surprise).collect();
        let most = logs.iter().copied().fold(f64::MIN, f64::max);
        let shares: Vec<f64> = logs.iter().map(|log| (log - most).exp()).collect();
        let scale = variance / shares.iter().sum::<f64>();
        let none = DMatrix::zeros(moments.nrows(), moments.ncols());
        let kinds = self.kinds.iter().zip(&shares);
        kinds.fold(none, |sum, (kind, share)| sum + &kind.moments * (share * scale))
    }
}

impl Kind {
    fn new(band: (f64, f64), swaying: f64, spacing: f64, order: usize) -> Self {
        let correlation = |lag: usize| {
            let apart = lag as f64 * spacing;
            let white = if lag == 0 { WHITE } else { 0.0 };
            swaying * mean_cosine(band, apart) + (1.0 - swaying) * mean_cosine(WAVES, apart) + white
        };
        let correlations: Vec<f64> = (0..=order).map(correlation).collect();
        let size = 2 * (order + 1);
        let moments = DMatrix::from_fn(size, size, |i, j| {
            let is_same_axis = i % 2 == j % 2;
            let correlation = correlations[(i / 2).abs_diff(j / 2)];
            if is_same_axis { SAMPLES * correlation } else { 0.0 }
        });
        let evidence = evidence(&moments, SAMPLES).unwrap_or(f64::INFINITY);
        Kind { moments, evidence }
    }
}

/// Correlation over `apart` seconds of an oscillation whose period lies anywhere in a band.
fn mean_cosine((shortest, longest): (f64, f64), apart: f64) -> f64 {
    let ratio: f64 = longest / shortest;
    let cosine = |i: u32| {
        let period = shortest * ratio.powf((f64::from(i) + 0.5) / f64::from(GRID));
        (TAU * apart / period).cos()
    };
    (0..GRID).map(cosine).sum::<f64>() / f64::from(GRID)
}

/// Logarithm of the evidence of sums of products of so many samples, but for what all kinds have in common: with R
/// the part of the regressors and S what they do not explain,
///
/// log p = -(m/2) log det R - (n/2) log det S,   m = 2 components.
fn evidence(moments: &DMatrix<f64>, samples: f64) -> Option<f64> {
    // the newest last: its pivots are the root of what its past does not explain
    let last = moments.nrows() - 1;
    let turned = DMatrix::from_fn(last + 1, last + 1, |i, j| moments[(last - i, last - j)]);
    let root = Cholesky::new(turned)?;
    let pivots = root.l_dirty().diagonal().map(f64::ln);
    let regressors = pivots.rows(0, last - 1).sum();
    let unexplained = pivots.rows(last - 1, 2).sum();
    Some(-2.0 * regressors - samples * unexplained)
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
    fn what_was_seen_of_a_kind_makes_it_the_likely_one() {
        let (spacing, order) = (4.0, 12);
        let prior = SeaPrior::new(spacing, order);
        let swaying = |band| Kind::new(band, 0.9, spacing, order).moments;
        for (index, band) in BANDS.into_iter().enumerate().skip(1) {
            let seen = swaying(band) * 4.0;
            let worth = prior.moments(&seen, 4.0 * SAMPLES, 1.0);
            let distance = |other: usize| (&worth - swaying(BANDS[other])).norm();
            let nearest = (0..BANDS.len()).min_by(|a, b| distance(*a).total_cmp(&distance(*b)));
            assert_eq!(nearest, Some(index), "{band:?}");
        }
    }

    #[test]
    fn the_stated_displacement_is_forgotten_when_the_sea_was_seen() {
        let prior = SeaPrior::new(4.0, 2).stated(0.7);
        assert_relative_eq!(prior.variance(0.0, 0.0), STATED_DOUBT * 0.49, max_relative = 1e-12);
        assert_relative_eq!(prior.variance(200.0, 1e-4), 1e-4, max_relative = 0.05);
    }
}
