//! Antennas that are a compass, and docking aids, that lie: whether and how soon it is told, and how far off she was beside her claims.
//!
//! `aid_faults [SEEDS] [KIND]`: so many voyages of each kind, or of those whose name begins so. `CASES=1` in the environment tells each, `TRACE=1` each
//! second, `SEED=3` takes one of them. Options as those of `insd campaign` sail it in parts and put parts together.

mod antennas;
mod docking;
mod sail;

use clap::Parser as _;
use insd_lab::parts::{CaseList, CaseRun, PartsArgs, gather};

use sail::{Case, Score};

/// What is sailed.
#[derive(Debug, clap::Parser)]
struct Args {
    /// Voyages of each kind
    #[arg(default_value_t = 10)]
    seeds: u64,
    /// Kinds whose name begins so
    #[arg(default_value = "")]
    kind: String,
    #[command(flatten)]
    parts: PartsArgs,
}

/// When a lie begins, and what it is.
type Kind = (&'static str, fn(u64) -> Option<Case>);

const KINDS: [Kind; 16] = [
    ("antennas: honest", |seed| antennas::case(seed, antennas::Lie::None)),
    ("antennas: turned by 3 deg", |seed| antennas::case(seed, antennas::Lie::Turned)),
    ("antennas: knocked by 3 deg", |seed| antennas::case(seed, antennas::Lie::Knocked(3.0))),
    ("antennas: knocked by 10 deg", |seed| antennas::case(seed, antennas::Lie::Knocked(10.0))),
    ("antennas: other cycles", |seed| antennas::case(seed, antennas::Lie::OtherCycles)),
    ("antennas: bent, 0.1 deg/s", |seed| antennas::case(seed, antennas::Lie::Bent)),
    ("gyrocompass: 3 deg", |seed| antennas::case(seed, antennas::Lie::Gyrocompass)),
    ("with a gyrocompass: knocked", |seed| antennas::case(seed, antennas::Lie::BesideCompass)),
    ("lasers: honest", |seed| docking::case(seed, docking::Lie::None)),
    ("lasers: one is 5 m off", |seed| docking::case(seed, docking::Lie::Off)),
    ("lasers: the line is 5 m off", |seed| docking::case(seed, docking::Lie::Line)),
    ("lasers: one freezes", |seed| docking::case(seed, docking::Lie::Frozen)),
    ("lasers: one jumps 2 m", |seed| docking::case(seed, docking::Lie::Jump)),
    ("lasers: one drifts, 5 cm/s", |seed| docking::case(seed, docking::Lie::Drift)),
    ("lasers, codes: line 5 m off", |seed| docking::by_codes(seed, docking::Lie::Line)),
    ("lasers, codes: drifts, 5 cm/s", |seed| docking::by_codes(seed, docking::Lie::Drift)),
];

fn main() -> anyhow::Result<()> {
    let args = Args::parse();
    let one: Option<u64> = std::env::var("SEED").ok().and_then(|text| text.parse().ok());
    let seeds = one.map_or(1..=args.seeds, |seed| seed..=seed);
    let kinds = KINDS.iter().filter(|(name, _)| name.starts_with(&args.kind));
    let names = kinds.flat_map(|(kind, _)| seeds.clone().map(move |seed| format!("{kind}|{seed}")));
    let declared = CaseList::new("aid faults", "", names.collect(), "");
    let kept = gather(&args.parts, vec![declared], |_, name: &String| {
        Ok(CaseRun { case: name.clone(), score: drawn(name).map(|case| sail::sail(&case)) })
    })?;
    let kept = kept.into_cases();
    table(&kept.runs);
    print!("{}", kept.lack());
    Ok(())
}

/// The case of a name; `None` where it cannot be made.
fn drawn(name: &str) -> Option<Case> {
    let (kind, seed) = name.rsplit_once('|')?;
    let (_, case) = KINDS.iter().find(|(own, _)| *own == kind)?;
    case(seed.parse().ok()?)
}

fn table(runs: &[CaseRun<Option<Score>>]) {
    let kind = |run: &CaseRun<Option<Score>>| {
        run.case.rsplit_once('|').map_or_else(String::new, |(kind, _)| kind.to_owned())
    };
    println!("{}", sail::HEAD);
    for own in runs.chunk_by(|a, b| kind(a) == kind(b)) {
        let scores: Vec<Score> = own.iter().filter_map(|run| run.score).collect();
        println!("{}", sail::row(&kind(&own[0]), &scores));
        if std::env::var_os("CASES").is_some() {
            scores.iter().for_each(|score| println!("    {score:?}"));
        }
    }
}
