//! The chi-square gate.

use statrs::distribution::{ChiSquared, ContinuousCDF};

/// Limits of normalised innovations squared of any number of rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gate {
    probability: f64,
    limits: [f64; FEW],
}

/// Rows for which the limits are worked out beforehand.
const FEW: usize = 6;

impl Gate {
    /// A gate that lets good measurements pass with this probability.
    #[must_use]
    pub fn new(probability: f64) -> Self {
        let limits = std::array::from_fn(|i| quantile(i + 1, probability));
        Gate { probability, limits }
    }

    /// Greatest normalised innovation squared of so many rows that passes.
    #[must_use]
    pub fn limit(&self, rows: usize) -> f64 {
        match rows.checked_sub(1).and_then(|i| self.limits.get(i)) {
            Some(limit) => *limit,
            None => quantile(rows, self.probability),
        }
    }
}

/// Quantile of chi-square; infinite of no degree of freedom.
fn quantile(freedom: usize, probability: f64) -> f64 {
    ChiSquared::new(freedom as f64).map_or(f64::INFINITY, |d| d.inverse_cdf(probability))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_agree_with_tables() {
        let gate = Gate::new(0.999);
        let table = [(1, 10.828), (2, 13.816), (3, 16.266), (10, 29.588), (30, 59.703)];
        for (rows, limit) in table {
            assert!((gate.limit(rows) - limit).abs() < 0.01, "{rows}");
        }
        assert!(gate.limit(0).is_infinite());
    }
}
