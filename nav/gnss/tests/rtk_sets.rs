//! Rovers against bases of real receivers, where `INSD_RAW_GNSS` names their folder: what docs/rtk.md claims.

#![allow(clippy::unwrap_used)]

mod sets;

use insd_gnss::{PlacedEpoch, RtkSettings, RtkTracker};
use nalgebra::Vector3;
use sets::{GEONET, MOVING, NEAR, Pair, WETTZELL, horizontal};

fn single() -> RtkTracker {
    RtkTracker::single_epoch(RtkSettings::default())
}

fn continuous() -> RtkTracker {
    RtkTracker::continuous(RtkSettings::default())
}

/// Fixed epochs, those of them that are wrong, and the horizontal RMS of the others, m.
fn judged(pair: &Pair, mut tracker: RtkTracker) -> Option<(usize, usize, f64)> {
    let folder = sets::folder()?;
    let context = pair.context(&folder);
    let (mut fixed, mut wrong, mut squares) = (0, 0, 0.0);
    for moment in pair.moments(&folder) {
        let base = PlacedEpoch { epoch: &moment.base, position: Vector3::from(pair.base_at) };
        let Ok(told) = tracker.take(&context, &moment.rover, &base, None) else { continue };
        let Ok(fix) = &told.fixed else { continue };
        let off = fix.position - moment.truth.unwrap();
        fixed += 1;
        if off.norm() > 0.1 {
            wrong += 1;
        } else {
            squares += horizontal(&fix.position, &off).powi(2);
        }
    }
    Some((fixed, wrong, (squares / (fixed - wrong).max(1) as f64).sqrt()))
}

#[test]
fn a_car_at_five_kilometres_is_fixed_in_every_epoch_on_two_frequencies() {
    for tracker in [single(), continuous()] {
        let Some((fixed, wrong, rms)) = judged(&MOVING, tracker) else { return };
        assert_eq!((fixed, wrong), (360, 0));
        assert!(rms < 0.0025, "{rms} m");
    }
}

#[test]
fn a_station_at_three_kilometres_is_fixed_in_every_epoch_on_two_frequencies() {
    for tracker in [single(), continuous()] {
        let Some((fixed, wrong, rms)) = judged(&GEONET, tracker) else { return };
        assert_eq!((fixed, wrong), (120, 0));
        assert!(rms < 0.006, "{rms} m");
    }
}

#[test]
fn an_antenna_at_one_metre_is_fixed_in_every_epoch_on_one_frequency() {
    for tracker in [single(), continuous()] {
        let Some((fixed, wrong, rms)) = judged(&NEAR, tracker) else { return };
        assert_eq!((fixed, wrong), (301, 0));
        assert!(rms < 0.002, "{rms} m");
    }
}

#[test]
fn six_satellites_on_one_frequency_are_fixed_where_they_are_sure_and_never_wrongly() {
    for (tracker, least) in [(single(), 12), (continuous(), 110)] {
        let Some((fixed, wrong, _)) = judged(&WETTZELL, tracker) else { return };
        assert_eq!(wrong, 0);
        assert!(fixed >= least, "{fixed}");
    }
}

#[test]
fn one_frequency_is_enough_where_ambiguities_are_carried_on() {
    let on_first = |pair: Pair| Pair { bands: &[1], ..pair };
    for (pair, least) in [(on_first(MOVING), 355), (on_first(GEONET), 114)] {
        let Some((fixed, wrong, _)) = judged(&pair, continuous()) else { return };
        assert_eq!(wrong, 0, "{}", pair.label);
        assert!(fixed >= least, "{}: {fixed}", pair.label);
    }
}
