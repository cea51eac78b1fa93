//! What an archive comes to: a row for each recording, and all of it together.

use std::collections::BTreeMap;
use std::fmt;

use serde::Serialize;

use super::score::{RecordingScore, Stanford};
use crate::commands::replay::ReplaySums;
use crate::parts::{CaseRun, CaseRuns};
use crate::table::{Align, Table, significant};

/// The components whose errors the table has.
const ERRORS: [&str; 2] = ["horizontal", "heading"];

/// The report. The field names are the keys of the JSON.
#[derive(Debug, Serialize)]
pub(super) struct BatchReport {
    /// Recordings by what came of them.
    outcomes: BTreeMap<String, u64>,
    /// Counts and sums of all of them together.
    total: ReplaySums,
    /// Epochs by their place in the Stanford chart, of those whose truth is known.
    stanford: Stanford,
    /// Each recording.
    recordings: Vec<CaseRun<RecordingScore>>,
    /// The names of those that are in no file.
    missing: Vec<String>,
    #[serde(skip)]
    lack: String,
}

impl BatchReport {
    /// The report on what there is.
    pub(super) fn new(all: CaseRuns<RecordingScore>) -> Self {
        let mut own = BatchReport {
            outcomes: BTreeMap::new(),
            total: ReplaySums::default(),
            stanford: Stanford::default(),
            lack: all.lack(),
            recordings: all.runs,
            missing: all.missing,
        };
        for CaseRun { score, .. } in &own.recordings {
            *own.outcomes.entry(score.outcome.clone()).or_default() += 1;
            score.runs.iter().for_each(|run| own.total.add(run));
            own.stanford.add(&score.truth.as_ref().map(|truth| truth.stanford).unwrap_or_default());
        }
        own
    }

    /// Whether nothing at all could be replayed.
    pub(super) fn is_vain(&self) -> bool {
        self.recordings.iter().all(|own| own.score.outcome == "error")
    }

    fn table(&self) -> Table {
        let (left, right) = (Align::Left, Align::Right);
        let mut table = Table::new(&[
            ("recording", left),
            ("outcome", left),
            ("h", right),
            ("told %", right),
            ("available %", right),
            ("way km", right),
            ("claimed m", right),
            ("claimed deg", right),
            ("rejected %", right),
            ("damaged", right),
            ("RMS m", right),
            ("RMS deg", right),
        ]);
        for CaseRun { case, score } in &self.recordings {
            let mut sums = ReplaySums::default();
            score.runs.iter().for_each(|run| sums.add(run));
            let mut row = vec![case.clone(), score.outcome.clone()];
            row.extend(cells(&sums));
            row.push((score.damaged + score.missing).to_string());
            row.extend(ERRORS.map(|name| rms(score, name)));
            table.push(row);
        }
        let mut row = vec!["all".to_owned(), String::new()];
        row.extend(cells(&self.total));
        let damaged = self.recordings.iter().map(|own| own.score.damaged + own.score.missing);
        row.push(damaged.sum::<u64>().to_string());
        table.push(row);
        table
    }
}

/// Hours, what was told and available, way, claims, and what was rejected.
fn cells(sums: &ReplaySums) -> [String; 7] {
    let share = |part: u64, of: u64| significant(100.0 * part as f64 / of as f64, 3);
    let root = |sum: f64| (sum / sums.told as f64).sqrt();
    let (used, rejected) = (sums.used.values().sum::<u64>(), sums.rejected.values().sum::<u64>());
    [
        format!("{:.2}", sums.duration_s / 3600.0),
        share(sums.told, sums.solutions),
        share(sums.available, sums.solutions),
        format!("{:.1}", sums.way_m / 1000.0),
        significant(root(sums.sum_horizontal_m2), 3),
        significant(root(sums.sum_heading_rad2).to_degrees(), 3),
        share(rejected, used + rejected),
    ]
}

/// Root mean square error against truth; empty where that is not known.
fn rms(score: &RecordingScore, name: &str) -> String {
    let figures = score.truth.as_ref().and_then(|truth| truth.components.get(name)?.as_ref());
    figures.map_or_else(String::new, |figures| significant(figures.rms, 3))
}

impl fmt::Display for BatchReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.table())?;
        for CaseRun { case, score } in &self.recordings {
            if let Some(error) = &score.error {
                writeln!(f, "{case}: {error}")?;
            }
        }
        let outcomes: Vec<String> =
            self.outcomes.iter().map(|(outcome, count)| format!("{count} {outcome}")).collect();
        writeln!(f, "{} recordings: {}", self.recordings.len(), outcomes.join(", "))?;
        let Stanford { nominal, misleading, hazardous, unavailable } = self.stanford;
        let epochs = nominal + misleading + hazardous + unavailable;
        if epochs > 0 {
            writeln!(
                f,
                "against truth {epochs} epochs: {nominal} nominal, {misleading} misleading, {hazardous} hazardous, {unavailable} unavailable"
            )?;
        }
        write!(f, "{}", self.lack)
    }
}
