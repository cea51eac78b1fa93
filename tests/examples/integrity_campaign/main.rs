//! Simulated ports in which something is wrong: whether protection levels hold, and how soon it is told. One table.
//!
//! ```text
//! cargo run --release -p insd-tests --example integrity_campaign -- target/release/insd 50 docs/protection.md
//! ```
//!
//! Each kind of fault has so many voyages, which differ in port, ship, IMU, with a log or without, size, satellite and onset; they are made in
//! `target/integrity-campaign`. Spoofers and honest voyages are replayed by fixes alone, too. Without a page the table is printed. In the environment
//! `KIND=spoofer` takes the kinds whose name begins so, `SEED=3` one of the seeds, `KEEP=1` keeps the voyages, and `CASES=1` tells each. Options as
//! those of `insd campaign` sail it in parts and put parts together.

mod case;
mod outcome;
mod table;

use std::collections::BTreeMap;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::Command;

use clap::Parser as _;
use insd_lab::parts::{CaseList, CaseRun, PartsArgs, gather};
use insd_lab::scenario;
use insd_tests::pages;
use insd_tests::programs::run;
use serde::{Deserialize, Serialize};

use case::{Case, KINDS, Kind, SCENARIO};
use outcome::{Outcome, outcome};

/// What is sailed.
#[derive(Debug, clap::Parser)]
struct Args {
    /// The program, as target/release/insd
    program: String,
    /// Voyages of each kind
    #[arg(default_value_t = 50)]
    seeds: u64,
    /// Page whose table is to be made anew
    page: Option<String>,
    #[command(flatten)]
    parts: PartsArgs,
}

/// What a voyage is replayed with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
enum Way {
    /// Ranges of satellites.
    Tight,
    /// Fixes of a receiver.
    Loose,
}

type Failed = Box<dyn Error + Send + Sync>;

/// What the ways of a voyage gave.
type Outcomes = Vec<(Way, Outcome)>;

fn main() -> Result<(), Failed> {
    let args = Args::parse();
    let only = std::env::var("KIND").unwrap_or_default();
    let one: Option<u64> = std::env::var("SEED").ok().and_then(|seed| seed.parse().ok());
    let seeds = one.map_or(1..=args.seeds, |seed| seed..=seed);
    let kinds = KINDS.into_iter().filter(|kind| kind.name().starts_with(&only));
    let cases: BTreeMap<String, Case> = kinds
        .clone()
        .flat_map(|kind| seeds.clone().map(move |seed| (name(kind, seed), Case::new(kind, seed))))
        .collect();
    let names = kinds.flat_map(|kind| seeds.clone().map(move |seed| name(kind, seed)));
    let content = format!("{:?} {cases:?}", scenario::find(SCENARIO, &[])?.scenario);
    let declared = CaseList::new("integrity counts", "", names.collect(), &content);
    let kept = gather(&args.parts, vec![declared], |_, name: &String| {
        let case = cases.get(name).ok_or_else(|| anyhow::anyhow!("{name}: no such case"))?;
        let score = sail(&args.program, case).map_err(|why| anyhow::anyhow!("{why}"))?;
        Ok(CaseRun { case: name.clone(), score })
    })?;
    let kept = kept.into_cases();
    eprint!("{}", kept.lack());
    let table = table::HEAD.to_owned() + &rows(&kept.runs).concat();
    Ok(pages::put(args.page, "integrity-campaign", &table)?)
}

fn name(kind: Kind, seed: u64) -> String {
    format!("{}|{seed}", kind.name())
}

/// A row for each kind and way.
fn rows(runs: &[CaseRun<Outcomes>]) -> Vec<String> {
    let kind = |run: &CaseRun<Outcomes>| {
        run.case.rsplit_once('|').map_or_else(String::new, |(kind, _)| kind.to_owned())
    };
    let mut rows = Vec::new();
    for of_kind in runs.chunk_by(|a, b| kind(a) == kind(b)) {
        for way in [Way::Tight, Way::Loose] {
            let all = of_kind.iter().flat_map(|run| &run.score);
            let own: Vec<&Outcome> =
                all.filter(|own| own.0 == way).map(|(_, outcome)| outcome).collect();
            let name = kind(&of_kind[0]) + if way == Way::Loose { ", fixes" } else { "" };
            rows.extend((!own.is_empty()).then(|| table::row(&name, &own)));
        }
    }
    rows
}

/// Makes a voyage and replays it.
fn sail(program: &str, case: &Case) -> Result<Outcomes, Failed> {
    let word = case.kind.name().replace(' ', "-");
    let folder = PathBuf::from(format!("target/integrity-campaign/{word}-{}", case.seed));
    let voyage = folder.join("voyage");
    let mut simulate = Command::new(program);
    simulate.args(["simulate", SCENARIO, "--seed", &case.seed.to_string(), "--out"]).arg(&voyage);
    run(simulate.args(case.sets.iter().flat_map(|set| ["--set", set])))?;
    let is_of_receiver = matches!(case.kind, Kind::Honest | Kind::Spoofer);
    let ways: &[Way] = if is_of_receiver { &[Way::Tight, Way::Loose] } else { &[Way::Tight] };
    let mut sailed = Vec::new();
    for way in ways {
        let outcome = replay(program, &voyage, *way, case.wrong)
            .map_err(|why| format!("{word} {}: {why}", case.seed))?;
        tell(case, *way, &outcome);
        sailed.push((*way, outcome));
    }
    if std::env::var_os("KEEP").is_none() {
        std::fs::remove_dir_all(&folder)?;
    }
    Ok(sailed)
}

fn replay(
    program: &str,
    voyage: &Path,
    way: Way,
    wrong: Option<[f64; 2]>,
) -> Result<Outcome, Failed> {
    let gnss = if way == Way::Tight { "tight" } else { "loose" };
    let out = voyage.with_file_name(format!("{gnss}.csv"));
    let mut replay = Command::new(program);
    run(replay.arg("replay").arg(voyage).args(["--gnss", gnss, "--rate", "2", "--out"]).arg(&out))?;
    outcome(&out, &voyage.join("truth.csv"), wrong).map_err(|why| why.to_string().into())
}

fn tell(case: &Case, way: Way, own: &Outcome) {
    let is_ill = own.hazardous + own.exceeded + own.alerts > 0;
    if std::env::var_os("CASES").is_none() && !is_ill {
        return;
    }
    let from = case.wrong.map_or(0.0, |[from, _]| from);
    eprintln!(
        "{} {} {way:?} ({}) from {from:.0}: available {:.2}, hazardous {:.0} s, misleading {:.0} s, beyond {:.0} s, ratio {:.2} at {:.0}, \
         error {:.1}, told {:?}, alerts {}, out {:?}",
        case.kind.name(),
        case.seed,
        case.size,
        own.available as f64 / own.epochs as f64,
        own.hazardous as f64 * own.step,
        own.misleading as f64 * own.step,
        own.exceeded as f64 * own.step,
        own.ratio.0,
        own.ratio.1,
        own.error,
        own.told,
        own.alerts,
        own.excluded,
    );
}
