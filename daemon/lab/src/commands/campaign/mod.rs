//! `insd campaign`: one scenario with many seeds, in parallel, on one computer or on many.

mod args;
mod declared;
mod sail;
mod sweep;

use std::ops::Range;

use insd_config::BadInput;
use insd_simulator::Override;

pub use self::args::CampaignArgs;
use self::declared::Declared;
use super::limit as limits;
use crate::evaluation::{CampaignReport, Yardstick};
use crate::parts;
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
    let seeds = args.seeds.clone().unwrap_or_default();
    let is_sailed = !args.parts.is_merge();
    let variations = if is_sailed { variations(args, &seeds)? } else { Vec::new() };
    let declared = variations.iter().map(|own| own.declared.clone()).collect();
    let mut kept = parts::gather(&args.parts, declared, |index, seed| {
        let Variation { named, declared } = &variations[index];
        Ok(sail::run_seed(&named.scenario, *seed, declared.yardstick.as_ref(), args))
    })?;
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
