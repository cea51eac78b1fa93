//! Means over independent runs with their confidence.

use serde::Serialize;

use super::statistics::mean;

/// Two-sided 95 % point of the normal distribution.
const NORMAL_95: f64 = 1.959_964;

/// A mean over seeds and its 95 % confidence interval, mean +- 1.96 s / sqrt(n). Epochs of one run
/// are correlated, runs with different seeds are not.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct MeanOfRuns {
    /// Mean over the runs.
    pub mean: f64,
    /// Lower end; absent for a single run.
    pub low: Option<f64>,
    /// Upper end; absent for a single run.
    pub high: Option<f64>,
}

impl MeanOfRuns {
    /// The estimate from one value for each run; `None` without any.
    #[must_use]
    pub fn from_runs(values: &[f64]) -> Option<Self> {
        if values.is_empty() {
            return None;
        }
        let centre = mean(values.iter().copied());
        let count = values.len() as f64;
        let half_width = (values.len() > 1).then(|| {
            let squares: f64 = values.iter().map(|value| (value - centre).powi(2)).sum();
            NORMAL_95 * (squares / (count - 1.0) / count).sqrt()
        });
        let (low, high) = (half_width.map(|h| centre - h), half_width.map(|h| centre + h));
        Some(MeanOfRuns { mean: centre, low, high })
    }

    /// The same with an interval that stays where the quantity can be: a share in [0, 1], a mean of
    /// squares above 0.
    #[must_use]
    pub fn within(self, low: f64, high: f64) -> Self {
        let clamped = |end: Option<f64>| end.map(|end| end.clamp(low, high));
        MeanOfRuns { low: clamped(self.low), high: clamped(self.high), ..self }
    }

    /// The estimate of a root mean square from the RMS of each run: squares are averaged.
    #[must_use]
    pub fn of_rms(values: &[f64]) -> Option<Self> {
        let squares: Vec<f64> = values.iter().map(|value| value * value).collect();
        let root = |square: f64| square.max(0.0).sqrt();
        Self::from_runs(&squares).map(|square| MeanOfRuns {
            mean: root(square.mean),
            low: square.low.map(root),
            high: square.high.map(root),
        })
    }
}

/// `1.02 [0.98, 1.06]`
pub(super) fn shown(estimate: &MeanOfRuns, text: impl Fn(f64) -> String) -> String {
    match (estimate.low, estimate.high) {
        (Some(low), Some(high)) => {
            format!("{} [{}, {}]", text(estimate.mean), text(low), text(high))
        }
        _ => text(estimate.mean),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    #[test]
    fn the_interval_holds_the_true_mean_about_95_times_in_100() {
        let mut random = rand_pcg::Pcg64::seed_from_u64(3);
        let holds = |_: &u32| {
            let values: Vec<f64> = (0..40).map(|_| 5.0 + sample(&mut random)).collect();
            let estimate = MeanOfRuns::from_runs(&values).unwrap();
            (estimate.low.unwrap()..estimate.high.unwrap()).contains(&5.0)
        };
        let hits = (0..1000).filter(holds).count();
        assert!((925..=970).contains(&hits), "{hits}");
    }

    fn sample(random: &mut rand_pcg::Pcg64) -> f64 {
        StandardNormal.sample(random)
    }

    #[test]
    fn a_single_run_has_no_interval() {
        assert_eq!(
            MeanOfRuns::from_runs(&[2.0]),
            Some(MeanOfRuns { mean: 2.0, low: None, high: None })
        );
        assert_eq!(MeanOfRuns::from_runs(&[]), None);
    }

    #[test]
    fn the_interval_of_a_share_ends_at_one() {
        let estimate = MeanOfRuns::from_runs(&[0.9, 1.0]).unwrap().within(0.0, 1.0);
        assert_eq!(estimate.high, Some(1.0));
    }

    #[test]
    fn an_rms_over_runs_averages_the_squares() {
        let estimate = MeanOfRuns::of_rms(&[3.0, 4.0]).unwrap();
        assert!((estimate.mean - 12.5_f64.sqrt()).abs() < 1e-12);
    }
}
