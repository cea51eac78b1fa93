//! How a voyage stood: the epochs of `insd integrity`, and when what was told.

use std::error::Error;
use std::path::Path;

use insd_base::{Availability, Party, Solution};
use insd_drivers::recording::{NavRow, read_nav_rows, read_truth_rows};
use insd_lab::evaluation::{AlertLimit, IntegrityReport, StanfordClass, StanfordPoint, errors};
use serde::{Deserialize, Serialize};

/// Alert limit of a harbour, m.
const LIMIT: f64 = 10.0;
/// Nothing is judged before, s: until then a heading is looked for.
const SETTLED: f64 = 120.0;
/// The alert of a level beyond the limit is after so long, s.
const PATIENCE: f64 = 10.0;

/// What a voyage gave.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Outcome {
    pub(crate) epochs: usize,
    pub(crate) available: usize,
    pub(crate) hazardous: usize,
    pub(crate) misleading: usize,
    /// Error beyond its level, available or not.
    pub(crate) exceeded: usize,
    /// Spacing of epochs, s.
    pub(crate) step: f64,
    /// Greatest error over level, and when, s.
    pub(crate) ratio: (f64, f64),
    /// Greatest error, m.
    pub(crate) error: f64,
    /// Since the error first passed the limit until it is told, or is within it again, s.
    pub(crate) told: Vec<f64>,
    /// Time in which nothing is wrong, s, and alerts in it.
    pub(crate) honest: f64,
    pub(crate) alerts: usize,
    /// Who was left out, in words, each once.
    pub(crate) excluded: Vec<String>,
}

/// Scores a solution; `wrong` is when anything is, s.
pub(crate) fn outcome(
    nav: &Path,
    truth: &Path,
    wrong: Option<[f64; 2]>,
) -> Result<Outcome, Box<dyn Error>> {
    let (nav, truth) = (read_nav_rows(nav)?, read_truth_rows(truth)?);
    let solutions: Vec<Solution> = nav.rows.iter().map(|row| row.solution).collect();
    let limit = AlertLimit { limit_m: LIMIT, requirement: None, accuracy_m: None };
    let found = errors(&solutions, &truth.rows, Some(insd_base::Time::from_seconds(SETTLED)));
    let report = IntegrityReport::new(&nav, &found, limit, LIMIT);
    let points = &report.horizontal.points;
    let count = |class| points.iter().filter(|own| own.class(LIMIT) == class).count();
    let ratio = |own: &StanfordPoint| Some((own.error / own.level?, own.time.as_seconds()));
    let ratios = points.iter().filter_map(ratio);
    let mut own = Outcome {
        epochs: points.len(),
        available: points.len() - count(StanfordClass::Unavailable),
        hazardous: count(StanfordClass::Hazardous),
        misleading: count(StanfordClass::Misleading),
        exceeded: points.iter().filter(|own| own.is_exceeded()).count(),
        step: points
            .windows(2)
            .next()
            .map_or(0.0, |pair| (pair[1].time - pair[0].time).as_seconds()),
        ratio: ratios.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or_default(),
        error: points.iter().map(|own| own.error).fold(0.0, f64::max),
        told: times_to_be_told(points),
        ..Outcome::default()
    };
    own.count_alerts(&nav.rows, wrong);
    Ok(own)
}

/// Of each piece of time in which the error is beyond the limit, how long nothing tells so from its begin.
fn times_to_be_told(points: &[StanfordPoint]) -> Vec<f64> {
    let mut all = Vec::new();
    let mut piece: Option<(f64, bool)> = None;
    for own in points {
        let t = own.time.as_seconds();
        if own.error <= LIMIT {
            all.extend(piece.take().filter(|(_, is_told)| !is_told).map(|(since, _)| t - since));
            continue;
        }
        let (since, is_told) = piece.get_or_insert((t, false));
        if !*is_told && own.class(LIMIT) == StanfordClass::Unavailable {
            *is_told = true;
            all.push(t - *since);
        }
    }
    all
}

impl Outcome {
    /// Alerts while nothing is wrong: somebody is left out, or what could be used, as its level was within the limit, can not for ten seconds.
    fn count_alerts(&mut self, rows: &[NavRow], wrong: Option<[f64; 2]>) {
        let (mut since, mut names, mut last) = (None, Vec::new(), SETTLED);
        let mut was_usable = false;
        for row in rows {
            let t = row.solution.time.as_seconds();
            if t < SETTLED {
                continue;
            }
            for name in row.excluded.iter().filter(|name| !self.excluded.contains(name)) {
                names.push(name.clone());
            }
            self.excluded.append(&mut names);
            // what was wrong is felt for a while
            if wrong.is_some_and(|[from, _]| t >= from) {
                continue;
            }
            self.honest += t - last;
            last = t;
            let is_named =
                Party::ALL.iter().any(|own| row.excluded.iter().any(|name| name == own.as_str()));
            let is_beyond = row.horizontal_level.is_none_or(|level| level >= LIMIT);
            let is_told = is_beyond || row.integrity == Some(Availability::Fault);
            let due = if is_named { 0.0 } else { PATIENCE };
            was_usable |= !is_told;
            match (is_named || is_told && was_usable, since) {
                (false, _) => since = None,
                (true, None) => since = Some((t, false)),
                _ => {}
            }
            if let Some((begun, is_counted)) = &mut since
                && !*is_counted
                && t - *begun >= due
            {
                *is_counted = true;
                self.alerts += 1;
            }
        }
    }
}
