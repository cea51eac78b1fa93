//! How often something was so, and what that proves.

use serde::Serialize;
use statrs::distribution::{Beta, ContinuousCDF};

/// Confidence of all intervals.
const CONFIDENCE: f64 = 0.95;

/// A number of epochs, and the interval in which the true share lies with 95 % confidence.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Tally {
    /// Epochs.
    pub epochs: u64,
    /// Of all epochs, 0 to 1.
    pub share: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end of the interval.
    pub high: f64,
    /// Pieces of time without a break.
    pub pieces: u64,
    /// How long in all, s.
    pub total_s: f64,
    /// The longest piece, s.
    pub longest_s: f64,
    /// When it first was so, s; null if it never was.
    pub first_s: Option<f64>,
}

/// The interval of Clopper and Pearson (1934) for a share that was seen in `samples` independent samples, which need
/// not be a whole number: two-sided, but one-sided where nothing or everything was seen. So 0 of n allows 3 / n.
#[must_use]
pub fn share_of_independent(share: f64, samples: f64) -> (f64, f64) {
    if samples.is_nan() || samples <= 0.0 || share.is_nan() {
        return (0.0, 1.0);
    }
    let (seen, tail) = (share * samples, 0.5 * (1.0 - CONFIDENCE));
    if share <= 0.0 {
        return (0.0, 1.0 - (1.0 - CONFIDENCE).powf(1.0 / samples));
    }
    if share >= 1.0 {
        return ((1.0 - CONFIDENCE).powf(1.0 / samples), 1.0);
    }
    let end = |a: f64, b: f64, p: f64| Beta::new(a, b).ok().map(|beta| beta.inverse_cdf(p));
    let low = end(seen, samples - seen + 1.0, tail).unwrap_or(0.0);
    let high = end(seen + 1.0, samples - seen, 1.0 - tail).unwrap_or(1.0);
    (low.clamp(0.0, share), high.clamp(share, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_seen_in_n_samples_allows_three_in_n() {
        for samples in [30.0, 1000.0, 250_000.0] {
            let (low, high) = share_of_independent(0.0, samples);
            assert!(low == 0.0 && (2.8..3.0).contains(&(high * samples)), "{high}");
            let (low, high) = share_of_independent(1.0, samples);
            assert!(high == 1.0 && (2.8..3.0).contains(&((1.0 - low) * samples)), "{low}");
        }
    }

    #[test]
    fn the_interval_is_that_of_the_tables() {
        // 5 of 50 and 1 of 10, R: binom.test
        let (low, high) = share_of_independent(0.1, 50.0);
        assert!((low - 0.033_275_09).abs() < 1e-6 && (high - 0.218_135_4).abs() < 1e-6);
        let (low, high) = share_of_independent(0.1, 10.0);
        assert!((low - 0.002_528_579).abs() < 1e-6 && (high - 0.445_016_1).abs() < 1e-6);
    }

    #[test]
    fn less_than_one_sample_proves_nothing() {
        assert_eq!(share_of_independent(0.0, 0.0), (0.0, 1.0));
        assert_eq!(share_of_independent(f64::NAN, 10.0), (0.0, 1.0));
        let (low, high) = share_of_independent(0.01, 1.0);
        assert!(low < 0.01 && high > 0.9, "{low} {high}");
    }
}
