//! The Stanford chart: errors of the position against the protection levels that were told with them, at an alert
//! limit.
//!
//! A row is *unavailable* where its level is no smaller than the limit or not known, or where the row itself says
//! that it is not to be used (mode or `integrity`). All others are *nominal* where the error is within the level,
//! *hazardous* where it is beyond the limit, and *misleading* where it is between the two. An error beyond the level
//! of a row that is not available misleads nobody, but the level did not hold: it is counted, too.

mod limit;
mod sample;
mod table;
mod tally;

use insd_base::Time;
use insd_drivers::recording::{NavRow, Rows};
use serde::Serialize;

use super::component::Component;
use super::errors::VoyageErrors;
use super::evidence::{Judged, Pieces, Step, in_order, is_told, judge, measure};
use super::statistics::quantile;
pub use limit::AlertLimit;
use sample::{Independence, independence};
pub use tally::{Tally, share_of_independent};

/// Where an epoch stands in the chart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum StanfordClass {
    /// The error is within the level, the level within the limit.
    Nominal,
    /// The error is beyond the level and within the limit.
    Misleading,
    /// The error is beyond the limit, the level within it.
    Hazardous,
    /// The level is not within the limit, or the row is told not to be used.
    Unavailable,
}

/// An epoch in the chart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StanfordPoint {
    /// Instant.
    pub time: Time,
    /// Size of the error, m.
    pub error: f64,
    /// Protection level, m; `None` where it is not known.
    pub level: Option<f64>,
    /// Whether the row may be used, for all that mode and integrity say.
    pub is_told: bool,
}

/// Errors and levels of an axis, horizontal or vertical. The field names are the keys of the JSON.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LevelsOfAxis {
    /// Alert limit, m.
    pub limit_m: f64,
    /// Epochs with a row and a true position.
    pub epochs: u64,
    /// Level within the limit, and the row may be used.
    pub available: Tally,
    /// Of those: error within the level.
    pub nominal: Tally,
    /// Of those: error beyond the level, within the limit.
    pub misleading: Tally,
    /// Of those: error beyond the limit.
    pub hazardous: Tally,
    /// All others.
    pub unavailable: Tally,
    /// Of the unavailable ones: no level is told.
    pub without_level: u64,
    /// Of the unavailable ones: the row says that it is not to be used.
    pub not_to_be_used: u64,
    /// Of the unavailable ones: the error is beyond the level all the same.
    pub exceeded_unavailable: u64,
    /// Error beyond the level, available or not.
    pub exceeded: Tally,
    /// The largest error over its level; null without levels.
    pub worst_ratio: Option<f64>,
    /// Where that was, s.
    pub worst_at_s: Option<f64>,
    /// 95 % of errors are at most this large, m; null without epochs.
    pub error_p95_m: Option<f64>,
    /// Median of the levels that are known, m.
    pub level_median_m: Option<f64>,
    /// What the epochs are worth as independent samples, by the autocorrelation of the errors in units of their levels.
    pub independence: Option<Independence>,
    /// The epochs themselves, for the chart.
    #[serde(skip)]
    pub points: Vec<StanfordPoint>,
}

/// All that is told. The field names are the keys of the JSON.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct IntegrityReport {
    /// File of solutions.
    pub nav: String,
    /// File of truth.
    pub truth: String,
    /// First epoch compared, s.
    pub from_s: f64,
    /// Last epoch compared, s.
    pub to_s: f64,
    /// The alert limit that was asked for.
    pub alert_limit: AlertLimit,
    /// Horizontal.
    pub horizontal: LevelsOfAxis,
    /// Vertical; null if the file tells no vertical levels.
    pub vertical: Option<LevelsOfAxis>,
}

impl StanfordPoint {
    /// Its place in the chart at an alert limit, m.
    #[must_use]
    pub fn class(&self, limit: f64) -> StanfordClass {
        match self.level {
            Some(level) if self.is_told && level < limit => {
                if self.error <= level {
                    StanfordClass::Nominal
                } else if self.error <= limit {
                    StanfordClass::Misleading
                } else {
                    StanfordClass::Hazardous
                }
            }
            _ => StanfordClass::Unavailable,
        }
    }

    /// Whether the error is beyond the level.
    #[must_use]
    pub fn is_exceeded(&self) -> bool {
        self.level.is_some_and(|level| self.error > level)
    }
}

impl IntegrityReport {
    /// The report on the rows of a file and the errors that were found of them; `vertical_limit` in m. File names are
    /// filled in by the caller.
    #[must_use]
    pub fn new(
        nav: &Rows<NavRow>,
        errors: &VoyageErrors,
        alert_limit: AlertLimit,
        vertical_limit: f64,
    ) -> Self {
        let judged = judge(&in_order(nav), errors, nav.has("hpl_m"));
        let horizontal = |own: &Judged<'_>| {
            let (north, east) = (own.epoch.of(Component::North)?, own.epoch.of(Component::East)?);
            Some((own.level, [north, east]))
        };
        let vertical = |own: &Judged<'_>| {
            Some((own.row.vertical_level, [own.epoch.of(Component::Down)?, 0.0]))
        };
        let has_vertical = nav.has("vpl_m");
        let seconds =
            |own: Option<&Judged<'_>>| own.map_or(f64::NAN, |own| own.epoch.time.as_seconds());
        IntegrityReport {
            nav: String::new(),
            truth: String::new(),
            from_s: seconds(judged.first()),
            to_s: seconds(judged.last()),
            horizontal: LevelsOfAxis::new(&judged, alert_limit.limit_m, horizontal),
            vertical: has_vertical.then(|| LevelsOfAxis::new(&judged, vertical_limit, vertical)),
            alert_limit,
        }
    }

    /// Epochs that are hazardous, in any axis.
    #[must_use]
    pub fn hazardous(&self) -> u64 {
        let vertical = self.vertical.as_ref().map_or(0, |own| own.hazardous.epochs);
        self.horizontal.hazardous.epochs + vertical
    }
}

impl LevelsOfAxis {
    /// The epochs of an axis at an alert limit, m. `read` gives the level and the error, both m.
    fn new(
        judged: &[Judged<'_>],
        limit_m: f64,
        read: impl Fn(&Judged<'_>) -> Option<(Option<f64>, [f64; 2])>,
    ) -> Self {
        let (mut points, mut steps, mut ratios) = (Vec::new(), Vec::new(), Vec::new());
        for own in judged {
            let Some((level, error)) = read(own) else { continue };
            let level = level.filter(|level| level.is_finite() && *level > 0.0);
            let (time, size) = (own.epoch.time, error[0].hypot(error[1]));
            ratios.extend(level.map(|level| (time, error.map(|axis| axis / level))));
            points.push(StanfordPoint { time, error: size, level, is_told: is_told(own.row) });
            steps.push(own.step);
        }
        let independence = independence(&ratios);
        let counter = Counter { points: &points, steps: &steps, independence };
        let of = |class| counter.tally(|point| point.class(limit_m) == class);
        let is_unavailable =
            |point: &&StanfordPoint| point.class(limit_m) == StanfordClass::Unavailable;
        let unavailable = |holds: &dyn Fn(&StanfordPoint) -> bool| {
            let all = points.iter().filter(is_unavailable);
            all.filter(|point| holds(point)).count() as u64
        };
        let worst = worst(&points);
        LevelsOfAxis {
            limit_m,
            epochs: points.len() as u64,
            available: counter.tally(|point| !is_unavailable(&point)),
            nominal: of(StanfordClass::Nominal),
            misleading: of(StanfordClass::Misleading),
            hazardous: of(StanfordClass::Hazardous),
            unavailable: of(StanfordClass::Unavailable),
            without_level: unavailable(&|point| point.level.is_none()),
            not_to_be_used: unavailable(&|point| !point.is_told),
            exceeded_unavailable: unavailable(&StanfordPoint::is_exceeded),
            exceeded: counter.tally(StanfordPoint::is_exceeded),
            worst_ratio: worst.map(|(ratio, _)| ratio),
            worst_at_s: worst.map(|(_, time)| time.as_seconds()),
            error_p95_m: part(points.iter().map(|point| point.error), 0.95),
            level_median_m: part(points.iter().filter_map(|point| point.level), 0.5),
            independence,
            points,
        }
    }

    /// The median of the levels over the error that 95 % are within: how much wider than needed they are.
    #[must_use]
    pub fn level_over_error(&self) -> Option<f64> {
        let error = self.error_p95_m.filter(|error| *error > 0.0)?;
        self.level_median_m.map(|level| level / error)
    }
}

/// Epochs, and what they are worth.
struct Counter<'a> {
    points: &'a [StanfordPoint],
    steps: &'a [Step],
    independence: Option<Independence>,
}

impl Counter<'_> {
    fn tally(&self, holds: impl Fn(&StanfordPoint) -> bool) -> Tally {
        let held: Vec<bool> = self.points.iter().map(holds).collect();
        let epochs = held.iter().filter(|held| **held).count() as u64;
        let pieces: Pieces = measure(self.steps.iter().copied().zip(held));
        let share = epochs as f64 / self.points.len() as f64;
        let (low, high) =
            share_of_independent(share, self.independence.map_or(0.0, |own| own.samples));
        Tally {
            epochs,
            share,
            low,
            high,
            pieces: pieces.count(),
            total_s: pieces.total(),
            longest_s: pieces.longest(),
            first_s: pieces.extent().map(|(first, _)| first.as_seconds()),
        }
    }
}

/// The largest error over its level, and when.
fn worst(points: &[StanfordPoint]) -> Option<(f64, Time)> {
    let ratio = |point: &StanfordPoint| Some((point.error / point.level?, point.time));
    points.iter().filter_map(ratio).max_by(|a, b| a.0.total_cmp(&b.0))
}

/// The value that a share of all does not exceed.
fn part(values: impl Iterator<Item = f64>, share: f64) -> Option<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    (!values.is_empty()).then(|| quantile(&values, share))
}

#[cfg(test)]
mod tests;
