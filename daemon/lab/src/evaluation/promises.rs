//! What the alignment foresaw, held against what came of it.

use insd_base::{AlignmentStatus, Forecast, Time};
use serde::{Deserialize, Serialize};

use super::alignment::RunAlignment;
use super::statistics::quantile;
use crate::table::{Align, Table, significant};

/// Forecasts are scored as they stood at these instants, s.
const AT: [f64; 4] = [60.0, 120.0, 180.0, 240.0];
/// A forecast of the time from the start is good within this share of it.
const GOOD: f64 = 0.25;

/// The forecasts that the runs made at an instant.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PromiseEstimates {
    /// Instant, s.
    pub at_s: f64,
    /// Runs whose claim was not yet below the bar.
    pub runs: usize,
    /// Runs of these that named a time.
    pub named: usize,
    /// Runs of these that said that the bar is out of reach.
    pub unreachable: usize,
    /// Share of the runs that were right: they named the time, from the start, at which the claim
    /// first was below the bar within a quarter of it, or said of a run that never was that it would
    /// not be. Null if there are no runs.
    pub right: Option<f64>,
    /// Median of the named over the actual time.
    pub median_ratio: Option<f64>,
    /// Median 1-sigma, deg, that was called the best, where the bar was called out of reach.
    pub best_deg: Option<f64>,
}

/// A forecast of one run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Promise {
    /// When it was made, s.
    pub said_s: f64,
    /// The time that it named, s.
    pub ready_s: Option<f64>,
    /// The 1-sigma, rad, that it called the best if it called the bar out of reach.
    pub best: Option<f64>,
}

impl Promise {
    fn of(status: &AlignmentStatus) -> Self {
        Promise {
            said_s: status.time.as_seconds(),
            ready_s: status.ready.ready_at().map(Time::as_seconds),
            best: match status.ready {
                Forecast::Unreachable { best, .. } => Some(best),
                _ => None,
            },
        }
    }
}

/// The forecasts of one run as they stood at the first status at or after each of the instants.
#[must_use]
pub(super) fn promises(said: &[AlignmentStatus]) -> Vec<Option<Promise>> {
    let at = |at: f64| said.iter().find(|status| status.time >= Time::from_seconds(at));
    AT.into_iter().map(|instant| at(instant).map(Promise::of)).collect()
}

/// What became of one forecast.
struct Outcome {
    promise: Promise,
    actual: Option<f64>,
}

impl Outcome {
    /// Named over actual time.
    fn ratio(&self) -> Option<f64> {
        Some(self.promise.ready_s? / self.actual?)
    }

    fn is_right(&self) -> bool {
        match self.promise.best {
            Some(_) => self.actual.is_none(),
            None => self.ratio().is_some_and(|ratio| (ratio - 1.0).abs() <= GOOD),
        }
    }
}

/// The forecasts of all runs, at each instant at which some of them were not aligned. Empty where no
/// run said anything.
pub(super) fn together(
    runs: &[RunAlignment],
    said: &[Vec<Option<Promise>>],
) -> Vec<PromiseEstimates> {
    let at = |(index, at): (usize, f64)| {
        let promised = |said: &Vec<Option<Promise>>| said.get(index).copied().flatten();
        let pairs = runs.iter().zip(said);
        let outcomes: Vec<Outcome> =
            pairs.filter_map(|(run, said)| outcome(run, promised(said)?)).collect();
        (!outcomes.is_empty()).then(|| estimates(at, &outcomes))
    };
    AT.into_iter().enumerate().filter_map(at).collect()
}

/// A forecast that was made before the claim was below the bar.
fn outcome(run: &RunAlignment, promise: Promise) -> Option<Outcome> {
    let open = run.claim.is_none_or(|claim| claim > promise.said_s);
    open.then_some(Outcome { promise, actual: run.claim })
}

fn estimates(at_s: f64, outcomes: &[Outcome]) -> PromiseEstimates {
    let count = |is: fn(&Outcome) -> bool| outcomes.iter().filter(|o| is(o)).count();
    let best = |outcome: &Outcome| outcome.promise.best.map(f64::to_degrees);
    PromiseEstimates {
        at_s,
        runs: outcomes.len(),
        named: count(|o| o.promise.ready_s.is_some()),
        unreachable: count(|o| o.promise.best.is_some()),
        right: Some(count(Outcome::is_right) as f64 / outcomes.len() as f64),
        median_ratio: median(outcomes.iter().filter_map(Outcome::ratio)),
        best_deg: median(outcomes.iter().filter_map(best)),
    }
}

fn median(values: impl Iterator<Item = f64>) -> Option<f64> {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    (!sorted.is_empty()).then(|| quantile(&sorted, 0.5))
}

/// One row for each instant.
pub(super) fn table(promises: &[PromiseEstimates]) -> Table {
    let names =
        ["at s", "runs", "named", "never", "right %", "named / actual", "best deg if never"];
    let mut table = Table::new(&names.map(|name| (name, Align::Right)));
    let maybe = |value: Option<f64>| value.map_or("-".to_owned(), |value| significant(value, 3));
    for row in promises {
        table.push(vec![
            format!("{}", row.at_s),
            row.runs.to_string(),
            row.named.to_string(),
            row.unreachable.to_string(),
            row.right.map_or("-".to_owned(), |share| format!("{:.1}", 100.0 * share)),
            maybe(row.median_ratio),
            maybe(row.best_deg),
        ]);
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::{AlignmentPhase, Lack, Limiting};

    fn said(at: f64, ready: Forecast) -> AlignmentStatus {
        AlignmentStatus {
            time: Time::from_seconds(at),
            phase: AlignmentPhase::Fine,
            moored: true,
            sigma: None,
            target: None,
            gyrocompass: None,
            ready,
            sea: None,
            fit: None,
            shifts: 0,
        }
    }

    fn named(at: f64) -> Forecast {
        Forecast::Expected { at: Time::from_seconds(at), limiting: Limiting::Sea }
    }

    #[test]
    fn a_promise_is_right_within_a_quarter_of_the_time_from_the_start() {
        let runs =
            [200.0; 4].map(|at| RunAlignment { error: None, claim: Some(at), first: [None; 2] });
        let at_120 = [named(240.0), named(260.0), Forecast::Unknown { lacks: Lack::Time }];
        let mut statuses: Vec<_> =
            at_120.map(|ready| vec![said(60.0, named(900.0)), said(121.0, ready)]).to_vec();
        statuses
            .push(vec![said(121.0, Forecast::Unreachable { best: 1.0, limiting: Limiting::Sea })]);
        let said: Vec<_> = statuses.iter().map(|said| promises(said)).collect();
        let found = together(&runs, &said);
        assert_eq!(found.len(), 2, "nothing was said after 121 s");
        let at_120 = found[1];
        assert_eq!((at_120.runs, at_120.named, at_120.unreachable), (4, 2, 1));
        assert_eq!((at_120.right, at_120.median_ratio), (Some(0.25), Some(1.2)));
    }

    #[test]
    fn to_say_never_is_right_where_it_never_was() {
        let ready =
            Forecast::Unreachable { best: 2.0_f64.to_radians(), limiting: Limiting::GyroBias };
        let never = promises(&[said(240.0, ready)]);
        let found = together(&[RunAlignment::default()], &[never]);
        assert!(found.iter().all(|row| row.right == Some(1.0)), "{found:?}");
        assert!((found[0].best_deg.unwrap() - 2.0).abs() < 1e-9);
        assert!(together(&[RunAlignment::default()], &[vec![]]).is_empty());
    }
}
