//! What comes of one recording: a line, whatever its state.

use std::collections::BTreeMap;

use insd_base::Time;
use insd_drivers::recording::{NavRow, Rows, read_truth_rows};
use serde::{Deserialize, Serialize};

use super::archive::Recording;
use super::args::BatchArgs;
use crate::commands::options;
use crate::commands::replay::{ReplayOptions, ReplaySums, Summed, Summing, summed};
use crate::evaluation::{AlertLimit, IntegrityReport, Summary, errors, summaries};

/// What came of a recording.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RecordingScore {
    /// `navigated`; `silent`, if the engine never gave a solution; `error`, if it could not be replayed to its end.
    pub outcome: String,
    /// Why not.
    pub error: Option<String>,
    /// Name and version of the program that recorded it; a voyage does not tell.
    pub recorded_by: Option<String>,
    /// Rows of a voyage that could not be read, or places of a raw recording that are damaged.
    pub damaged: u64,
    /// Records of a raw recording that are missing.
    pub missing: u64,
    /// Counts and sums of each run of the program that was replayed to its end.
    pub runs: Vec<ReplaySums>,
    /// What its solution is worth, where truth is known.
    pub truth: Option<TruthScore>,
}

/// A solution against truth.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TruthScore {
    /// Epochs compared.
    pub epochs: u64,
    /// Figures by component, as of `insd evaluate`.
    pub components: BTreeMap<String, Option<Summary>>,
    /// Epochs by their place in the Stanford chart of the horizontal position.
    pub stanford: Stanford,
}

/// Epochs by their place in the Stanford chart.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Stanford {
    /// Level within the alert limit, error within the level.
    pub nominal: u64,
    /// Level within the limit, error beyond the level and within the limit.
    pub misleading: u64,
    /// Level within the limit, error beyond it.
    pub hazardous: u64,
    /// Not to be used.
    pub unavailable: u64,
}

impl Stanford {
    /// Adds the epochs of another one.
    pub(super) fn add(&mut self, other: &Stanford) {
        self.nominal += other.nominal;
        self.misleading += other.misleading;
        self.hazardous += other.hazardous;
        self.unavailable += other.unavailable;
    }
}

/// Replays a recording. It never fails: what is wrong stands in the score.
pub(super) fn score(recording: &Recording, args: &BatchArgs) -> RecordingScore {
    let mut score = RecordingScore::default();
    if let Err(fault) = replay(recording, args, &mut score) {
        score.error = Some(format!("{fault:#}"));
    }
    let is_silent = score.runs.iter().all(|run| run.solutions == 0);
    let word = match &score.error {
        Some(_) => "error",
        None if is_silent => "silent",
        None => "navigated",
    };
    score.outcome = word.to_owned();
    score
}

fn replay(
    recording: &Recording,
    args: &BatchArgs,
    score: &mut RecordingScore,
) -> anyhow::Result<()> {
    let truth = ["truth.csv", "truth.csv.zst"].map(|file| recording.path.join(file));
    let truth = truth.iter().find(|file| file.exists());
    let mut run = 1;
    loop {
        let summing = Summing::new(args.alert_limit.limit_m);
        let replayed = summed(&asked(recording, args, run)?, summing, truth.is_some())?;
        let Summed { sums, faulty_rows, read, runs, program } = replayed.summed.unwrap_or_default();
        score.runs.push(sums);
        // the reader tells of each new run as of a fault
        let breaks = u64::from(runs.saturating_sub(1));
        score.damaged = faulty_rows + read.faults.saturating_sub(breaks);
        score.missing = read.missing + read.not_recorded;
        score.recorded_by = program.or_else(|| score.recorded_by.take());
        if let Some(file) = truth {
            let truth = read_truth_rows(file)?;
            score.truth = held_against(&replayed.rows, &truth.rows, args);
        }
        if run >= runs {
            return Ok(());
        }
        run += 1;
    }
}

fn asked(recording: &Recording, args: &BatchArgs, run: u32) -> anyhow::Result<ReplayOptions> {
    let mut words = args.words();
    words.extend(["--run".to_owned(), run.to_string(), "--".to_owned()]);
    words.push(recording.path.display().to_string());
    Ok(options::<ReplayOptions>(&words)?)
}

/// A solution against truth; `None` if they have no common time.
fn held_against(
    nav: &Rows<NavRow>,
    truth: &[insd_base::Truth],
    args: &BatchArgs,
) -> Option<TruthScore> {
    let solutions: Vec<_> = nav.rows.iter().map(|row| row.solution).collect();
    let found = errors(&solutions, truth, args.from.map(Time::from_seconds));
    let AlertLimit { limit_m, .. } = args.alert_limit;
    let report = IntegrityReport::new(nav, &found, args.alert_limit, limit_m).horizontal;
    let own = |(name, figures): (&str, _)| (name.to_owned(), figures);
    (!found.epochs.is_empty()).then(|| TruthScore {
        epochs: found.epochs.len() as u64,
        components: summaries(&found).into_iter().map(own).collect(),
        stanford: Stanford {
            nominal: report.nominal.epochs,
            misleading: report.misleading.epochs,
            hazardous: report.hazardous.epochs,
            unavailable: report.unavailable.epochs,
        },
    })
}
