//! Voyages with an installation that is not as configured: what it costs, and whether it is told.
//!
//! `installation [SEEDS]`: each mistake of the table on the shipped voyages, beside the same voyages with
//! the right configuration. Errors are judged from fifteen minutes under way.

mod mistakes;
mod outcome;

use insd_simulator::{Scenario, shipped, simulate};
use rayon::prelude::*;

use mistakes::{MISTAKES, Mistake};
use outcome::{Outcome, sail};

/// Voyages: number of the scenario, when it is cut off, when fifteen minutes under way are over, s.
const VOYAGES: [(&str, f64, f64); 4] =
    [("02", 5400.0, 1500.0), ("03", 5400.0, 1500.0), ("10", 1800.0, 900.0), ("01", 1800.0, 1600.0)];

fn main() {
    let seeds: u64 = std::env::args().nth(1).and_then(|text| text.parse().ok()).unwrap_or(20);
    let only = std::env::args().nth(2);
    for (number, duration, from) in VOYAGES {
        if only.as_ref().is_some_and(|only| only != number) {
            continue;
        }
        let Some((name, text)) = shipped().iter().find(|(name, _)| name.starts_with(number)) else {
            continue;
        };
        let scenario = match Scenario::from_toml(text) {
            Ok(scenario) => scenario,
            Err(fault) => return eprintln!("{name}: {fault}"),
        };
        let duration = duration.min(scenario.duration());
        let scenario = scenario.with_duration(duration);
        println!("\n{name}, {seeds} seeds, judged from {from:.0} s");
        println!("{}", Outcome::HEAD);
        for mistake in &MISTAKES {
            println!("{}", campaign(&scenario, mistake, seeds, from));
        }
    }
}

/// All seeds of one mistake.
fn campaign(scenario: &Scenario, mistake: &Mistake, seeds: u64, from: f64) -> Outcome {
    let one = |seed: u64| sail(simulate(scenario, seed), mistake, from);
    let outcomes: Vec<Outcome> = (1..=seeds).into_par_iter().map(one).collect();
    Outcome::of(mistake.name, &outcomes)
}
