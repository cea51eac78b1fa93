//! `insd campaign`: one scenario with many seeds, in parallel, on one computer or on many.

mod args;
mod declared;
mod kept;
mod merge;
mod sail;
mod shard;
mod sweep;

use std::ops::Range;
use std::sync::{Mutex, PoisonError};

use indicatif::{ProgressBar, ProgressStyle};
use insd_config::BadInput;
use insd_simulator::Override;
use rayon::iter::{IntoParallelIterator, ParallelIterator};

pub use self::args::CampaignArgs;
use self::declared::Declared;
use self::kept::{Keeper, Kept};
use self::shard::Shard;
use super::limit as limits;
use crate::evaluation::{CampaignReport, Run, Yardstick};
use crate::scenario;

/// One scenario of a campaign with all that is set in it.
struct Variation {
    named: scenario::Named,
    declared: Declared,
}

/// Runs the command.
///
/// # Errors
/// The scenario or a file of runs is faulty, or no seed gave a solution.
pub fn run(args: &CampaignArgs) -> anyhow::Result<()> {
    let reports = reports(args)?;
    crate::terminal::print(&text(&reports, args.json)?)?;
    match reports.iter().find(|report| report.is_silent()) {
        Some(silent) => {
            Err(BadInput(format!("{}: no seed gave a solution", silent.scenario)).into())
        }
        None => Ok(()),
    }
}

/// The report of each variation of the scenario: one, unless keys are swept.
///
/// # Errors
/// The scenario or a file of runs is faulty.
pub fn reports(args: &CampaignArgs) -> anyhow::Result<Vec<CampaignReport>> {
    let is_merged = !args.merge.is_empty();
    let mut kept = if is_merged { merge::merge(&args.merge)? } else { sail(args)? };
    if let (true, Some(path)) = (is_merged, &args.runs) {
        let mut keeper = Keeper::create(path, &kept.declared)?;
        keeper.keep_all(&kept)?;
    }
    let declared = std::mem::take(&mut kept.declared);
    let report = |declared: &Declared| {
        let runs = kept.take_runs(declared);
        let yardstick = declared.yardstick.as_ref();
        CampaignReport::new(&declared.scenario, runs, yardstick).out_of(declared.seeds())
    };
    Ok(declared.iter().map(report).collect())
}

fn text(reports: &[CampaignReport], as_json: bool) -> anyhow::Result<String> {
    Ok(match reports {
        [only] if as_json => serde_json::to_string_pretty(only)? + "\n",
        several if as_json => serde_json::to_string_pretty(several)? + "\n",
        several => several.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"),
    })
}

/// Sails what belongs to this shard and is not in the file of runs yet.
fn sail(args: &CampaignArgs) -> anyhow::Result<Kept> {
    let seeds = args.seeds.clone().unwrap_or_default();
    let variations = variations(args, &seeds)?;
    let declared: Vec<Declared> = variations.iter().map(|own| own.declared.clone()).collect();
    let (keeper, mut kept) = keeper(args, &declared)?;
    let open = open_voyages(&declared, &seeds, shard(args)?, &kept);
    let bar = progress_bar(open.len() as u64)?;
    let keeper = Mutex::new(keeper);
    let score = |(index, seed): (usize, u64)| {
        let Variation { named, declared } = &variations[index];
        let run = sail::run_seed(&named.scenario, seed, declared.yardstick.as_ref(), args);
        if let Some(keeper) = keeper.lock().unwrap_or_else(PoisonError::into_inner).as_mut() {
            keeper.keep(declared, &run)?;
        }
        bar.inc(1);
        Ok((index, run))
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(jobs(args)).build()?;
    let sailed: anyhow::Result<Vec<(usize, Run)>> =
        pool.install(|| open.into_par_iter().map(score).collect());
    bar.finish_and_clear();
    sailed?.into_iter().for_each(|(index, run)| kept.add(&declared[index], run));
    kept.declared = declared;
    Ok(kept)
}

fn keeper(args: &CampaignArgs, declared: &[Declared]) -> anyhow::Result<(Option<Keeper>, Kept)> {
    match &args.runs {
        Some(path) if args.resume => {
            Keeper::resume(path, declared).map(|(keeper, kept)| (Some(keeper), kept))
        }
        Some(path) => Ok((Some(Keeper::create(path, declared)?), Kept::default())),
        None => Ok((None, Kept::default())),
    }
}

/// The voyages of a shard, as variation and seed, without those that are kept.
fn open_voyages(
    declared: &[Declared],
    seeds: &Range<u64>,
    shard: Shard,
    kept: &Kept,
) -> Vec<(usize, u64)> {
    let done: Vec<_> = declared.iter().map(|declared| kept.seeds(declared)).collect();
    let all = (0..declared.len()).flat_map(|index| seeds.clone().map(move |seed| (index, seed)));
    let own = all.enumerate().filter(|(number, _)| shard.holds(*number));
    own.map(|(_, voyage)| voyage).filter(|(index, seed)| !done[*index].contains(seed)).collect()
}

fn shard(args: &CampaignArgs) -> anyhow::Result<Shard> {
    let Some(share) = args.shard else { return Ok(Shard::ALL) };
    Ok(share.resolve(|name| std::env::var(name).ok()).map_err(BadInput)?)
}

/// Voyages at once; 0 for what the system grants.
fn jobs(args: &CampaignArgs) -> usize {
    let granted = || std::env::var("SLURM_CPUS_PER_TASK").ok()?.parse().ok();
    args.jobs.or_else(granted).unwrap_or(0)
}

fn variations(args: &CampaignArgs, seeds: &Range<u64>) -> anyhow::Result<Vec<Variation>> {
    let word = args.scenario.as_deref().unwrap_or_default();
    let variation = |swept: Vec<Override>| {
        let named = scenario::find(word, &[args.sets.as_slice(), &swept].concat())?;
        let yardstick = yardstick(&named, &args.at)?;
        let swept = swept.iter().map(ToString::to_string).collect();
        let declared = Declared::of(&named, swept, seeds, args, yardstick);
        Ok(Variation { named, declared })
    };
    sweep::variations(&args.sweeps).into_iter().map(variation).collect()
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
