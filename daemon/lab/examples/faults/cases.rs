//! The cases of the catalogue with what came of each, and their tables.

use std::collections::BTreeMap;

use insd_lab::parts::{CaseList, CaseRun, PartsArgs, gather};
use insd_simulator::lies::{Case, Class, Grade, LieKind, Suite, case, catalogue};
use serde::{Deserialize, Serialize};

use super::sail::sail;
use super::score::{Honest, Score, Sum, honest, score};

/// Honest hours for each grade and suite, a share of the draws.
const HONEST: u64 = 2;
/// Their first seed.
const HONEST_FROM: u64 = 1001;

/// One voyage of the catalogue.
#[derive(Clone, Copy)]
struct Draw {
    /// Nobody lies where there is none.
    kind: Option<&'static LieKind>,
    grade: Grade,
    suite: Suite,
    seed: u64,
}

/// What came of it; nothing where it could not be made.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
enum Told {
    Lie { class: char, size: String, score: Score },
    Honest(Honest),
    Unmade,
}

/// Sails, or puts together, and prints the tables.
pub(crate) fn sail_all(draws: u64, which: &str, parts: &PartsArgs) -> anyhow::Result<()> {
    let all = draws_of(draws, which);
    let names: Vec<String> = all.iter().map(Draw::name).collect();
    let by_name: BTreeMap<&str, Draw> =
        names.iter().map(String::as_str).zip(all.iter().copied()).collect();
    let declared = CaseList::new("faults", "", names.clone(), "");
    let kept = gather(parts, vec![declared], |_, name: &String| {
        let score = by_name.get(name.as_str()).map_or(Told::Unmade, Draw::sail);
        Ok(CaseRun { case: name.clone(), score })
    })?;
    let kept = kept.into_cases();
    tables(&kept.runs);
    print!("{}", kept.lack());
    Ok(())
}

/// The voyages in the order in which they are told.
fn draws_of(draws: u64, which: &str) -> Vec<Draw> {
    let kinds = catalogue().iter().filter(|kind| kind.name.starts_with(which));
    let lies = kinds.flat_map(|kind| lies(kind, draws));
    let is_honest = which.is_empty() || which == "honest";
    let suites = [Suite::Gnss, Suite::Log, Suite::Compass, Suite::Both, Suite::Two];
    let honest = places(&suites).into_iter().filter(|_| is_honest).flat_map(|(grade, suite)| {
        (HONEST_FROM..HONEST_FROM + draws * HONEST).map(move |seed| Draw {
            kind: None,
            grade,
            suite,
            seed,
        })
    });
    lies.chain(honest).collect()
}

fn places(suites: &[Suite]) -> Vec<(Grade, Suite)> {
    let grades = [Grade::Navigation, Grade::Mems];
    grades.into_iter().flat_map(|grade| suites.iter().map(move |suite| (grade, *suite))).collect()
}

fn lies(kind: &'static LieKind, draws: u64) -> Vec<Draw> {
    let only = std::env::var("ONLY").unwrap_or_default();
    let seed: Option<u64> = std::env::var("SEED").ok().and_then(|text| text.parse().ok());
    let seeds = seed.map_or(1..=draws, |seed| seed..=seed);
    let places = places(kind.suites).into_iter();
    places
        .filter(|(grade, suite)| only.is_empty() || format!("{grade:?} {suite}") == only)
        .flat_map(|place| seeds.clone().map(move |seed| (place, seed)))
        .map(|((grade, suite), seed)| Draw { kind: Some(kind), grade, suite, seed })
        .collect()
}

impl Draw {
    /// Kind, grade, suite and draw, with bars between them.
    fn name(&self) -> String {
        let kind = self.kind.map_or("honest", |kind| kind.name);
        format!("{kind}|{:?}|{}|{}", self.grade, self.suite, self.seed)
    }

    fn sail(&self) -> Told {
        match self.kind {
            Some(kind) => judge(case(kind, self.grade, self.suite, self.seed)),
            None => self.sail_honestly(),
        }
        .unwrap_or(Told::Unmade)
    }

    /// An hour without a liar, of a ship that any kind would have.
    fn sail_honestly(&self) -> Option<Told> {
        let voyage = case(catalogue().first()?, self.grade, self.suite, self.seed).honest().ok()?;
        Some(Told::Honest(honest(&sail(&voyage, &voyage))))
    }
}

fn judge(case: Case) -> Option<Told> {
    let honest = case.honest().ok()?;
    let spoilt = case.spoilt(&honest);
    let case = case.shown_in(&honest, &spoilt);
    let score = score(&case, &sail(&spoilt, &honest));
    let class = match case.class {
        Class::Required => 'R',
        Class::Told => 'T',
        Class::Bounded => 'B',
    };
    Some(Told::Lie { class, size: case.size.to_string(), score })
}

/// A table of the kinds, and the honest hours of each grade and suite.
fn tables(runs: &[CaseRun<Told>]) {
    let lies: Vec<(&str, &CaseRun<Told>, &Score)> = runs.iter().filter_map(lie).collect();
    let mut all = Sum::default();
    println!("{}", Sum::HEAD);
    for own in lies.chunk_by(|(a, ..), (b, ..)| a == b) {
        let sum: Sum = own.iter().map(|(_, _, score)| *score).collect();
        println!("{:<28}{sum}", own[0].0);
        if std::env::var_os("CASES").is_some() {
            own.iter().for_each(|(_, run, _)| tell(run));
        }
        all.extend(&sum);
    }
    println!("{:<28}{all}", "all");
    let honest: Vec<(&str, &Honest)> = runs.iter().filter_map(honest_hour).collect();
    for own in honest.chunk_by(|(a, _), (b, _)| a == b) {
        let hours = own.len() as f64;
        let mean = |of: fn(&Honest) -> f64| own.iter().map(|(_, own)| of(own)).sum::<f64>() / hours;
        let (alarms, usable) = (mean(|own| own.alarms), 100.0 * mean(|own| own.usable));
        let (grade, suite) = own[0].0.split_once('|').unwrap_or_default();
        println!(
            "honest {grade} {suite:<9} {alarms:.2} alarms an hour, usable {usable:.2} % of the time"
        );
    }
}

/// A case with a liar: kind, run and score.
fn lie(run: &CaseRun<Told>) -> Option<(&str, &CaseRun<Told>, &Score)> {
    let Told::Lie { score, .. } = &run.score else { return None };
    Some((run.case.split('|').next()?, run, score))
}

/// An honest one: grade and suite, and what came of it.
fn honest_hour(run: &CaseRun<Told>) -> Option<(&str, &Honest)> {
    let Told::Honest(own) = &run.score else { return None };
    let (place, _) = run.case.strip_prefix("honest|")?.rsplit_once('|')?;
    Some((place, own))
}

fn tell(run: &CaseRun<Told>) {
    let Told::Lie { class, size, score } = &run.score else { return };
    let mut parts = run.case.split('|').skip(1);
    let (grade, suite) = (parts.next().unwrap_or_default(), parts.next().unwrap_or_default());
    println!("    {class} {grade} {suite:<9} {score} {size}");
}
