//! Four antennas on a square of ten centimetres under a made-up sky, sound and broken.

#![allow(clippy::unwrap_used)]

mod array;
#[path = "../src/tests/random.rs"]
mod random;

use array::{Made, square};
use insd_base::satellites::{AntennaSignal, CompassFault, CompassRefusal, LineBias};
use insd_base::{Attitude, Ecef, SatelliteEpoch, earth};
use insd_gnss::{
    AttitudePrior, CompassArray, CompassEpoch, CompassFix, CompassObjection, CompassPose,
    CompassPrior, CompassSettings, CompassTracker,
};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

const HULL: Attitude = Attitude { roll: 0.05, pitch: -0.03, heading: 2.0 };

fn on_one_clock() -> CompassTracker {
    let settings = CompassSettings { phase: 1.5e-3, ..CompassSettings::default() };
    CompassTracker::new(CompassArray::on_one_clock(square()), settings)
}

fn made(seed: u64, satellites: usize) -> Made {
    let mut made = Made::new(seed, square());
    made.heard.truncate(satellites);
    made
}

/// What is known: the level to a degree and, with a sigma, the heading.
fn prior(made: &Made, heading_std: f64) -> CompassPrior {
    let level = 1_f64.to_radians();
    let std = Vector3::new(level, level, heading_std);
    let attitude = Some(AttitudePrior { c_nb: HULL.c_nb(), std });
    CompassPrior { antenna: Some(made.place), attitude, ..CompassPrior::default() }
}

fn take(
    compass: &mut CompassTracker,
    made: &Made,
    epochs: &[SatelliteEpoch],
    prior: &CompassPrior,
) -> CompassEpoch {
    let epochs: Vec<_> = epochs.iter().map(Some).collect();
    compass.take(&made.context, &epochs, prior)
}

/// Sails so many seconds with nothing known of the heading; the last epoch.
fn sail(compass: &mut CompassTracker, made: &mut Made, seconds: u32) -> CompassEpoch {
    let mut last = None;
    for second in 0..seconds {
        let epochs = made.epochs(f64::from(second), &HULL.c_nb());
        last = Some(take(compass, made, &epochs, &prior(made, f64::INFINITY)));
    }
    last.unwrap()
}

fn is_right(fix: &CompassFix) -> bool {
    let (found, covariance) = fix.attitude().unwrap();
    let off = [found.roll - HULL.roll, found.pitch - HULL.pitch, found.heading - HULL.heading];
    (0..3).all(|axis| off[axis].abs() < 5.0 * covariance[(axis, axis)].sqrt() && off[axis] < 0.3)
}

#[test]
fn a_cold_start_under_fifteen_satellites_is_right_and_at_once() {
    for seed in 0..10 {
        let mut made = made(seed, 15);
        let told = sail(&mut on_one_clock(), &mut made, 1).told;
        let fix = told.unwrap();
        assert!(is_right(&fix), "{seed}: {:?}", fix.attitude());
        assert!(fix.doubt < 1e-4 && fix.satellites == 15);
    }
}

#[test]
fn a_cold_start_under_two_satellites_is_unknown_and_with_known_lines_they_are_enough() {
    let mut made = made(3, 12);
    let mut compass = on_one_clock();
    assert!(is_right(&sail(&mut compass, &mut made, 60).told.unwrap()));
    let lines = compass.lines().clone();
    assert!(lines.iter().all(|(_, _, sigma)| sigma < 0.003));

    made.heard.truncate(2);
    let epochs = made.epochs(60.0, &HULL.c_nb());
    let known = prior(&made, 0.1);
    let cold = take(&mut on_one_clock(), &made, &epochs, &prior(&made, f64::INFINITY));
    assert!(matches!(cold.told, Err(CompassRefusal::Ambiguous { .. })), "{:?}", cold.told);
    let warm = take(&mut compass, &made, &epochs, &known).told.unwrap();
    assert!(is_right(&warm), "{:?}", warm.attitude());
}

#[test]
fn signals_solved_by_themselves_come_to_what_is_told() {
    let mut made = made(5, 15);
    let epochs = made.epochs(0.0, &HULL.c_nb());
    let fix = take(&mut on_one_clock(), &made, &epochs, &prior(&made, f64::INFINITY)).told.unwrap();
    assert_come_to(&made, &fix);
}

/// Attitude and its covariance by signals about what is told, their lines free, are what is told.
fn assert_come_to(made: &Made, fix: &CompassFix) {
    let CompassPose::Attitude(c_nb) = fix.pose else { unreachable!() };
    let c_ne = earth::c_ne(&earth::geodetic(&Ecef(made.place)));
    let (off, covariance) = solved(&fix.signals, &(c_ne.transpose() * c_nb));
    assert!(off.norm() < 1e-4, "{off}");
    assert_alike(&fix.covariance, &(c_ne * covariance * c_ne.transpose()));
}

fn assert_alike(one: &Matrix3<f64>, other: &Matrix3<f64>) {
    for axis in 0..3 {
        let ratio = (one[(axis, axis)] / other[(axis, axis)]).sqrt();
        assert!((ratio - 1.0).abs() < 0.002, "{ratio}");
    }
}

/// Small rotation of an attitude, from body to ECEF axes, and its covariance by signals alone. What antennas share is free in each signal, and so is each line.
fn solved(signals: &[AntennaSignal], c_eb: &Matrix3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
    let phases = signals.iter().flat_map(|signal| &signal.phases);
    let mut lines: Vec<LineBias> = phases.filter_map(|phase| phase.line).collect();
    lines.sort();
    lines.dedup();
    let count = 3 + lines.len() + signals.len();
    let (mut normal, mut right) = (DMatrix::zeros(count, count), DVector::zeros(count));
    for (place, signal) in signals.iter().enumerate() {
        for phase in &signal.phases {
            let arm = c_eb * phase.lever;
            let mut row = DVector::zeros(count);
            row.fixed_rows_mut::<3>(0).copy_from(&arm.cross(&signal.gradient));
            if let Some(line) = lines.iter().position(|own| Some(*own) == phase.line) {
                row[3 + line] = 1.0;
            }
            row[3 + lines.len() + place] = 1.0;
            let beyond = phase.phase - signal.gradient.dot(&arm);
            normal.ger(1.0 / phase.variance, &row, &row, 1.0);
            right.axpy(beyond / phase.variance, &row, 1.0);
        }
    }
    let covariance = normal.try_inverse().unwrap();
    let found = &covariance * right;
    (found.fixed_rows::<3>(0).into_owned(), covariance.fixed_view::<3, 3>(0, 0).into_owned())
}

#[test]
fn receivers_on_clocks_of_their_own_tell_what_double_differences_do() {
    let mut made = made(6, 60);
    let gps = insd_base::Constellation::Gps;
    made.heard.retain(|satellite| satellite.constellation == gps);
    made.heard.truncate(9);
    made.clocks = vec![(10.0, 2.0), (-4e4, -30.0), (7e4, 11.0), (300.0, 0.2)];
    let settings = CompassSettings { phase: 1.5e-3, ..CompassSettings::default() };
    let mut compass = CompassTracker::new(CompassArray::on_own_clocks(square()), settings);
    sail(&mut compass, &mut made, 20);
    let epochs = made.epochs(20.0, &HULL.c_nb());
    let fix = take(&mut compass, &made, &epochs, &prior(&made, f64::INFINITY)).told.unwrap();
    assert!(is_right(&fix));
    // a column that is free for each antenna is what double differences are
    assert_come_to(&made, &fix);
}

#[test]
fn integers_by_rounding_are_the_same_from_twenty_degrees_off() {
    let mut made = made(7, 10);
    let mut compass = on_one_clock();
    sail(&mut compass, &mut made, 60);
    let epochs = made.epochs(60.0, &HULL.c_nb());
    let settings = CompassSettings { phase: 1.5e-3, ..CompassSettings::default() };
    let from = |heading: f64| {
        let array = CompassArray::on_one_clock(square());
        let mut anew = CompassTracker::with_lines(array, settings, compass.lines().clone());
        let mut known = prior(&made, 0.001);
        let c_nb = Attitude { heading: HULL.heading + heading, ..HULL }.c_nb();
        known.attitude = known.attitude.map(|own| AttitudePrior { c_nb, ..own });
        take(&mut anew, &made, &epochs, &known).told.unwrap()
    };
    let (near, far) = (from(0.0), from(0.3));
    assert_eq!(near.integers, far.integers);
    assert!(near.success > 0.999, "{}", near.success);
    assert!(is_right(&near) && is_right(&far));
}

#[test]
fn a_reflection_at_one_antenna_is_left_out_and_named() {
    let mut made = made(8, 12);
    let mut compass = on_one_clock();
    sail(&mut compass, &mut made, 30);
    let satellite = made.heard[4];
    made.reflected.insert((2, satellite), 0.04);
    let epochs = made.epochs(30.0, &HULL.c_nb());
    let epoch = take(&mut compass, &made, &epochs, &prior(&made, f64::INFINITY));
    assert!(is_right(epoch.told.as_ref().unwrap()));
    let [rejection] = epoch.rejected[..] else { panic!("{:?}", epoch.rejected) };
    assert_eq!((rejection.satellite, rejection.antenna), (satellite, Some(2)));
    assert!(matches!(rejection.why, CompassObjection::Contradicts { .. }));
}

#[test]
fn a_receiver_on_its_own_clock_is_named_and_the_attitude_goes_on() {
    for antenna in 0..4 {
        let mut made = made(9, 12);
        made.clocks[antenna] = (-40.0, 8.0);
        let epoch = sail(&mut on_one_clock(), &mut made, 12);
        let [CompassFault::OwnClock { antenna: named, rate }] = epoch.faults[..] else {
            panic!("{:?}", epoch.faults)
        };
        assert_eq!(named, antenna);
        assert!((rate - 7.7).abs() < 0.5, "{rate}");
        assert!(is_right(&epoch.told.unwrap()));
    }
}

#[test]
fn a_broken_cable_is_named_and_the_attitude_goes_on() {
    let mut made = made(10, 12);
    let mut compass = on_one_clock();
    for second in 0..10 {
        let epochs = made.epochs(f64::from(second), &HULL.c_nb());
        let mut heard: Vec<_> = epochs.iter().map(Some).collect();
        heard[1] = None;
        let epoch = compass.take(&made.context, &heard, &prior(&made, f64::INFINITY));
        if second > 5 {
            assert_eq!(epoch.faults, [CompassFault::Broken { antenna: 1 }]);
            assert!(is_right(&epoch.told.unwrap()));
        }
    }
}

#[test]
fn antennas_in_each_others_place_are_named_and_no_attitude_is_told() {
    for (one, other) in [(0, 1), (2, 3)] {
        let mut made = made(11, 12);
        let mut compass = on_one_clock();
        for second in 0..10 {
            let mut epochs = made.epochs(f64::from(second), &HULL.c_nb());
            epochs.swap(one, other);
            let epoch = take(&mut compass, &made, &epochs, &prior(&made, f64::INFINITY));
            assert!(epoch.told.is_err());
            if second > 7 {
                assert_eq!(epoch.faults, [CompassFault::Swapped { one, other }]);
            }
        }
    }
}

#[test]
fn an_array_that_is_none_and_an_epoch_of_nobody_are_refused_with_a_reason() {
    let made = made(12, 12);
    let alone = CompassArray::on_one_clock(vec![Vector3::zeros()]);
    let mut compass = CompassTracker::new(alone, CompassSettings::default());
    let told = compass.take(&made.context, &[None], &CompassPrior::default()).told;
    assert_eq!(told.unwrap_err(), CompassRefusal::Array);
    let told = on_one_clock().take(&made.context, &[None; 4], &CompassPrior::default()).told;
    assert_eq!(told.unwrap_err(), CompassRefusal::NoPlace);
}
