//! Rovers against bases of real sets: one table.
#![allow(clippy::unwrap_used)]

#[path = "../../tests/sets/mod.rs"]
mod sets;

use insd_base::{Ecef, earth};
use insd_gnss::{BaseEpoch, RtkSettings, RtkSolution};
use nalgebra::Vector3;

fn main() {
    let folder = sets::folder().unwrap();
    let settings = RtkSettings::default();
    let verbose = std::env::args().nth(1);
    for pair in &sets::PAIRS {
        let context = pair.context(&folder);
        let (mut fixed, mut wrong, mut n, mut h2, mut v2, mut doubts, mut floats) =
            (0, 0, 0, 0.0, 0.0, 0.0, 0.0);
        let mut attempts = [0; 12];
        let mut reasons = std::collections::BTreeMap::<String, usize>::new();
        for moment in pair.moments(&folder) {
            n += 1;
            let base = BaseEpoch { epoch: &moment.base, position: Vector3::from(pair.base_at) };
            let told = RtkSolution::single_epoch(&context, &settings, &moment.rover, &base, None);
            let truth = moment.truth.unwrap();
            let told = match told {
                Ok(told) => told,
                Err(why) => {
                    *reasons.entry(format!("{why}")).or_default() += 1;
                    continue;
                }
            };
            let off = enu(&truth, &(told.position() - truth));
            floats += enu(&truth, &(told.float - truth)).xy().norm_squared();
            match &told.fixed {
                Ok(fix) => {
                    fixed += 1;
                    attempts[fix.attempts] += 1;
                    doubts += fix.doubt;
                    if off.norm() > 0.1 {
                        wrong += 1
                    } else {
                        h2 += off.xy().norm_squared();
                        v2 += off.z * off.z;
                    }
                    if verbose.as_deref().is_some_and(|v| pair.label.contains(v)) {
                        println!(
                            "{:?} off {:.3} {:.3} {:.3} ratio {:.2} success {:.4} doubt {:.1e} level {:.2} n {} of {} att {}",
                            told.tag,
                            off.x,
                            off.y,
                            off.z,
                            fix.ratio,
                            fix.success,
                            fix.doubt,
                            fix.level,
                            fix.integers.len(),
                            told.phases,
                            fix.attempts
                        );
                    }
                }
                Err(why) => {
                    let text = format!("{why:?}");
                    if verbose.as_deref().is_some_and(|v| pair.label.contains(v)) {
                        println!("{:?} {why} of {}", told.tag, told.phases);
                    }
                    *reasons.entry(text.split(' ').next().unwrap().to_owned()).or_default() += 1;
                }
            }
        }
        let good = f64::from(fixed - wrong).max(1.0);
        println!(
            "{}: {n} epochs, {fixed} fixed, {wrong} wrong, H {:.2} mm V {:.2} mm, doubt {:.1e}, float H {:.2} m, attempts {:?} {reasons:?}",
            pair.label,
            (h2 / good).sqrt() * 1e3,
            (v2 / good).sqrt() * 1e3,
            doubts,
            (floats / n as f64).sqrt(),
            attempts
        );
    }
}

fn enu(at: &Vector3<f64>, off: &Vector3<f64>) -> Vector3<f64> {
    let ned = earth::c_ne(&earth::geodetic(&Ecef(*at))) * off;
    Vector3::new(ned.y, ned.x, -ned.z)
}
