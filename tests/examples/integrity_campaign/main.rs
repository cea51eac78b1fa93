//! Simulated ports in which something is wrong: whether protection levels hold, and how soon it is told. One table.
//!
//! ```text
//! cargo run --release -p insd-tests --example integrity_campaign -- target/release/insd 50 docs/protection.md
//! ```
//!
//! Each kind of fault has so many voyages, which differ in port, ship, IMU, with a log or without, size, satellite and onset; they are made in
//! `target/integrity-campaign`. Spoofers and honest voyages are replayed by fixes alone, too. Without a page the table is printed. In the environment
//! `KIND=spoofer` takes the kinds whose name begins so, `SEED=3` one of the seeds, `KEEP=1` keeps the voyages, and `CASES=1` tells each.

mod case;
mod outcome;
mod table;

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::Command;

use insd_tests::pages;
use insd_tests::programs::run;
use rayon::iter::{IntoParallelIterator, ParallelIterator};

use case::{Case, KINDS, Kind, SCENARIO};
use outcome::{Outcome, outcome};

/// What a voyage is replayed with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Way {
    /// Ranges of satellites.
    Tight,
    /// Fixes of a receiver.
    Loose,
}

type Failed = Box<dyn Error + Send + Sync>;

fn main() -> Result<(), Failed> {
    let mut arguments = std::env::args().skip(1);
    let program = arguments.next().ok_or("which insd? target/release/insd")?;
    let seeds: u64 = arguments.next().map_or(Ok(50), |seeds| seeds.parse())?;
    let only = std::env::var("KIND").unwrap_or_default();
    let one: Option<u64> = std::env::var("SEED").ok().and_then(|seed| seed.parse().ok());
    let seeds = one.map_or(1..=seeds, |seed| seed..=seed);
    let mut rows = Vec::new();
    for kind in KINDS.into_iter().filter(|kind| kind.name().starts_with(&only)) {
        let cases = seeds.clone().into_par_iter().map(|seed| Case::new(kind, seed));
        let sailed: Result<Vec<_>, Failed> = cases.map(|case| sail(&program, &case)).collect();
        let sailed: Vec<(Case, Way, Outcome)> = sailed?.into_iter().flatten().collect();
        for way in [Way::Tight, Way::Loose] {
            let own: Vec<&Outcome> =
                sailed.iter().filter(|own| own.1 == way).map(|own| &own.2).collect();
            let name = format!("{}{}", kind.name(), if way == Way::Loose { ", fixes" } else { "" });
            rows.extend((!own.is_empty()).then(|| table::row(&name, &own)));
        }
        eprint!("{}", rows.last().map_or("", String::as_str));
    }
    let table = table::HEAD.to_owned() + &rows.concat();
    Ok(pages::put(arguments.next(), "integrity-campaign", &table)?)
}

/// Makes a voyage and replays it.
fn sail(program: &str, case: &Case) -> Result<Vec<(Case, Way, Outcome)>, Failed> {
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
        sailed.push((case.clone(), *way, outcome));
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
