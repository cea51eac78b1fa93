//! Pairs of real receivers as a compass, where `INSD_RAW_GNSS` names their folder: what docs/compass.md claims.

#![allow(clippy::unwrap_used)]

mod sets;

use insd_gnss::{CompassArray, CompassPrior, CompassSettings, CompassShape, CompassTracker};
use nalgebra::Vector3;
use sets::{NEAR, Pair, WETTZELL};

/// Yaw, pitch and length of each epoch that is told; `None` without the sets.
fn found(pair: &Pair, clocks: [usize; 2], length: Option<(f64, f64)>) -> Option<Vec<[f64; 3]>> {
    let folder = sets::folder()?;
    let (context, moments) = (pair.context(&folder), pair.moments(&folder));
    let shape = CompassShape::Baseline { length };
    let array = CompassArray { shape, clocks: clocks.to_vec() };
    let settings = CompassSettings { turning: 1e-4, ..CompassSettings::default() };
    let mut compass = CompassTracker::new(array, settings);
    let antenna = Some(Vector3::from(pair.base_at));
    let prior = CompassPrior { antenna, ..CompassPrior::default() };
    let told = moments.iter().filter_map(|moment| {
        let epochs = [Some(&moment.base), Some(&moment.rover)];
        Some(compass.take(&context, &epochs, &prior).told.ok()?.baseline()?.0)
    });
    Some(told.collect())
}

fn std(all: &[[f64; 3]], place: usize) -> f64 {
    let count = all.len() as f64;
    let mean = all.iter().map(|own| own[place]).sum::<f64>() / count;
    (all.iter().map(|own| (own[place] - mean).powi(2)).sum::<f64>() / (count - 1.0)).sqrt()
}

#[test]
fn two_makes_on_one_maser_tell_their_pitch_better_than_double_differences_do() {
    let pair = Pair { constellations: "GE", bands: &[1, 2, 7], ..WETTZELL };
    let length = Some((1.594, 0.02));
    let Some(common) = found(&pair, [0, 0], length) else { return };
    let own = found(&pair, [0, 1], length).unwrap();
    assert_eq!((common.len(), own.len()), (120, 120));
    assert!(std(&common[20..], 1) < 0.074_f64.to_radians(), "{}", std(&common[20..], 1));
    assert!(std(&common, 0) < 0.066_f64.to_radians());
    assert!(std(&own, 1) > 1.2 * std(&common[20..], 1));
}

#[test]
fn antennas_a_metre_apart_with_own_clocks_are_told_in_every_epoch_with_and_without_their_length() {
    let pair = Pair { bands: &[], ..NEAR };
    for length in [Some((0.99, 0.02)), None] {
        let Some(all) = found(&pair, [0, 1], length) else { return };
        assert_eq!(all.len(), 301);
        assert!(std(&all, 0) < 0.041_f64.to_radians());
        assert!(std(&all, 1) < 0.082_f64.to_radians());
        assert!(all.iter().all(|own| (own[2] - 0.9902).abs() < 0.003));
    }
}
