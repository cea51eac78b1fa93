//! Rovers against bases of real receivers: the table of docs/rtk.md.
//!
//! ```text
//! INSD_RAW_GNSS=... cargo run --release -p insd-gnss --example rtk
//! ```

#![allow(clippy::unwrap_used)] // a file that is missing ends it

#[path = "../../tests/sets/mod.rs"]
mod sets;

use std::collections::BTreeMap;
use std::path::Path;

use insd_gnss::{BaseEpoch, RtkRefusal, RtkSettings, RtkTracker};
use nalgebra::Vector3;
use sets::{PAIRS, Pair, horizontal, vertical};

const HEAD: &str = "| set, constellations, bands | epochs | fixed | wrong | of parts | horizontal RMS, mm | vertical | withdrawn | not fixed because |\n\
    |---|---|---|---|---|---|---|---|---|";

fn main() {
    let Some(folder) = sets::folder() else { return };
    println!("{HEAD}");
    for pair in &PAIRS {
        let single = RtkTracker::single_epoch(RtkSettings::default());
        println!("{}", Judged::of(pair, &folder, single).row(pair, "single"));
        let continuous = RtkTracker::continuous(RtkSettings::default());
        println!("{}", Judged::of(pair, &folder, continuous).row(pair, "continuous"));
    }
}

/// What was found of a set.
#[derive(Default)]
struct Judged {
    epochs: usize,
    fixed: usize,
    wrong: usize,
    of_parts: usize,
    withdrawn: usize,
    horizontal: f64,
    vertical: f64,
    refused: BTreeMap<&'static str, usize>,
}

impl Judged {
    fn of(pair: &Pair, folder: &Path, mut tracker: RtkTracker) -> Self {
        let context = pair.context(folder);
        let mut judged = Self::default();
        for moment in pair.moments(folder) {
            judged.epochs += 1;
            let base = BaseEpoch { epoch: &moment.base, position: Vector3::from(pair.base_at) };
            let told = tracker.take(&context, &moment.rover, &base, None);
            let fix = match told.and_then(|told| told.fixed) {
                Ok(fix) => fix,
                Err(why) => {
                    *judged.refused.entry(reason(&why)).or_default() += 1;
                    continue;
                }
            };
            let off = fix.position - moment.truth.unwrap();
            judged.fixed += 1;
            judged.of_parts += usize::from(fix.attempts > 1);
            if off.norm() > 0.1 {
                judged.wrong += 1;
            } else {
                judged.horizontal += horizontal(&fix.position, &off).powi(2);
                judged.vertical += vertical(&fix.position, &off).powi(2);
            }
        }
        judged.withdrawn = tracker.withdrawals();
        judged
    }

    fn row(&self, pair: &Pair, epochs: &str) -> String {
        let right = (self.fixed - self.wrong).max(1) as f64;
        let rms = |squares: f64| (squares / right).sqrt() * 1e3;
        let refused: Vec<_> =
            self.refused.iter().map(|(why, count)| format!("{why} {count}")).collect();
        format!(
            "| {}, {epochs} | {} | {} | {} | {} | {:.1} | {:.1} | {} | {} |",
            pair.label,
            self.epochs,
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
