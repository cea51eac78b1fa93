//! Integer least squares: the whole numbers that are nearest to measured ones whose errors hang together.
//!
//! Minimises `(a - z)' Q^-1 (a - z)` over vectors of integers z (Teunissen, "The least-squares ambiguity decorrelation adjustment", 1995) by reduction and
//! search as in Chang, Yang and Zhou, "MLAMBDA: a modified LAMBDA method for integer least-squares estimation", Journal of Geodesy 79, 2005.

mod reduction;
mod search;

use std::fmt;

use nalgebra::{DMatrix, DVector};
use statrs::function::erf::erf;

use reduction::Reduced;

/// A vector of integers, and how far it lies from the measured one.
#[derive(Clone, Debug, PartialEq)]
pub struct IntegerVector {
    /// The integers.
    pub integers: Vec<i64>,
    /// `(a - z)' Q^-1 (a - z)`, no unit.
    pub distance: f64,
}

/// Why there are no nearest integers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IntegerRefusal {
    /// Numbers and covariance do not fit, are none, are not finite, or too large to be counted.
    Malformed,
    /// The covariance is not positive definite.
    NotDefinite,
    /// The measured numbers are so poor that the search did not end.
    TooMany,
}

impl fmt::Display for IntegerRefusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Malformed => "measured numbers and their covariance are not usable",
            Self::NotDefinite => "the covariance is not positive definite",
            Self::TooMany => "too many integers are as near",
        })
    }
}

/// Measured numbers, made ready for the search.
#[derive(Clone, Debug)]
pub struct IntegerSearch {
    reduced: Reduced,
    /// Whole parts, taken off so that phases counted in millions keep their digits.
    whole: Vec<i64>,
    rest: DVector<f64>,
}

impl IntegerSearch {
    /// Of measured numbers (cycles) and their covariance (cycles^2).
    ///
    /// # Errors
    /// [`IntegerRefusal`] where they are not usable.
    pub fn new(measured: &DVector<f64>, covariance: &DMatrix<f64>) -> Result<Self, IntegerRefusal> {
        let count = measured.len();
        let countable = |x: &f64| x.abs() < 1e15;
        let finite = covariance.iter().all(|x| x.is_finite()) && measured.iter().all(countable);
        if count == 0 || covariance.shape() != (count, count) || !finite {
            return Err(IntegerRefusal::Malformed);
        }
        let whole: Vec<i64> = measured.iter().map(|x| x.round() as i64).collect();
        let rest = DVector::from_fn(count, |i, _| measured[i] - whole[i] as f64);
        let reduced = Reduced::new(covariance).ok_or(IntegerRefusal::NotDefinite)?;
        Ok(Self { reduced, whole, rest })
    }

    /// The nearest vectors, nearest first.
    ///
    /// # Errors
    /// [`IntegerRefusal::TooMany`] where the search does not end.
    pub fn nearest(&self, count: usize) -> Result<Vec<IntegerVector>, IntegerRefusal> {
        let measured = self.reduced.forth(&self.rest);
        let found =
            search::nearest(&self.reduced, &measured, count).ok_or(IntegerRefusal::TooMany)?;
        let vector = |(integers, distance): (Vec<i64>, f64)| {
            let back = self.reduced.back(&integers).ok_or(IntegerRefusal::Malformed)?;
            let sum = |(own, whole): (&i64, &i64)| own.saturating_add(*whole);
            let integers = back.iter().zip(&self.whole).map(sum).collect();
            Ok(IntegerVector { integers, distance })
        };
        found.into_iter().map(vector).collect()
    }

    /// The chance that rounding one number after the other in the light of those before, which is no better than the search, finds the true integers
    /// if the covariance is true: `prod (2 Phi(1 / 2 sigma) - 1)` over the conditional sigmas (Teunissen, "Success probability of integer GPS
    /// ambiguity rounding and bootstrapping", 1998).
    #[must_use]
    pub fn success(&self) -> f64 {
        let root = 2.0 * std::f64::consts::SQRT_2;
        self.reduced.variances().map(|variance| erf(1.0 / (root * variance.sqrt()))).product()
    }
}

#[cfg(test)]
mod tests;
