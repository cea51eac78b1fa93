//! The best sum of the bank's signals under a covariance of their errors.
//!
//! The estimate y_last + c h has the error e_0 - c h; its variance is least for
//!
//! c = C_hh^-1 C_h0,   sigma^2 = C_00 - C_0h C_hh^-1 C_h0,
//!
//! the combination of estimates of Bates and Granger, The Combination of Forecasts, Operational Research
//! Quarterly 20 (1969).

use nalgebra::{Cholesky, Const, SMatrix, SVector};

use super::bank::{SIGNALS, Signals, TAKEN};
use super::model::Errors;

/// Products of what the sections took away.
pub(super) type Taken = SMatrix<f64, TAKEN, TAKEN>;
/// One number for each part that was taken away.
pub(super) type Parts = SVector<f64, TAKEN>;

/// Share of each variance that is added to it, so that rounding leaves the covariance positive.
const ROUNDING: f64 = 1e-9;
/// Variance that is added to each, m^2: a tenth of a millimetre.
const LEAST: f64 = 1e-8;

/// The weights of the parts that were taken away, and the sigma of the sum, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Combination {
    pub(super) weights: Parts,
    pub(super) sigma: f64,
}

impl Combination {
    /// Nothing is given back.
    pub(super) fn none() -> Self {
        Combination { weights: Parts::zeros(), sigma: f64::INFINITY }
    }

    /// The best sum; `None` if the covariance is none.
    pub(super) fn best(errors: &Errors) -> Option<Self> {
        let shared: Parts = errors.fixed_view::<TAKEN, 1>(0, TAKEN).into_owned();
        let weights = factor(errors)?.solve(&shared);
        let variance = errors[(TAKEN, TAKEN)] + LEAST - weights.dot(&shared);
        let sigma = variance.max(LEAST).sqrt();
        (sigma.is_finite() && weights.iter().all(|w| w.is_finite()))
            .then_some(Combination { weights, sigma })
    }

    /// What is left of the bank's signals, with the weighed share of what was taken away.
    pub(super) fn sum(&self, signals: &Signals) -> f64 {
        signals[TAKEN] + self.weights.dot(&parts(signals))
    }
}

/// What the sections took away.
pub(super) fn parts(signals: &Signals) -> Parts {
    signals.fixed_rows::<TAKEN>(0).into_owned()
}

/// How well a covariance explains what was seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Fit {
    /// Mean normalised square: one if the covariance is right, more if it is too small.
    pub(super) misfit: f64,
    /// Minus twice the logarithm of the likelihood of one sight, but for a constant.
    pub(super) cost: f64,
}

impl Fit {
    /// The fit of a covariance to the mean products `seen` of the parts taken away.
    pub(super) fn of(errors: &Errors, seen: &Taken) -> Option<Self> {
        let factor = factor(errors)?;
        let misfit = factor.solve(seen).trace() / TAKEN as f64;
        let log: f64 = factor.l_dirty().diagonal().iter().map(|d| d.ln()).sum();
        Some(Fit { misfit, cost: 2.0 * log + misfit * TAKEN as f64 })
    }
}

/// Mean normalised square of errors under a covariance: about one if they come from it.
pub(super) fn normalised_square(covariance: &Errors, errors: &Signals) -> Option<f64> {
    let mut covariance = *covariance;
    for i in 0..SIGNALS {
        covariance[(i, i)] += ROUNDING * covariance[(i, i)] + LEAST;
    }
    let solved = Cholesky::new(covariance)?.solve(errors);
    Some(solved.dot(errors) / SIGNALS as f64)
}

fn factor(errors: &Errors) -> Option<Cholesky<f64, Const<TAKEN>>> {
    let mut taken: Taken = errors.fixed_view::<TAKEN, TAKEN>(0, 0).into_owned();
    for i in 0..TAKEN {
        taken[(i, i)] += ROUNDING * taken[(i, i)] + LEAST;
    }
    Cholesky::new(taken)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_best_sum_gives_back_what_the_error_has_in_common_with_a_part() {
        let mut errors = Errors::identity();
        errors[(0, TAKEN)] = 0.6;
        errors[(TAKEN, 0)] = 0.6;
        let best = Combination::best(&errors).unwrap();
        assert!((best.weights[0] - 0.6).abs() < 1e-6 && best.weights[1].abs() < 1e-12);
        assert!((best.sigma - 0.8).abs() < 1e-6, "{}", best.sigma);
        let mut signals = Signals::zeros();
        (signals[0], signals[TAKEN]) = (2.0, 1.0);
        assert!((best.sum(&signals) - 2.2).abs() < 1e-6);
    }

    #[test]
    fn a_covariance_fits_what_comes_from_it() {
        let errors = Errors::identity() * 4.0;
        let fit = Fit::of(&errors, &(Taken::identity() * 4.0)).unwrap();
        assert!((fit.misfit - 1.0).abs() < 1e-6, "{fit:?}");
        for other in [1.0, 16.0] {
            let worse = Fit::of(&(Errors::identity() * other), &(Taken::identity() * 4.0)).unwrap();
            assert!(worse.cost > fit.cost, "{worse:?}");
        }
    }

    #[test]
    fn what_is_no_covariance_gives_no_sum() {
        assert!(Combination::best(&(Errors::identity() * -1.0)).is_none());
        assert!(Combination::best(&(Errors::identity() * f64::NAN)).is_none());
    }
}
