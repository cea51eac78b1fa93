//! What a solution said of how far it may be relied on, held against truth.
//!
//! *Usable* at an alert limit: the mode is not `fault`, `standby` or `coarse_alignment`, `integrity` is not `fault`,
//! and the level is within the limit. The level is `hpl_m`; where the file has no such column, five horizontal sigmas.
//! Without `integrity` nothing speaks against a row. A field that is empty is a level that is not known, and within
//! no limit. *Misleading*: usable while the error is beyond the limit; a heading that claims less than 2 deg, off
//! by more than 3 deg and three sigmas. *Hazardous*: misleading for more than 10 s in a piece or 60 s in all.

mod pieces;
mod table;
mod told;

use std::collections::BTreeMap;

use insd_base::units::DEG;
use insd_base::{Availability, Mode, Time};
use insd_drivers::recording::{NavRow, Rows};
use serde::Serialize;

use super::component::Component;
use super::errors::{EpochError, VoyageErrors};
pub use pieces::Pieces;
pub(super) use pieces::Step;
use pieces::steps;
pub use told::{Exclusion, FaultsTold, Share};

/// Alert limits of the horizontal error, m: a harbour, the ocean.
const LIMITS: [f64; 2] = [10.0, 100.0];
/// Sigmas that are the level where none is told.
const LEVEL: f64 = 5.0;
/// A heading that claims less than this, rad, off by more than that, rad, and by so many sigmas, misleads.
const HEADING_CLAIM: f64 = 2.0 * DEG;
const HEADING_OFF: f64 = 3.0 * DEG;
const HEADING_SIGMAS: f64 = 3.0;
/// Misleading for longer than this is hazardous: in a piece, in all, s.
const PIECE: f64 = 10.0;
const SUM: f64 = 60.0;

/// How long something could be used, and for how long it misled then.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Use {
    /// Alert limit of the horizontal error, m; null of the heading.
    pub limit_m: Option<f64>,
    /// How long it could be used, s.
    pub usable_s: f64,
    /// Of the time in which anything was told, 0 to 1.
    pub usable_share: f64,
    /// For how long it misled, s; null where truth does not know it, as the next two.
    pub misleading_s: Option<f64>,
    /// The longest piece of that, s.
    pub longest_s: Option<f64>,
    /// Where it first did, s; null also if it never did.
    pub first_s: Option<f64>,
    /// Whether it misled for longer than may be.
    pub hazardous: bool,
}

/// The largest error in terms of its level.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Worst {
    /// Error over level: above 1 the level did not hold.
    pub ratio: f64,
    /// Where, s.
    pub at_s: f64,
}

/// All of it. The field names are the keys of the JSON.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Evidence {
    /// How long anything was told, s.
    pub told_s: f64,
    /// How long each state of `integrity` was told; null if the file does not have it.
    pub integrity: Option<BTreeMap<&'static str, Share>>,
    /// Who was left out when; null if the file does not have it.
    pub excluded: Option<Vec<Exclusion>>,
    /// Whether the file tells horizontal levels.
    pub has_levels: bool,
    /// The position at each alert limit.
    pub position: Vec<Use>,
    /// The heading.
    pub heading: Use,
    /// The largest horizontal error over its level while it was told; null if there is none.
    pub worst_horizontal: Option<Worst>,
    /// The same of the height; null also if the file tells no vertical levels.
    pub worst_vertical: Option<Worst>,
    /// Whether anything misled for longer than may be.
    pub hazardous: bool,
}

/// An epoch with truth beside the row that held then.
#[derive(Clone, Copy, Debug)]
pub(super) struct Judged<'a> {
    pub(super) step: Step,
    pub(super) row: &'a NavRow,
    pub(super) epoch: &'a EpochError,
    /// Horizontal, m.
    pub(super) level: Option<f64>,
}

impl Evidence {
    /// What the rows of a file say from an instant on, against the errors that were found of them.
    #[must_use]
    pub fn new(nav: &Rows<NavRow>, errors: &VoyageErrors, from: Option<Time>) -> Self {
        let time = |row: &NavRow| row.solution.time;
        let is_late = |row: &&NavRow| from.is_none_or(|from| time(row) >= from);
        let rows = in_order(nav);
        let told_rows: Vec<&NavRow> = rows.iter().copied().filter(is_late).collect();
        let times: Vec<Time> = told_rows.iter().map(|row| time(row)).collect();
        let told_steps: Vec<(Step, &NavRow)> = steps(&times).into_iter().zip(told_rows).collect();
        let told = tell(&told_steps);
        let has_levels = nav.has("hpl_m");
        let judged = judge(&rows, errors, has_levels);
        let usable = |can: &dyn Fn(&NavRow) -> bool| {
            measure(told_steps.iter().map(|(step, row)| (*step, can(row))))
        };
        let position: Vec<Use> = LIMITS
            .into_iter()
            .map(|limit| {
                let usable = usable(&|row| is_within(row, level_of(row, has_levels), limit));
                let misleading = judged.iter().map(|own| (own.step, own.misleads(limit)));
                Use::new(Some(limit), &usable, Some(measure(misleading)), told.total())
            })
            .collect();
        let knows_heading = errors.epochs.iter().any(|own| own.of(Component::Heading).is_some());
        let misled = judged.iter().map(|own| (own.step, own.misleads_in_heading()));
        let heading = Use::new(
            None,
            &usable(&|row| is_told(row) && row.solution.sigma.heading < HEADING_CLAIM),
            knows_heading.then(|| measure(misled)),
            told.total(),
        );
        let states = || told.states().into_iter().map(|(own, share)| (own.as_str(), share));
        Evidence {
            told_s: told.total(),
            integrity: nav.has("integrity").then(|| states().collect()),
            excluded: nav.has("excluded").then(|| told.exclusions()),
            has_levels,
            hazardous: heading.hazardous || position.iter().any(|own| own.hazardous),
            position,
            heading,
            worst_horizontal: worst(
                judged.iter().map(|own| (own.epoch.horizontal(), own.level, own)),
            ),
            worst_vertical: worst(judged.iter().map(|own| {
                (own.epoch.of(Component::Down).map(f64::abs), own.row.vertical_level, own)
            })),
        }
    }
}

impl Judged<'_> {
    fn misleads(&self, limit: f64) -> bool {
        is_within(self.row, self.level, limit)
            && self.epoch.horizontal().is_some_and(|off| off > limit)
    }

    fn misleads_in_heading(&self) -> bool {
        let sigma = self.epoch.sigma_of(Component::Heading);
        let bound = HEADING_OFF.max(HEADING_SIGMAS * sigma);
        let off = self.epoch.of(Component::Heading).map(f64::abs);
        is_told(self.row) && sigma < HEADING_CLAIM && off.is_some_and(|off| off > bound)
    }
}

impl Use {
    fn new(limit_m: Option<f64>, usable: &Pieces, misleading: Option<Pieces>, told: f64) -> Self {
        let is_hazard = |own: &Pieces| own.longest() > PIECE || own.total() > SUM;
        let first = misleading.and_then(|own| own.extent()).map(|(first, _)| first);
        Use {
            limit_m,
            usable_s: usable.total(),
            usable_share: usable.total() / told,
            misleading_s: misleading.map(|own| own.total()),
            longest_s: misleading.map(|own| own.longest()),
            first_s: first.map(Time::as_seconds),
            hazardous: misleading.as_ref().is_some_and(is_hazard),
        }
    }
}

/// The rows of a file in order of time, one for each instant.
pub(super) fn in_order(nav: &Rows<NavRow>) -> Vec<&NavRow> {
    let mut rows: Vec<&NavRow> = nav.rows.iter().collect();
    rows.sort_by_key(|row| row.solution.time);
    rows.dedup_by_key(|row| row.solution.time);
    rows
}

/// Whether a row is told as a solution that may be used.
#[must_use]
pub fn is_told(row: &NavRow) -> bool {
    let is_none = matches!(row.solution.mode, Mode::Fault | Mode::Standby | Mode::CoarseAlignment);
    !is_none && row.integrity != Some(Availability::Fault)
}

/// Whether a row is usable at an alert limit, m.
fn is_within(row: &NavRow, level: Option<f64>, limit: f64) -> bool {
    is_told(row) && level.is_some_and(|level| level <= limit)
}

/// The level of a row, m.
fn level_of(row: &NavRow, has_levels: bool) -> Option<f64> {
    let sigma = row.solution.sigma.position.0.xy().norm();
    if has_levels { row.horizontal_level } else { Some(LEVEL * sigma) }
}

/// What was told of the integrity.
fn tell(rows: &[(Step, &NavRow)]) -> FaultsTold {
    let mut told = FaultsTold::default();
    for (step, row) in rows {
        told.enter(step.time, step.held, row.integrity, &row.excluded);
        if step.is_cut {
            told.cut();
        }
    }
    told
}

/// Each epoch with the last row before it. Rows are in order of time; between an epoch and its row there is no gap.
pub(super) fn judge<'a>(
    rows: &[&'a NavRow],
    errors: &'a VoyageErrors,
    has_levels: bool,
) -> Vec<Judged<'a>> {
    let times: Vec<Time> = errors.epochs.iter().map(|epoch| epoch.time).collect();
    let judged = |(epoch, step): (&'a EpochError, Step)| {
        let after = rows.partition_point(|row| row.solution.time <= epoch.time);
        let row = *rows.get(after.checked_sub(1)?)?;
        let level =
            if has_levels { row.horizontal_level } else { Some(LEVEL * epoch.horizontal_sigma()) };
        Some(Judged { step, row, epoch, level })
    };
    errors.epochs.iter().zip(steps(&times)).filter_map(judged).collect()
}

/// How long something held.
pub(super) fn measure(steps: impl Iterator<Item = (Step, bool)>) -> Pieces {
    let mut pieces = Pieces::default();
    for (step, holds) in steps {
        pieces.enter(step.time, step.held, holds);
        if step.is_cut {
            pieces.cut();
        }
    }
    pieces
}

/// The largest of errors over their levels, both m, of rows that are told.
fn worst<'a>(
    all: impl Iterator<Item = (Option<f64>, Option<f64>, &'a Judged<'a>)>,
) -> Option<Worst> {
    let ratio = |(error, level, judged): (Option<f64>, Option<f64>, &Judged<'_>)| {
        let (error, level) = (error?, level.filter(|level| level.is_finite() && *level > 0.0)?);
        let at_s = judged.epoch.time.as_seconds();
        is_told(judged.row).then_some(Worst { ratio: error / level, at_s })
    };
    all.filter_map(ratio).max_by(|a, b| a.ratio.total_cmp(&b.ratio))
}

#[cfg(test)]
mod tests;
