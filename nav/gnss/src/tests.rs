mod phases;
mod random;
mod rtk;
mod sky;

use std::collections::BTreeMap;

use insd_base::satellites::{HeardSatellite, RangeRefusal};
use insd_base::{SatelliteEpoch, SatelliteId, Span};
use nalgebra::Vector3;

use crate::carrier::{CarrierDisplacement, CarrierTracker};
use crate::ephemerides::{Ephemerides, OrbitRefusal};
use crate::ranging::{Guess, Ranging};
use crate::single_point::{NoPosition, SinglePoint, Verdict};
use crate::velocity::DopplerVelocity;
use sky::{CLOCK, berth, context, epoch};

fn still() -> Vector3<f64> {
    Vector3::zeros()
}

/// Adds to the codes of a satellite, m.
fn lie(epoch: &mut SatelliteEpoch, satellite: &str, error: f64) {
    let satellite = satellite.parse().unwrap();
    for signal in epoch.signals.iter_mut().filter(|signal| signal.satellite == satellite) {
        signal.code = signal.code.map(|code| code + error);
    }
}

fn verdict(point: &SinglePoint, satellite: &str) -> Verdict {
    let satellite = satellite.parse().unwrap();
    point.satellites.iter().find(|witness| witness.satellite == satellite).unwrap().verdict
}

fn names(epoch: &SatelliteEpoch) -> Vec<String> {
    let mut names: Vec<_> = epoch.signals.iter().map(|s| s.satellite.to_string()).collect();
    names.dedup();
    names
}

#[test]
fn a_position_is_found_from_nothing_and_from_the_other_side_of_the_earth() {
    let context = context();
    let epoch = epoch(&context, 0.0, &berth(), &still());
    for near in [None, Some(-berth()), Some(berth() * 2.0)] {
        let point = SinglePoint::solve(&context, &epoch, near).unwrap();
        assert!((point.position - berth()).norm() < 0.01, "{}", (point.position - berth()).norm());
        let clock = point.clocks[0].1 / insd_base::satellites::SPEED_OF_LIGHT;
        assert!((clock - CLOCK).abs() < 1e-10, "{clock}");
    }
}

#[test]
fn one_satellite_that_is_twenty_metres_off_is_named_and_left_out() {
    let context = context();
    let honest = epoch(&context, 0.0, &berth(), &still());
    for name in names(&honest) {
        let mut lying = honest.clone();
        lie(&mut lying, &name, 20.0);
        let point = SinglePoint::solve(&context, &lying, None).unwrap();
        assert_eq!(verdict(&point, &name), Verdict::Faulty, "{name}");
        assert!((point.position - berth()).norm() < 0.1, "{name}");
        assert_eq!(point.used().count(), names(&honest).len() - 1);
    }
}

#[test]
fn two_liars_of_different_sizes_are_both_named() {
    let context = context();
    let mut lying = epoch(&context, 0.0, &berth(), &still());
    let names = names(&lying);
    lie(&mut lying, &names[1], 3_000.0);
    lie(&mut lying, &names[6], -40.0);
    let point = SinglePoint::solve(&context, &lying, None).unwrap();
    assert_eq!(verdict(&point, &names[1]), Verdict::Faulty);
    assert_eq!(verdict(&point, &names[6]), Verdict::Faulty);
    assert!((point.position - berth()).norm() < 0.1);
}

#[test]
fn three_satellites_are_too_few_and_four_of_one_constellation_are_enough() {
    let context = context();
    let mut all = epoch(&context, 0.0, &berth(), &still());
    let gps: Vec<_> = names(&all).into_iter().filter(|name| name.starts_with('G')).collect();
    let first = |epoch: &SatelliteEpoch, count: usize| {
        let kept = &gps[..count];
        let mut epoch = epoch.clone();
        epoch.signals.retain(|signal| kept.contains(&signal.satellite.to_string()));
        epoch
    };
    let few = SinglePoint::solve(&context, &first(&all, 3), None);
    assert_eq!(few.unwrap_err(), NoPosition::TooFew { satellites: 3 });
    all = first(&all, 5);
    assert!(SinglePoint::solve(&context, &all, None).is_ok());
}

#[test]
fn a_satellite_without_a_fresh_orbit_is_refused_with_the_reason() {
    let context = context();
    let epoch = epoch(&context, 5.0 * 3600.0, &berth(), &still());
    let gps = epoch.signals.iter().find(|signal| signal.satellite.to_string().starts_with('G'));
    let point = SinglePoint::solve(&context, &epoch, None);
    // Galileo's records hold for four hours, GPS' for two: nothing is left
    assert_eq!(point.unwrap_err(), NoPosition::TooFew { satellites: 0 });
    let refusal = context.ephemerides.select(gps.unwrap().satellite, epoch.tag).unwrap_err();
    assert!(matches!(refusal, OrbitRefusal::Stale { .. }), "{refusal}");
}

#[test]
fn the_doppler_shifts_tell_the_velocity_and_the_one_that_lies() {
    let context = context();
    let velocity = Vector3::new(3.0, -2.0, 1.5);
    let mut epoch = epoch(&context, 0.0, &berth(), &velocity);
    let found =
        DopplerVelocity::solve(&context, &epoch, &(berth() + Vector3::repeat(10.0))).unwrap();
    assert!((found.velocity - velocity).norm() < 0.02, "{}", found.velocity);
    assert!(found.faulty.is_empty());

    let liar = epoch.signals[4].satellite;
    for signal in epoch.signals.iter_mut().filter(|signal| signal.satellite == liar) {
        signal.doppler = signal.doppler.map(|shift| shift + 20.0);
    }
    let found = DopplerVelocity::solve(&context, &epoch, &berth()).unwrap();
    assert_eq!(found.faulty, [liar]);
    assert!((found.velocity - velocity).norm() < 0.02);
}

#[test]
fn phases_tell_a_displacement_to_a_millimetre_though_the_place_is_tens_of_metres_wrong() {
    let context = context();
    let moved = Vector3::new(4.0, 3.0, -2.0);
    let mut tracker = CarrierTracker::default();
    let wrong = berth() + Vector3::new(20.0, -10.0, 15.0);
    let first = epoch(&context, 0.0, &berth(), &still());
    let second = epoch(&context, 1.0, &(berth() + moved), &still());
    assert!(tracker.advance(&context, &first, &wrong, 0.0).is_empty());
    let changes = tracker.advance(&context, &second, &wrong, 0.0);
    let found = CarrierDisplacement::solve(&changes, &berth()).unwrap();
    assert!((found.displacement - moved).norm() < 2e-3, "{}", (found.displacement - moved).norm());
    assert!(found.slipped.is_empty());
}

#[test]
fn an_untold_slip_is_found_and_a_told_one_or_a_half_cycle_is_not_used() {
    let context = context();
    let mut tracker = CarrierTracker::default();
    tracker.advance(&context, &epoch(&context, 0.0, &berth(), &still()), &berth(), 0.0);
    let mut next = epoch(&context, 1.0, &berth(), &still());
    let (slipped, told, half) =
        (next.signals[2].satellite, next.signals[6].satellite, next.signals[10].satellite);
    for signal in &mut next.signals {
        if signal.satellite == slipped {
            signal.phase = signal.phase.map(|phase| phase + 2.0);
        }
        signal.slip = signal.satellite == told;
        signal.half_cycle = signal.satellite == half;
    }
    let changes = tracker.advance(&context, &next, &berth(), 0.0);
    assert!(!changes.iter().any(|change| [told, half].contains(&change.satellite)));
    let found = CarrierDisplacement::solve(&changes, &berth()).unwrap();
    assert_eq!(found.slipped, [slipped]);
    assert!(found.displacement.norm() < 1e-3, "{}", found.displacement.norm());
}

#[test]
fn epochs_that_repeat_or_go_back_or_lie_minutes_apart_give_no_difference() {
    let context = context();
    let mut tracker = CarrierTracker::default();
    let at = |after: f64| epoch(&context, after, &berth(), &still());
    for after in [10.0, 10.0, 9.0, 80.0] {
        assert!(tracker.advance(&context, &at(after), &berth(), 0.0).is_empty(), "{after}");
    }
    assert!(!tracker.advance(&context, &at(81.0), &berth(), 0.0).is_empty());
    let mut reset = at(82.0);
    reset.clock_reset = true;
    assert!(tracker.advance(&context, &reset, &berth(), 0.0).is_empty());
    assert_eq!(reset.tag.since(at(80.0).tag), Span::from_seconds(2.0));
}

#[test]
fn ranges_for_a_filter_are_those_of_the_geometry_and_phases_keep_their_constant() {
    let context = context();
    let mut ranging = Ranging::default();
    let light = insd_base::satellites::SPEED_OF_LIGHT;
    let mut constants: BTreeMap<SatelliteId, f64> = BTreeMap::new();
    for after in 0..5 {
        let moved = berth() + Vector3::new(3.0, 1.0, 0.0) * f64::from(after);
        let velocity = Vector3::new(3.0, 1.0, 0.0);
        let epoch = epoch(&context, f64::from(after), &moved, &velocity);
        let ranged = ranging.take(&context, &epoch, Guess::default());
        assert!((ranged.sampled.since(epoch.tag).as_seconds() + CLOCK).abs() < 1e-8);
        for range in &ranged.ranges {
            let expected = range.transmitter.range(&moved) + CLOCK * light;
            assert!((range.code.unwrap().value - expected).abs() < 0.02);
            let rate = range.transmitter.range_rate(&moved, &velocity);
            assert!((range.rate.unwrap().value - rate).abs() < 1e-3);
            let constant = range.phase.unwrap().phase.value - expected;
            let first = *constants.entry(range.satellite).or_insert(constant);
            assert!((constant - first).abs() < 2e-3, "{}: {constant} {first}", range.satellite);
        }
    }
    assert!(constants.len() > 10);
}

#[test]
fn of_each_satellite_that_is_heard_it_is_told_where_it_stands_or_why_it_has_no_range() {
    let mut context = context();
    let mut epoch = epoch(&context, 0.0, &berth(), &still());
    let all = names(&epoch);
    let [lying, codeless, unknown] = [&all[0], &all[1], &all[2]];
    lie(&mut epoch, lying, 40.0);
    for signal in &mut epoch.signals {
        signal.cn0 = Some(if signal.signal.band == 1 { 47.0 } else { 39.5 });
        if signal.satellite.to_string() == *codeless {
            signal.code = None;
        }
        if signal.satellite.to_string() == *unknown {
            signal.satellite.number = 60;
        }
    }
    let ranged = Ranging::default().take(&context, &epoch, Guess::default());
    assert_eq!(ranged.heard.len(), all.len());
    for heard in &ranged.heard {
        let name = heard.satellite.to_string();
        let has_range = ranged.ranges.iter().any(|range| range.satellite == heard.satellite);
        assert_eq!(has_range, heard.refused.is_none(), "{name}");
        assert_eq!(
            heard.signals.iter().map(|own| own.cn0).collect::<Vec<_>>(),
            [Some(47.0), Some(39.5)]
        );
        assert_eq!(heard.is_outlier, name == *lying, "{name}");
        let expected = match &name {
            name if name == codeless => Some(RangeRefusal::NoCode),
            name if name.ends_with("60") => Some(RangeRefusal::NoOrbit(OrbitRefusal::NoRecord)),
            _ => None,
        };
        assert_eq!(heard.refused, expected, "{name}");
        assert_eq!(heard.direction.is_none(), name.ends_with("60"), "{name}");
    }
    // nothing is known of any orbit: no place, and yet each is told
    context.ephemerides = Ephemerides::default();
    let ranged = Ranging::default().take(&context, &epoch, Guess::default());
    let refused = |heard: &HeardSatellite| heard.refused.map(RangeRefusal::as_str);
    let reasons: Vec<_> = ranged.heard.iter().filter_map(refused).collect();
    assert_eq!(reasons.iter().filter(|why| **why == "no_orbit").count(), all.len() - 1);
    assert!(ranged.ranges.is_empty() && reasons.contains(&"no_code"));
}
