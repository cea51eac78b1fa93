//! Shipped voyages with honest sensors, as they are and with another grade of IMU, and with logs that tell less.

use insd_simulator::{Override, Scenario, shipped, simulate};
use rayon::prelude::*;

use crate::sail::{Row, sail};

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
pub(crate) fn sail_all(seeds: u64) {
    let (mut hours, mut alarms) = (0.0, 0.0);
    for (name, text) in shipped() {
        if DISHONEST.iter().any(|number| name.starts_with(number)) {
            continue;
        }
        for (variant, overrides) in VARIANTS {
            let Some(scenario) = scenario(text, overrides) else { continue };
            let of_seed = |seed: u64| {
                let voyage = simulate(&scenario, seed);
                Honest::of(&sail(&voyage, &voyage))
            };
            let all: Vec<Honest> = (1..=seeds).into_par_iter().map(of_seed).collect();
            let worst = |of: fn(&Honest) -> f64| all.iter().map(of).fold(0.0, f64::max);
            let named = all.iter().filter(|own| own.named > 0.0).count();
            hours += all.iter().map(|own| own.hours).sum::<f64>();
            alarms += named as f64;
            println!(
                "{name:<28}{variant:<18}{named} of {seeds} name somebody, for {:.0} s at most; greatest level {:.2} of what is \
                 claimed, heading {:.1} sigmas; {:?}",
                worst(|own| own.named),
                worst(|own| own.level),
                worst(|own| own.heading),
                all.iter().find_map(|own| own.whom.clone())
            );
        }
    }
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
struct Honest {
    hours: f64,
    /// For how long somebody is named, s.
    named: f64,
    whom: Option<(f64, Vec<&'static str>)>,
    /// Greatest horizontal error over its level, and heading error in sigmas.
    level: f64,
    heading: f64,
}

impl Honest {
    fn of(rows: &[Row]) -> Self {
        let named = rows.iter().filter(|row| !row.excluded.is_empty());
        let whom = named.clone().map(|row| (row.time, row.excluded.clone())).next();
        let told = rows.iter().filter(|row| row.told);
        let greatest = |of: fn(&Row) -> f64| told.clone().map(of).fold(0.0, f64::max);
        Honest {
            hours: rows.last().map_or(0.0, |row| row.time) / 3600.0,
            named: named.count() as f64,
            whom,
            level: greatest(|row| row.off / row.level),
            heading: greatest(|row| row.heading.0 / row.heading.1),
        }
    }
}
