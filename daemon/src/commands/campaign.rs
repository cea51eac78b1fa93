//! `insd campaign`: one scenario with many seeds, in parallel.

use std::ops::Range;

use indicatif::{ProgressBar, ProgressStyle};
use insd_base::{Solution, Time, Voyage};
use insd_engine::{Engine, EngineConfig, Output};
use insd_simulator::{Scenario, simulate};
use rayon::iter::{IntoParallelIterator, ParallelIterator};

use super::outage::SensorOutage;
use super::scenario;
use crate::cli::BadInput;
use crate::evaluation::{CampaignReport, Run, drifts, errors, outages};

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
    let scenario = scenario::find(&args.scenario)?;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(args.jobs.unwrap_or(0)).build()?;
    let bar = progress_bar(args.seeds.end - args.seeds.start)?;
    let runs: Vec<Run> = pool.install(|| {
        let seeds: Vec<u64> = args.seeds.clone().collect();
        let score = |seed| run_seed(&scenario.scenario, seed, args);
        seeds.into_par_iter().map(score).inspect(|_| bar.inc(1)).collect()
    });
    bar.finish_and_clear();
    let report = CampaignReport::new(&scenario.name, runs);
    if args.json {
        println!("{}", serde_json::to_string_pretty(&report)?);
    } else {
        print!("{report}");
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

fn run_seed(scenario: &Scenario, seed: u64, args: &CampaignArgs) -> Run {
    let voyage = simulate(scenario, seed);
    let nav = navigate(&voyage, args);
    let found = errors(&nav, &voyage.truth, args.from.map(Time::from_seconds));
    Run::new(seed, &found, drifts(&outages(&nav), &found.epochs))
}

/// The solutions of the engine on a voyage in memory.
fn navigate(voyage: &Voyage, args: &CampaignArgs) -> Vec<Solution> {
    let mut engine = Engine::new(EngineConfig::for_voyage(&voyage.header, args.rate));
    let mut solutions = Vec::new();
    for received in voyage.received() {
        if args.outages.iter().any(|outage| outage.drops(&received)) {
            continue;
        }
        engine.handle(&received);
        while let Some(output) = engine.poll_output() {
            if let Output::Solution(solution) = output {
                solutions.push(solution);
            }
        }
    }
    solutions
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
