//! Voyages with an installation that is not as configured: what it costs, and whether it is told.
//!
//! `installation [SEEDS] [VOYAGE] [MISTAKE]`: each mistake of the table, or those whose name begins so, on the
//! shipped voyages, beside the same voyages with the right configuration. Errors are judged from fifteen
//! minutes under way. `SEED=3` in the environment takes one of the seeds, `COMPASS=1` has an honest compass aboard,
//! `WORDS=1` prints what is said, and `TRACE=1` errors and claims with all that happens.

mod mistakes;
mod outcome;

use insd_simulator::lies::compass;
use insd_simulator::{Override, Scenario, shipped, simulate};
use rayon::prelude::*;

use mistakes::{MISTAKES, Mistake};
use outcome::{Outcome, sail};

/// Voyages: number of the scenario, when it is cut off, when fifteen minutes under way are over, s.
const VOYAGES: [(&str, f64, f64); 4] =
    [("02", 5400.0, 1500.0), ("03", 5400.0, 1500.0), ("10", 1800.0, 900.0), ("01", 1800.0, 1600.0)];

fn main() {
    let seeds: u64 = std::env::args().nth(1).and_then(|text| text.parse().ok()).unwrap_or(20);
    let only = std::env::args().nth(2);
    let which = std::env::args().nth(3).unwrap_or_default();
    for (number, until, from) in VOYAGES {
        if only.as_ref().is_some_and(|only| only != number) {
            continue;
        }
        let Some((name, text)) = shipped().iter().find(|(name, _)| name.starts_with(number)) else {
            continue;
        };
        println!("\n{name}, {seeds} seeds, judged from {from:.0} s");
        println!("{}", Outcome::HEAD);
        for mistake in MISTAKES.iter().filter(|mistake| mistake.name.starts_with(&which)) {
            match scenario(text, mistake, until) {
                Ok(scenario) => println!("{}", campaign(&scenario, mistake, seeds, from)),
                Err(fault) => eprintln!("{name}: {fault}"),
            }
        }
    }
}

/// The voyage of the ship that the mistake is made on.
fn scenario(text: &str, mistake: &Mistake, until: f64) -> Result<Scenario, String> {
    let ship: Option<Override> = mistake.ship.map(str::parse).transpose()?;
    let scenario =
        Scenario::with_overrides(text, ship.as_slice()).map_err(|fault| fault.to_string())?;
    let duration = scenario.duration().min(until);
    Ok(scenario.with_duration(duration))
}

/// All seeds of one mistake.
fn campaign(scenario: &Scenario, mistake: &Mistake, seeds: u64, from: f64) -> Outcome {
    let has_compass = std::env::var_os("COMPASS").is_some();
    let one = |seed: u64| {
        let mut voyage = simulate(scenario, seed);
        if has_compass {
            voyage.reference.extend(compass(&voyage, seed));
            voyage.reference.sort_by_key(|told| told.message.time);
        }
        sail(voyage, mistake, from)
    };
    let seed: Option<u64> = std::env::var("SEED").ok().and_then(|text| text.parse().ok());
    let seeds = seed.map_or(1..=seeds, |seed| seed..=seed);
    let outcomes: Vec<Outcome> = seeds.into_par_iter().map(one).collect();
    Outcome::of(mistake.name, &outcomes)
}
