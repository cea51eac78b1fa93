//! Voyages with a sensor that lies: what it costs, who is told, and whether the right one is named.
//!
//! `faults [DRAWS] [KIND]`: each kind of `insd_simulator::lies`, or those whose name begins so, with both
//! grades of IMU and every suite of sensors, so many times; then, or of the kind `honest` alone, the same hours with honest
//! sensors. `scenarios` sails the shipped voyages with honest sensors instead. In the environment
//! `CASES=1` tells each case, `ONLY="Mems log"` takes one grade and suite, `TRACE=1` tells each second, `SEED=3` takes one of
//! the draws.

mod sail;
mod scenarios;
mod score;

use insd_simulator::lies::{Case, Class, Grade, Kind, Suite, case, catalogue};
use rayon::prelude::*;

use sail::sail;
use score::{Score, Sum, score};

/// Honest hours for each grade and suite, a share of the draws.
const HONEST: u64 = 2;

fn main() {
    let draws: u64 = std::env::args().nth(1).and_then(|text| text.parse().ok()).unwrap_or(5);
    let which = std::env::args().nth(2).unwrap_or_default();
    if which == "scenarios" {
        return scenarios::sail_all(draws);
    }
    let kinds = catalogue().iter().filter(|kind| kind.name.starts_with(&which));
    let mut all = Sum::default();
    println!("{}", Sum::HEAD);
    for kind in kinds {
        let cases = cases(kind, draws);
        let scores: Vec<(Case, Score)> = cases.into_par_iter().filter_map(judge).collect();
        let sum: Sum = scores.iter().map(|(_, score)| score).collect();
        println!("{:<28}{sum}", kind.name);
        if std::env::var_os("CASES").is_some() {
            scores.iter().for_each(|(case, score)| tell(case, score));
        }
        all.extend(&sum);
    }
    println!("{:<28}{all}", "all");
    if which.is_empty() || which == "honest" {
        honest(draws * HONEST);
    }
}

fn cases(kind: &Kind, draws: u64) -> Vec<Case> {
    let grades = [Grade::Navigation, Grade::Mems];
    let of_grade = |grade| kind.suites.iter().map(move |suite| (grade, *suite));
    let only = std::env::var("ONLY").unwrap_or_default();
    let seed: Option<u64> = std::env::var("SEED").ok().and_then(|text| text.parse().ok());
    let seeds = seed.map_or(1..=draws, |seed| seed..=seed);
    let places = grades.into_iter().flat_map(of_grade);
    let places =
        places.filter(|(grade, suite)| only.is_empty() || format!("{grade:?} {suite}") == only);
    places
        .flat_map(|place| seeds.clone().map(move |seed| (place, seed)))
        .map(|((grade, suite), seed)| case(kind, grade, suite, seed))
        .collect()
}

fn judge(case: Case) -> Option<(Case, Score)> {
    let honest = case.honest().ok()?;
    let spoilt = case.spoilt(&honest);
    let case = case.shown_in(&honest, &spoilt);
    let rows = sail(&spoilt, &honest);
    let score = score(&case, &rows);
    Some((case, score))
}

fn tell(case: &Case, score: &Score) {
    let class = match case.class {
        Class::Required => 'R',
        Class::Told => 'T',
        Class::Bounded => 'B',
    };
    println!("    {class} {:?} {:<9} {} {}", case.grade, case.suite.to_string(), score, case.size);
}

/// Hours without a liar: alarms, and how much of the time the position could be used.
fn honest(draws: u64) {
    let Some(kind) = catalogue().first() else { return };
    let suites = [Suite::Gnss, Suite::Log, Suite::Compass, Suite::Both, Suite::Two];
    for grade in [Grade::Navigation, Grade::Mems] {
        for suite in suites {
            let rows: Vec<_> = (1..=draws)
                .into_par_iter()
                .filter_map(|seed| case(kind, grade, suite, 1000 + seed).honest().ok())
                .map(|voyage| score::honest(&sail(&voyage, &voyage)))
                .collect();
            let hours = rows.len() as f64;
            let sum = |of: fn(&(f64, f64)) -> f64| rows.iter().map(of).sum::<f64>() / hours;
            let (alarms, available) = (sum(|row| row.0), sum(|row| row.1));
            println!(
                "honest {grade:?} {:<9} {alarms:.2} alarms an hour, usable {:.2} % of the time",
                suite.to_string(),
                100.0 * available
            );
        }
    }
}
