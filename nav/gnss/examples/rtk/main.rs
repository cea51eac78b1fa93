//! Rovers against bases of real receivers, as they are and damaged: the tables of docs/rtk.md.
//!
//! ```text
//! INSD_RAW_GNSS=... cargo run --release -p insd-gnss --example rtk [-- "words of a label"]
//! ```

#![allow(clippy::unwrap_used)] // a file that is missing ends it

#[path = "../../src/tests/random.rs"]
mod random;
#[path = "../../tests/sets/mod.rs"]
mod sets;

mod damage;

use std::collections::BTreeMap;

use damage::Damage;
use insd_gnss::{Context, PlacedEpoch, RtkFix, RtkRefusal, RtkSettings, RtkTracker};
use nalgebra::Vector3;
use sets::{Moment, PAIRS, Pair, horizontal, vertical};

const HEAD: &str = "| set, constellations, bands | epochs | phases | fixed | wrong | of parts | horizontal RMS, mm | vertical | withdrawn | not fixed because |\n\
    |---|---|---|---|---|---|---|---|---|---|";

/// Seeds, and how long errors last, s.
const DAMAGED: [(u64, f64); 4] = [(0, 5.0), (1, 5.0), (0, 40.0), (1, 40.0)];

fn main() {
    let Some(folder) = sets::folder() else { return };
    let wanted = std::env::args().nth(1).unwrap_or_default();
    println!("{HEAD}");
    let (mut single, mut continuous) = (Judged::default(), Judged::default());
    for pair in PAIRS.iter().filter(|pair| pair.label.contains(&wanted)) {
        let set = Set { context: pair.context(&folder), moments: pair.moments(&folder), pair };
        println!("{}", set.judged(alone(), None).row(pair.label, "single"));
        println!("{}", set.judged(carried(), None).row(pair.label, "continuous"));
        for (seed, lasts) in DAMAGED {
            single.add(&set.judged(alone(), Some(Damage::new(seed, lasts))));
            continuous.add(&set.judged(carried(), Some(Damage::new(seed, lasts))));
        }
    }
    println!("{}", single.row("all, damaged", "single"));
    println!("{}", continuous.row("all, damaged", "continuous"));
}

fn alone() -> RtkTracker {
    RtkTracker::single_epoch(RtkSettings::default())
}

fn carried() -> RtkTracker {
    RtkTracker::continuous(RtkSettings::default())
}

/// A pair with all its epochs.
struct Set<'a> {
    context: Context,
    moments: Vec<Moment>,
    pair: &'a Pair,
}

/// What was found of a set.
#[derive(Default)]
struct Judged {
    epochs: usize,
    phases: usize,
    fixed: usize,
    wrong: usize,
    of_parts: usize,
    withdrawn: usize,
    horizontal: f64,
    vertical: f64,
    refused: BTreeMap<&'static str, usize>,
}

impl Set<'_> {
    fn judged(&self, mut tracker: RtkTracker, mut damage: Option<Damage>) -> Judged {
        let mut judged = Judged::default();
        let position = Vector3::from(self.pair.base_at);
        for moment in &self.moments {
            judged.epochs += 1;
            let base = PlacedEpoch { epoch: &moment.base, position };
            let damaged = damage.as_mut().map(|damage| damage.done_to(&moment.rover));
            let rover = damaged.as_ref().unwrap_or(&moment.rover);
            let told = tracker.take(&self.context, rover, &base, None);
            judged.phases += told.as_ref().map_or(0, |told| told.phases);
            match told.and_then(|told| told.fixed) {
                Ok(fix) => judged.note(&fix, &(fix.position - moment.truth.unwrap())),
                Err(why) => *judged.refused.entry(reason(&why)).or_default() += 1,
            }
        }
        judged.withdrawn = tracker.withdrawals();
        judged
    }
}

impl Judged {
    fn note(&mut self, fix: &RtkFix, off: &Vector3<f64>) {
        self.fixed += 1;
        self.of_parts += usize::from(fix.attempts > 1);
        if off.norm() > 0.1 {
            self.wrong += 1;
        } else {
            self.horizontal += horizontal(&fix.position, off).powi(2);
            self.vertical += vertical(&fix.position, off).powi(2);
        }
    }

    fn add(&mut self, other: &Self) {
        self.epochs += other.epochs;
        self.phases += other.phases;
        self.fixed += other.fixed;
        self.wrong += other.wrong;
        self.of_parts += other.of_parts;
        self.withdrawn += other.withdrawn;
        self.horizontal += other.horizontal;
        self.vertical += other.vertical;
        for (why, count) in &other.refused {
            *self.refused.entry(why).or_default() += count;
        }
    }

    fn row(&self, label: &str, epochs: &str) -> String {
        let right = (self.fixed - self.wrong).max(1) as f64;
        let rms = |squares: f64| (squares / right).sqrt() * 1e3;
        let refused: Vec<_> =
            self.refused.iter().map(|(why, count)| format!("{why} {count}")).collect();
        format!(
            "| {label}, {epochs} | {} | {:.0} | {} | {} | {} | {:.1} | {:.1} | {} | {} |",
            self.epochs,
            self.phases as f64 / self.epochs.max(1) as f64,
            self.fixed,
            self.wrong,
            self.of_parts,
            rms(self.horizontal),
            rms(self.vertical),
            self.withdrawn,
            refused.join(", "),
        )
    }
}

fn reason(why: &RtkRefusal) -> &'static str {
    match why {
        RtkRefusal::Ratio { .. } => "others as near",
        RtkRefusal::Residuals { .. } => "residuals",
        RtkRefusal::TooFewPhases { .. } => "few phases",
        RtkRefusal::Prior { .. } => "prior",
        _ => "no differences",
    }
}
