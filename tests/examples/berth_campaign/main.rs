//! Ships at their berths, in all seas and on all moorings, with the two best ways of holding them: one table.
//!
//! ```text
//! cargo run --release -p insd-tests --example berth_campaign -- 24 docs/figures.md
//! ```
//!
//! Seeds of each cell; and the page whose table it fills in. Without a page the table is printed.

mod cells;

use std::error::Error;

use insd_alignment::AlignmentConfig;
use insd_base::{Time, Voyage};
use insd_lab::evaluation::{CampaignReport, InstantEstimates, Run, Yardstick, errors};
use insd_nav::berth::Method;
use insd_simulator::{Override, simulate};
use insd_tests::pages;
use insd_tests::sailing::sail_aligned;
use rayon::iter::{IntoParallelIterator, ParallelIterator};

use cells::{CELLS, Cell};

const METHODS: [Method; 2] = [Method::Autoregressive, Method::Moorings];
/// When the heading is looked at, s.
const INSTANTS: [f64; 4] = [300.0, 600.0, 900.0, 1800.0];
/// From when on claims are judged, s.
const SETTLED: f64 = 60.0;
const HEAD: &str = "| at the berth | method | RMS / limit at 300 s | 600 s | 900 s | 1800 s | claim / limit at 300 s \
    | NEES | within 2 sigma | worst, sigma | claimed by all, s |\n|---|---|---|---|---|---|---|---|---|---|---|\n";

fn main() -> Result<(), Box<dyn Error>> {
    let mut args = std::env::args().skip(1);
    let seeds: u64 = args.next().unwrap_or_else(|| "24".to_owned()).parse()?;
    let mut table = HEAD.to_owned();
    for cell in &CELLS {
        let rows = sailed(cell, seeds)?;
        eprint!("{rows}");
        table += &rows;
    }
    Ok(pages::put(args.next(), "berth-campaign", &table)?)
}

/// The rows of a cell, one for each method.
fn sailed(cell: &Cell, seeds: u64) -> Result<String, Box<dyn Error>> {
    let sets: Result<Vec<Override>, String> = cell.sets.iter().map(|set| set.parse()).collect();
    let scenario = insd_lab::scenario::find(cell.scenario, &sets?)?.scenario;
    let yardstick = Yardstick::of(&scenario, &INSTANTS)?;
    let of_seed = |seed: u64| {
        let voyage = simulate(&scenario, seed);
        METHODS.map(|method| run(seed, &voyage, method, &yardstick))
    };
    let seeds: Vec<u64> = (1..=seeds).collect();
    let runs: Vec<[Run; METHODS.len()]> = seeds.into_par_iter().map(of_seed).collect();
    let row = |(index, method): (usize, Method)| {
        let of_method = runs.iter().map(|runs| runs[index].clone()).collect();
        row(cell.label, method, &CampaignReport::new(cell.label, of_method, Some(&yardstick)))
    };
    Ok(METHODS.into_iter().enumerate().map(row).collect())
}

fn run(seed: u64, voyage: &Voyage, moored: Method, yardstick: &Yardstick) -> Run {
    let alignment = AlignmentConfig { moored, ..AlignmentConfig::default() };
    let log = sail_aligned(voyage, &alignment);
    let found = |from| errors(&log.solutions, &voyage.truth, from);
    let settled = found(Some(Time::from_seconds(SETTLED)));
    Run::new(seed, &settled, Vec::new()).measured(&found(None).epochs, yardstick)
}

fn row(label: &str, method: Method, report: &CampaignReport) -> String {
    let ratio = |of: Option<f64>| of.map_or("-".to_owned(), |ratio| format!("{ratio:.2}"));
    let rms = |at: &InstantEstimates| ratio(at.rms_over_limit);
    let rms: Vec<String> = report.instants.iter().map(rms).collect();
    let claim = report.instants.first().and_then(|at| at.sigma_over_limit);
    let heading = report.components.get("heading").and_then(Option::as_ref);
    let worst = report.worst_heading.as_ref().map(|run| run.worst.ratio);
    let all = report.aligned.as_ref().filter(|aligned| aligned.claim.never == 0);
    let all = all.and_then(|aligned| aligned.claim.max_s);
    format!(
        "| {label} | `{}` | {} | {} | {} | {} | {} | {} |\n",
        method.as_str(),
        rms.join(" | "),
        ratio(claim),
        ratio(heading.map(|heading| heading.nees.mean)),
        ratio(heading.map(|heading| heading.coverage_2sigma.mean)),
        worst.map_or("-".to_owned(), |worst| format!("{worst:.1}")),
        all.map_or("never".to_owned(), |at| format!("{at:.0}")),
    )
}
