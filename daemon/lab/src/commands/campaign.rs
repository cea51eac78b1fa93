//! `insd campaign`: one scenario with many seeds, in parallel.

use std::ops::Range;

use indicatif::{ProgressBar, ProgressStyle};
use insd_base::{AlignmentStatus, Solution, Time, Voyage, VoyageHeader};
use insd_config::BadInput;
use insd_engine::{Engine, EngineConfig, Output};
use insd_simulator::{Override, Scenario, simulate};
use rayon::iter::{IntoParallelIterator, ParallelIterator};

use super::alignment::AlignmentArgs;
use super::outage::SensorOutage;
use super::{limit as limits, stored_start};
use crate::evaluation::{CampaignReport, Run, StoredFate, Yardstick, drifts, errors, outages};
use crate::scenario;

/// Options of `insd campaign`.
///
/// Each figure is a mean over seeds with its 95 % confidence interval over seeds.
#[derive(Clone, Debug, clap::Args)]
pub struct CampaignArgs {
    /// Scenario file, or name or number of a shipped scenario
    scenario: String,
    /// Seeds A to B, B left out
    #[arg(long, value_name = "A..B", value_parser = seeds)]
    seeds: Range<u64>,
    /// Leave out what is before this time, s
    #[arg(long, value_name = "T", value_parser = super::seconds)]
    from: Option<f64>,
    /// Score roll, pitch and heading at this instant, s, beside the limit of the optimal filter; may be
    /// repeated; for a moored scenario 60, 120, 300, 600, 900 and 1800 if not given
    #[arg(long, value_name = "T", value_parser = super::seconds)]
    at: Vec<f64>,
    /// Set a key of the scenario to another value, as start.lat_deg=60; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE")]
    sets: Vec<Override>,
    #[command(flatten)]
    alignment: AlignmentArgs,
    /// Start each voyage from the state that an earlier one from the same berth stored, the ship having
    /// been turned by DEG since (0 if not given)
    #[arg(long, value_name = "DEG", num_args = 0..=1, default_missing_value = "0",
        allow_hyphen_values = true, value_parser = stored_start::turn)]
    stored: Option<f64>,
    /// Print JSON instead of a table
    #[arg(long)]
    json: bool,
    /// Solutions per second that are compared
    #[arg(long, value_name = "HZ", default_value_t = 1.0, value_parser = super::rate)]
    rate: f64,
    /// Take a sensor (imu, gnss, log, reference) away while FROM <= t_s < TO; may be repeated
    #[arg(long = "outage", value_name = "SENSOR:FROM..TO")]
    outages: Vec<SensorOutage>,
    /// Voyages at once; all processors if not given
    #[arg(long, value_name = "N")]
    jobs: Option<usize>,
}

/// Runs the command.
///
/// # Errors
/// The scenario is faulty, or no seed gave a solution.
pub fn run(args: &CampaignArgs) -> anyhow::Result<()> {
    let scenario = scenario::find(&args.scenario, &args.sets)?;
    let yardstick = yardstick(&scenario, &args.at)?;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(args.jobs.unwrap_or(0)).build()?;
    let bar = progress_bar(args.seeds.end - args.seeds.start)?;
    let runs: Vec<Run> = pool.install(|| {
        let seeds: Vec<u64> = args.seeds.clone().collect();
        let score = |seed| run_seed(&scenario.scenario, seed, yardstick.as_ref(), args);
        seeds.into_par_iter().map(score).inspect(|_| bar.inc(1)).collect()
    });
    bar.finish_and_clear();
    let report = CampaignReport::new(&scenario.name, runs, yardstick.as_ref());
    if args.json {
        crate::terminal::print(&(serde_json::to_string_pretty(&report)? + "\n"))?;
    } else {
        crate::terminal::print(&report.to_string())?;
    }
    if report.seeds.is_empty() {
        return Err(BadInput(format!("{}: no seed gave a solution", scenario.name)).into());
    }
    Ok(())
}

fn progress_bar(length: u64) -> anyhow::Result<ProgressBar> {
    let style = "{wide_bar:.cyan/blue} {pos}/{len} voyages, {elapsed} gone, {eta} to go";
    Ok(ProgressBar::new(length).with_style(ProgressStyle::with_template(style)?))
}

/// What the heading is held against, if instants are asked for or the ship is moored.
fn yardstick(scenario: &scenario::Named, at: &[f64]) -> anyhow::Result<Option<Yardstick>> {
    let (name, scenario) = (&scenario.name, &scenario.scenario);
    if at.is_empty() && !scenario.is_moored() {
        return Ok(None);
    }
    let mut at = if at.is_empty() { limits::instants(scenario) } else { at.to_vec() };
    at.sort_by(f64::total_cmp);
    match Yardstick::of(scenario, &at) {
        Ok(yardstick) => Ok(Some(yardstick)),
        Err(fault) => Err(BadInput(format!("{name}: {fault}")).into()),
    }
}

fn run_seed(
    scenario: &Scenario,
    seed: u64,
    yardstick: Option<&Yardstick>,
    args: &CampaignArgs,
) -> Run {
    let voyage = simulate(scenario, seed);
    let sailed = navigate(scenario, &voyage, seed, args);
    let found = errors(&sailed.solutions, &voyage.truth, args.from.map(Time::from_seconds));
    let run = Run::new(seed, &found, drifts(&outages(&sailed.solutions), &found.epochs))
        .telling(sailed.statuses)
        .started_from(sailed.fate);
    match yardstick {
        Some(yardstick) => {
            run.measured(&errors(&sailed.solutions, &voyage.truth, None).epochs, yardstick)
        }
        None => run,
    }
}

/// What came out of the engine on one voyage.
struct Sailed {
    solutions: Vec<Solution>,
    /// What it said of its alignment.
    statuses: Vec<AlignmentStatus>,
    /// What became of its stored state, if it was to have one.
    fate: Option<StoredFate>,
}

/// The engine on a voyage in memory.
fn navigate(scenario: &Scenario, voyage: &Voyage, seed: u64, args: &CampaignArgs) -> Sailed {
    let configured = |header: &VoyageHeader| {
        let alignment = args.alignment.config();
        EngineConfig { alignment, ..EngineConfig::for_voyage(header, args.rate) }
    };
    let stored = args
        .stored
        .and_then(|turned| stored_start::state_of_first_voyage(scenario, configured, seed, turned));
    let mut fate = args.stored.map(|_| match stored {
        Some(_) => StoredFate::Undecided,
        None => StoredFate::Missing,
    });
    let mut engine = Engine::new(EngineConfig { stored, ..configured(&voyage.header) });
    let (mut solutions, mut statuses) = (Vec::new(), Vec::new());
    for received in voyage.received() {
        if args.outages.iter().any(|outage| outage.drops(&received)) {
            continue;
        }
        engine.handle(&received);
        while let Some(output) = engine.poll_output() {
            match output {
                Output::Solution(solution) => solutions.push(solution),
                Output::Alignment(status) => statuses.push(status),
                Output::Event(event) => fate = StoredFate::of(&event).or(fate),
                Output::Innovation(_) | Output::Satellite(_) => {}
            }
        }
    }
    Sailed { solutions, statuses, fate }
}

/// `A..B` as a range that is not empty.
fn seeds(text: &str) -> Result<Range<u64>, String> {
    let parsed = text.split_once("..").and_then(|(from, to)| {
        let (from, to): (u64, u64) = (from.parse().ok()?, to.parse().ok()?);
        (from < to && to - from <= 1_000_000).then_some(from..to)
    });
    parsed.ok_or_else(|| "expected A..B with A < B, for example 0..40".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seeds_are_half_open_and_never_empty() {
        assert_eq!(seeds("3..5"), Ok(3..5));
        for text in ["3", "5..5", "5..3", "a..b", "0..99999999999", "-1..2"] {
            assert!(seeds(text).is_err(), "{text}");
        }
    }
}
