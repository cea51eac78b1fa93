//! Real pairs of receivers: repeatability of yaw, pitch and length.

use std::fmt::Write;

use insd_base::{Ecef, earth};
use insd_gnss::{
    CompassArray, CompassPose, CompassPrior, CompassSettings, CompassShape, CompassTracker,
    Context, LineBiases,
};
use nalgebra::Vector3;

use crate::sets::{self, Moment, NEAR, Pair, WETTZELL};

const HEAD: &str = "| set, constellations, bands | clocks | epochs | told | wrong | yaw std, deg | pitch | length std, mm | length RMS about the known, mm |\n\
    |---|---|---|---|---|---|---|---|---|\n";

/// Each with the clocks of its receivers and what is known of the length beforehand, m.
fn runs() -> Vec<(Pair, [usize; 2], f64)> {
    let common = |label, constellations, bands| Pair { label, constellations, bands, ..WETTZELL };
    let near = |label, constellations, bands| Pair { label, constellations, bands, ..NEAR };
    let mut runs = Vec::new();
    for pair in [
        common("common-clock-1p6m, G, L1", "G", &[1]),
        common("common-clock-1p6m, GE, L1", "GE", &[1]),
        common("common-clock-1p6m, GE, L1 and L2", "GE", &[1, 2, 7]),
        common("common-clock-1p6m, GE, all", "GE", &[]),
        common("common-clock-1p6m, GEC, all", "GEC", &[]),
    ] {
        runs.push((pair, [0, 0], 1.594));
        runs.push((pair, [0, 1], 1.594));
    }
    for pair in [
        near("pair-1m, GEJ, L1", "GEJ", &[1]),
        near("pair-1m, GECJ, L1", "GECJ", &[1]),
        near("pair-1m, GECJ, all", "GECJ", &[]),
    ] {
        runs.push((pair, [0, 1], 0.990));
    }
    runs
}

pub(crate) fn table() -> String {
    let mut table = String::from(HEAD);
    let Some(folder) = sets::folder() else { return table };
    for (pair, clocks, length) in runs() {
        let (context, moments) = (pair.context(&folder), pair.moments(&folder));
        let set = Set { context, moments, pair, clocks, length };
        let (first, lines) = set.judged(LineBiases::default());
        set.row(&mut table, if clocks == [0, 0] { "one, lines unknown" } else { "own" }, &first);
        if clocks == [0, 0] {
            let (second, _) = set.judged(lines);
            set.row(&mut table, "one, lines known", &second);
        }
    }
    table
}

struct Set {
    context: Context,
    moments: Vec<Moment>,
    pair: Pair,
    clocks: [usize; 2],
    length: f64,
}

/// What was found: yaw, pitch, length of each epoch that is told.
#[derive(Default)]
struct Judged {
    found: Vec<[f64; 3]>,
    wrong: usize,
}

impl Set {
    fn judged(&self, lines: LineBiases) -> (Judged, LineBiases) {
        let shape = CompassShape::Baseline { length: Some((self.length, 0.02)) };
        let array = CompassArray { shape, clocks: self.clocks.to_vec() };
        let settings = CompassSettings {
            lowest: 15_f64.to_radians(),
            turning: 1e-4,
            // stations in rooms
            line_walk: 1e-5,
            ..CompassSettings::default()
        };
        let mut tracker = CompassTracker::with_lines(array, settings, lines);
        let (base, rover) =
            (Vector3::from(self.pair.base_at), Vector3::from(self.pair.rover_at.unwrap()));
        let c_ne = earth::c_ne(&earth::geodetic(&Ecef(base)));
        let known = c_ne * (rover - base);
        let mut judged = Judged::default();
        for moment in &self.moments {
            let prior = CompassPrior { antenna: Some(base), ..CompassPrior::default() };
            let epochs = [Some(&moment.base), Some(&moment.rover)];
            let Ok(fix) = tracker.take(&self.context, &epochs, &prior).told else { continue };
            let Some((found, _)) = fix.baseline() else { continue };
            judged.found.push(found);
            let CompassPose::Baseline(vector) = fix.pose else { continue };
            judged.wrong += usize::from((vector - known).norm() > 0.04);
        }
        (judged, tracker.lines().clone())
    }

    fn row(&self, table: &mut String, clocks: &str, judged: &Judged) {
        let ends = [Vector3::from(self.pair.base_at), Vector3::from(self.pair.rover_at.unwrap())];
        let known = (ends[1] - ends[0]).norm();
        let column = |place: usize| judged.found.iter().map(move |own| own[place]);
        let count = judged.found.len().max(1) as f64;
        let std = |place: usize| {
            let mean = column(place).sum::<f64>() / count;
            (column(place).map(|x| (x - mean).powi(2)).sum::<f64>() / (count - 1.0)).sqrt()
        };
        let rms = (column(2).map(|x| (x - known).powi(2)).sum::<f64>() / count).sqrt();
        let _ = writeln!(
            table,
            "| {} | {clocks} | {} | {} | {} | {:.4} | {:.4} | {:.2} | {:.2} |",
            self.pair.label,
            self.moments.len(),
            judged.found.len(),
            judged.wrong,
            std(0).to_degrees(),
            std(1).to_degrees(),
            std(2) * 1e3,
            rms * 1e3,
        );
    }
}
