//! When the heading is good enough, in truth and by its claim, and where the claim is worst.

use insd_base::units::DEG;
use serde::{Deserialize, Serialize};

use super::alignment::RunAlignment;
use super::component::Component;
use super::errors::{EpochError, normalised};
use super::promises::{self, Promise, PromiseEstimates};
use super::statistics::quantile;
use crate::table::{Align, Table, significant};

/// The largest error of the heading in terms of its claimed sigma, of one run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct WorstHeading {
    /// |error| / sigma.
    pub ratio: f64,
    /// Where, s.
    pub at_s: f64,
}

/// The same over all runs.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct WorstRun {
    /// Seed of the run.
    pub seed: u64,
    /// The largest ratio of that run.
    #[serde(flatten)]
    pub worst: WorstHeading,
}

/// Times of alignment over the runs, s; null where so many runs never were aligned.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Times {
    /// Half of the runs are not later.
    pub median_s: Option<f64>,
    /// Nine tenths are not later.
    pub p90_s: Option<f64>,
    /// The last.
    pub max_s: Option<f64>,
    /// Runs that never were.
    pub never: usize,
}

/// When the runs are aligned.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AlignedEstimates {
    /// What counts as aligned, deg: 0.1 deg times the secant of the latitude.
    pub bar_deg: f64,
    /// From when on the error stays below the bar.
    pub error: Times,
    /// When the claim first is below it.
    pub claim: Times,
    /// What was foreseen of that.
    pub promises: Vec<PromiseEstimates>,
    /// When the claim first is below 2 deg.
    pub claim_2_deg: Times,
    /// When the claim first is below 1 deg.
    pub claim_1_deg: Times,
}

/// The epoch at which the error of the heading is largest in terms of its claim.
#[must_use]
pub fn worst_heading(epochs: &[EpochError]) -> Option<WorstHeading> {
    let heading = Component::Heading;
    let ratio = |e: &EpochError| {
        let ratio = normalised(e.of(heading)?, e.sigma_of(heading))?.abs();
        Some(WorstHeading { ratio, at_s: e.time.as_seconds() })
    };
    epochs.iter().filter_map(ratio).max_by(|a, b| a.ratio.total_cmp(&b.ratio))
}

/// The runs put together.
pub(super) fn together(
    bar: f64,
    runs: &[RunAlignment],
    said: &[Vec<Option<Promise>>],
) -> AlignedEstimates {
    AlignedEstimates {
        bar_deg: bar / DEG,
        error: times(runs.iter().map(|run| run.error)),
        claim: times(runs.iter().map(|run| run.claim)),
        promises: promises::together(runs, said),
        claim_2_deg: times(runs.iter().map(|run| run.first[0])),
        claim_1_deg: times(runs.iter().map(|run| run.first[1])),
    }
}

/// Quantiles of times of which some are never.
pub(super) fn times(of_runs: impl Iterator<Item = Option<f64>>) -> Times {
    let mut sorted: Vec<f64> = of_runs.map(|time| time.unwrap_or(f64::INFINITY)).collect();
    sorted.sort_by(f64::total_cmp);
    let at = |p| Some(quantile(&sorted, p)).filter(|time| time.is_finite());
    Times {
        median_s: at(0.5),
        p90_s: at(0.9),
        max_s: at(1.0),
        never: sorted.iter().filter(|time| time.is_infinite()).count(),
    }
}

/// A row for the error and one for the claim.
pub(super) fn table(aligned: &AlignedEstimates) -> Table {
    let names = ["median s", "90 % s", "max s", "never"];
    let mut columns = vec![("aligned", Align::Left)];
    columns.extend(names.map(|name| (name, Align::Right)));
    let mut table = Table::new(&columns);
    let time = |time: Option<f64>| time.map_or("-".to_owned(), |time| significant(time, 4));
    for (name, times) in [
        ("error stays below", &aligned.error),
        ("claimed σ first below", &aligned.claim),
        ("claimed σ first below 2 deg", &aligned.claim_2_deg),
        ("claimed σ first below 1 deg", &aligned.claim_1_deg),
    ] {
        let quantiles = [times.median_s, times.p90_s, times.max_s].map(time);
        let mut row = vec![name.to_owned()];
        row.extend(quantiles);
        row.push(times.never.to_string());
        table.push(row);
    }
    table
}

#[cfg(test)]
mod tests {
    use super::super::alignment::alignment;
    use super::*;
    use insd_base::Time;

    fn run(of: impl Fn(f64) -> (f64, f64)) -> Vec<EpochError> {
        let epoch = |t: i32| {
            let (error, sigma) = of(f64::from(t));
            let time = Time::from_seconds(f64::from(t));
            EpochError { time, error: [Some(error); 9], sigma: [sigma; 9] }
        };
        (0..100).map(epoch).collect()
    }

    #[test]
    fn a_heading_that_passes_zero_is_not_aligned_until_it_stays_there() {
        let wild = run(|t| (if t < 50.0 { (t - 20.0) / 100.0 } else { -0.01 }, 1.0 / (t + 1.0)));
        let first = [Some(28.0), Some(57.0)];
        let found = RunAlignment { error: Some(50.0), claim: Some(10.0), first };
        assert_eq!(alignment(&wild, 0.1), found);
        let lost = run(|t| (t / 50.0, 1.0));
        assert_eq!(alignment(&lost, 0.1), RunAlignment::default());
        assert_eq!(alignment(&run(|_| (0.0, 0.0)), 0.1).error, Some(0.0));
        assert_eq!(alignment(&[], 0.1), RunAlignment::default());
    }

    #[test]
    fn the_worst_heading_is_that_of_the_boldest_claim() {
        let epochs =
            run(|t| (if t == 30.0 { -0.5 } else { 1.0 }, if t == 30.0 { 0.1 } else { 1.0 }));
        assert_eq!(worst_heading(&epochs), Some(WorstHeading { ratio: 5.0, at_s: 30.0 }));
        assert_eq!(worst_heading(&run(|_| (1.0, 0.0))), None);
    }

    #[test]
    fn runs_that_never_align_count_as_the_latest() {
        let (claim, first) = (Some(1.0), [None, Some(2.0)]);
        let runs: Vec<RunAlignment> =
            (1..=9).map(|i| RunAlignment { error: Some(f64::from(i)), claim, first }).collect();
        let never = RunAlignment { error: None, claim, first };
        let all = together(0.1 * DEG, &[&runs[..], &[never]].concat(), &[]);
        assert_eq!(
            all.error,
            Times { median_s: Some(5.0), p90_s: Some(9.0), max_s: None, never: 1 }
        );
        assert_eq!(all.claim.max_s, Some(1.0));
        assert!((all.bar_deg - 0.1).abs() < 1e-12);
    }
}
