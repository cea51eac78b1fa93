//! Antennas that are a compass, and docking aids, that lie: whether and how soon it is told, and how far off she was beside her claims.
//!
//! `aid_faults [SEEDS] [KIND]`: so many voyages of each kind, or of those whose name begins so. `CASES=1` in the environment tells each, `TRACE=1` each
//! second, `SEED=3` takes one of them.

mod antennas;
mod docking;
mod sail;

use rayon::iter::{IntoParallelIterator, ParallelIterator};

use sail::{Case, Score};

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

fn main() {
    let seeds: u64 = std::env::args().nth(1).and_then(|text| text.parse().ok()).unwrap_or(10);
    let which = std::env::args().nth(2).unwrap_or_default();
    let one: Option<u64> = std::env::var("SEED").ok().and_then(|text| text.parse().ok());
    let seeds = one.map_or(1..=seeds, |seed| seed..=seed);
    println!("{}", sail::HEAD);
    for (name, case) in KINDS.iter().filter(|(name, _)| name.starts_with(&which)) {
        let all = seeds.clone().into_par_iter();
        let scores: Vec<Score> = all.filter_map(|seed| Some(sail::sail(&case(seed)?))).collect();
        println!("{}", sail::row(name, &scores));
        if std::env::var_os("CASES").is_some() {
            scores.iter().for_each(|score| println!("    {score:?}"));
        }
    }
}
