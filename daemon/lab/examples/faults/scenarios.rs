//! Shipped voyages with honest sensors, as they are and with another grade of IMU, and with logs that tell less.

use std::collections::BTreeMap;

use insd_lab::parts::{CaseList, CaseRun, PartsArgs, gather};
use insd_simulator::{Override, Scenario, shipped, simulate};
use serde::{Deserialize, Serialize};

use super::sail::{Row, sail};

/// What is sailed besides each voyage as it is shipped.
const VARIANTS: [(&str, &[&str]); 4] = [
    ("as shipped", &[]),
    ("mems", &["imu.grade=\"mems\""]),
    ("log of two axes", &["log.axes=\"uv\""]),
    ("log of one axis", &["log.axes=\"u\""]),
];
/// Voyages whose receivers are not honest.
const DISHONEST: [&str; 1] = ["05"];

/// An hour of each at the most.
const LONGEST: f64 = 3600.0;

/// Alarms of honest voyages: seconds at which somebody is named, and how far off she was beside her claims.
pub(crate) fn sail_all(seeds: u64, parts: &PartsArgs) -> anyhow::Result<()> {
    let (mut names, mut by_name) = (Vec::new(), BTreeMap::new());
    for (voyage, scenario) in voyages() {
        for seed in 1..=seeds {
            let name = format!("{voyage}|{seed}");
            names.push(name.clone());
            by_name.insert(name, (scenario.clone(), seed));
        }
    }
    let content = format!("{:?}", by_name.values());
    let declared = CaseList::new("honest scenarios", "", names, &content);
    let kept = gather(parts, vec![declared], |_, name: &String| {
        let drawn = by_name.get(name);
        let voyage = drawn.map(|(scenario, seed)| simulate(scenario, *seed));
        let score = voyage.map(|voyage| Calm::of(&sail(&voyage, &voyage)));
        Ok(CaseRun { case: name.clone(), score: score.unwrap_or_default() })
    })?;
    let kept = kept.into_cases();
    table(&kept.runs);
    print!("{}", kept.lack());
    Ok(())
}

/// Each voyage with each variant: its name, and the name of the variant behind a bar.
fn voyages() -> Vec<(String, Scenario)> {
    let honest = shipped()
        .iter()
        .filter(|(name, _)| !DISHONEST.iter().any(|number| name.starts_with(number)));
    let variants = honest.flat_map(|voyage| VARIANTS.map(|variant| (voyage, variant)));
    let made = variants.filter_map(|((name, text), (variant, overrides))| {
        Some((format!("{name}|{variant}"), scenario(text, overrides)?))
    });
    made.collect()
}

fn table(runs: &[CaseRun<Calm>]) {
    let of = |run: &CaseRun<Calm>| {
        run.case.rsplit_once('|').map_or_else(String::new, |(voyage, _)| voyage.to_owned())
    };
    for own in runs.chunk_by(|a, b| of(a) == of(b)) {
        let voyage = of(&own[0]);
        let (name, variant) = voyage.split_once('|').unwrap_or_default();
        let worst =
            |value: fn(&Calm) -> f64| own.iter().map(|run| value(&run.score)).fold(0.0, f64::max);
        println!(
            "{name:<28}{variant:<18}{} of {} name somebody, for {:.0} s at most; greatest level {:.2} of what is \
             claimed, heading {:.1} sigmas; {:?}",
            own.iter().filter(|run| run.score.named > 0.0).count(),
            own.len(),
            worst(|own| own.named),
            worst(|own| own.level),
            worst(|own| own.heading),
            own.iter().find_map(|run| run.score.whom.clone())
        );
    }
    let hours: f64 = runs.iter().map(|run| run.score.hours).sum();
    let alarms = runs.iter().filter(|run| run.score.named > 0.0).count();
    println!("{hours:.0} hours, {alarms} voyages that name somebody");
}

/// A shipped voyage with something otherwise; `None` where that makes none, or changes nothing.
fn scenario(text: &str, overrides: &[&str]) -> Option<Scenario> {
    let has_log = text.contains("[log]");
    if overrides.iter().any(|own| own.starts_with("log.") && !has_log) {
        return None;
    }
    let overrides: Vec<Override> = overrides.iter().filter_map(|own| own.parse().ok()).collect();
    let scenario = Scenario::with_overrides(text, &overrides).ok()?;
    let duration = scenario.duration().min(LONGEST);
    Some(scenario.with_duration(duration))
}

/// One of them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Calm {
    hours: f64,
    /// For how long somebody is named, s.
    named: f64,
    whom: Option<(f64, Vec<String>)>,
    /// Greatest horizontal error over its level, and heading error in sigmas.
    level: f64,
    heading: f64,
}

impl Calm {
    fn of(rows: &[Row]) -> Self {
        let named = rows.iter().filter(|row| !row.excluded.is_empty());
        let words = |row: &Row| row.excluded.iter().map(|word| (*word).to_owned()).collect();
        let whom = named.clone().map(|row| (row.time, words(row))).next();
        let told = rows.iter().filter(|row| row.told);
        let greatest = |of: fn(&Row) -> f64| told.clone().map(of).fold(0.0, f64::max);
        Calm {
            hours: rows.last().map_or(0.0, |row| row.time) / 3600.0,
            named: named.count() as f64,
            whom,
            level: greatest(|row| row.off / row.level),
            heading: greatest(|row| row.heading.0 / row.heading.1),
        }
    }
}
