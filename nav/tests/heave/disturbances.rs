//! What happens to the heave when something happens.

use insd_base::{Body, HeaveQuality, Time};
use insd_nav::heave::{HeaveFilter, VerticalStep};
use nalgebra::Vector3;

use crate::sea::{Move, Sea, System};
use crate::trial::{ABEAM, Errors, GRADES, Grade, Instant, Trial};

/// When it happens, s.
const AT: f64 = 900.0;

fn sea() -> Sea {
    Sea::new(&[System::new(3.25, 10.0)], 5)
}

fn trial(grade: Grade) -> Trial<'static> {
    Trial { grade, rate: 50.0, duration: 1500.0, seed: 5, points: &[ABEAM] }
}

/// Errors of the heave at the IMU in a time after it happened.
fn after(record: &[Instant], from: f64, to: f64) -> Errors {
    Errors::real_time(record, 0, AT + from, AT + to)
}

fn delayed_after(record: &[Instant], from: f64, to: f64) -> Errors {
    Errors::delayed(record, 0, AT + from, AT + to)
}

#[test]
fn a_step_of_the_accelerometers_error_goes_in_half_a_minute_and_is_told() {
    for grade in GRADES {
        let sea = sea();
        let record = trial(grade).run(
            |t| sea.at(t),
            |t, step, _| {
                step.velocity += if t > AT { 0.01 * step.duration } else { 0.0 };
                true
            },
        );
        assert!(after(&record, 0.0, 30.0).worst < 1.0, "{}", grade.name);
        assert!(after(&record, 30.0, 200.0).rms < 0.12, "{:?}", after(&record, 30.0, 200.0));
        assert!(after(&record, 200.0, 600.0).rms < 0.05, "{:?}", after(&record, 200.0, 600.0));
        assert!(after(&record, 20.0, 120.0).covered > 0.9, "{:?}", after(&record, 20.0, 120.0));
        assert!(after(&record, 20.0, 50.0).settled < 0.1, "{:?}", after(&record, 20.0, 50.0));
        let delayed = delayed_after(&record, -40.0, 40.0);
        assert!(delayed.rms < 0.08 && delayed.settled < 0.3, "{} {delayed:?}", grade.name);
    }
}

#[test]
fn a_bump_goes_in_half_a_minute_and_is_told() {
    let sea = sea();
    let record = trial(GRADES[1]).run(
        |t| sea.at(t),
        |t, step, _| {
            step.velocity += if (t - AT).abs() < 0.4 * step.duration { 0.1 } else { 0.0 };
            true
        },
    );
    assert!(after(&record, 45.0, 200.0).rms < 0.12, "{:?}", after(&record, 45.0, 200.0));
    assert!(after(&record, 15.0, 45.0).settled < 0.1, "{:?}", after(&record, 15.0, 45.0));
    assert!(after(&record, 200.0, 600.0).rms < 0.05, "{:?}", after(&record, 200.0, 600.0));
}

/// A sea whose waves give way to others within a minute, as when the ship turns.
fn changing(before: &Sea, behind: &Sea, t: f64) -> Move {
    const LENGTH: f64 = 60.0;
    let x = ((t - AT) / LENGTH).clamp(0.0, 1.0);
    let (share, slope) = (x * x * (3.0 - 2.0 * x), 6.0 * x * (1.0 - x) / LENGTH);
    let (a, b) = (before.at(t), behind.at(t));
    let blend = |a: f64, b: f64| a + share * (b - a);
    Move {
        heave: blend(a.heave, b.heave),
        rate: blend(a.rate, b.rate) + slope * (b.heave - a.heave),
        roll: blend(a.roll, b.roll),
        pitch: blend(a.pitch, b.pitch),
    }
}

#[test]
fn a_sea_that_changes_is_learnt_in_two_minutes() {
    let short = Sea::new(&[System::new(3.25, 8.0)], 7);
    let long = Sea::new(&[System::new(3.25, 18.0)], 6);
    for grade in GRADES {
        for (before, behind) in [(&short, &long), (&long, &short)] {
            let record = trial(grade).run(|t| changing(before, behind, t), |_, _, _| true);
            let errors = after(&record, 0.0, 200.0);
            assert!(errors.rms < 0.1 && errors.worst < 0.5, "{} {errors:?}", grade.name);
            let errors = after(&record, 200.0, 600.0);
            assert!(errors.rms < 0.065 && errors.covered > 0.9, "{} {errors:?}", grade.name);
            let delayed = delayed_after(&record, -100.0, 300.0);
            assert!(delayed.rms < 0.02, "{} {delayed:?}", grade.name);
        }
    }
}

#[test]
fn the_heel_of_a_turn_is_no_heave_after_a_minute_and_a_half() {
    let sea = sea();
    let ramp = |x: f64| {
        let x = (x / 15.0).clamp(0.0, 1.0);
        x * x * (3.0 - 2.0 * x)
    };
    let heel = 5_f64.to_radians();
    let ship = |t: f64| {
        let straight = sea.at(t);
        Move { roll: straight.roll + heel * (ramp(t - AT) - ramp(t - AT - 180.0)), ..straight }
    };
    let sinks = ABEAM.0.y * heel;
    let record = trial(GRADES[1]).run(ship, |_, _, _| true);
    let straight = trial(GRADES[1]).run(|t| sea.at(t), |_, _, _| true);
    let moved = |from: f64, to: f64| {
        let pairs = record.iter().zip(&straight).filter(|(i, _)| i.t > AT + from && i.t < AT + to);
        pairs.map(|(i, s)| i.heave[1].heave - s.heave[1].heave).collect::<Vec<f64>>()
    };
    let most = |from, to| moved(from, to).iter().fold(0.0, |most, x| f64::max(most, x.abs()));
    assert!(most(0.0, 60.0) < 0.7 * sinks, "{}", most(0.0, 60.0));
    assert!(most(60.0, 90.0) < 0.5 * sinks, "{}", most(60.0, 90.0));
    assert!(most(90.0, 180.0) < 0.15 * sinks, "{}", most(90.0, 180.0));
    let mean = moved(60.0, 180.0).iter().sum::<f64>() / 1200.0;
    assert!(mean.abs() < 0.02, "{mean}");
    let told = Errors::real_time(&record, 1, AT + 10.0, AT + 30.0);
    assert!(told.settled < 0.3, "{told:?}");
    assert!(most(290.0, 500.0) < 0.15 * sinks, "{}", most(290.0, 500.0));
}

#[test]
fn a_short_gap_is_bridged_and_a_long_one_begins_anew() {
    let sea = sea();
    let with_gap =
        |gap: f64| trial(GRADES[1]).run(|t| sea.at(t), |t, _, _| !(t > AT && t < AT + gap));
    let brief = with_gap(0.3);
    assert!(after(&brief, 1.0, 100.0).rms < 0.05, "{:?}", after(&brief, 1.0, 100.0));
    assert!(after(&brief, 1.0, 100.0).settled > 0.9);
    let second = with_gap(1.0);
    assert!(after(&second, 1.0, 60.0).rms < 0.15, "{:?}", after(&second, 1.0, 60.0));
    assert!(after(&second, 1.5, 15.0).settled < 0.2, "{:?}", after(&second, 1.5, 15.0));
    assert!(after(&second, 60.0, 300.0).rms < 0.05, "{:?}", after(&second, 60.0, 300.0));
    let long = with_gap(20.0);
    let unsettled = |t: f64| {
        let instant = long.iter().find(|i| i.t > AT + t).unwrap();
        instant.heave[0].quality == HeaveQuality::Unsettled && instant.heave[0].delayed.is_none()
    };
    assert!(unsettled(20.5) && unsettled(50.0));
    assert!(after(&long, 21.0, 600.0).worst < 3.0, "{:?}", after(&long, 21.0, 600.0));
    assert!(after(&long, 300.0, 600.0).rms < 0.05, "{:?}", after(&long, 300.0, 600.0));
}

#[test]
fn a_constant_error_of_the_acceleration_is_harmless_however_far_its_integral_goes() {
    let sea = sea();
    let record = trial(GRADES[0]).run(
        |t| sea.at(t),
        |_, step, _| {
            step.velocity += 0.3 * step.duration;
            true
        },
    );
    for errors in
        [Errors::real_time(&record, 1, 700.0, 1500.0), Errors::delayed(&record, 1, 500.0, 1500.0)]
    {
        assert!(errors.rms < 0.02 && errors.worst < 0.1, "{errors:?}");
    }
}

fn step(t: f64) -> VerticalStep {
    VerticalStep {
        to: Time::from_seconds(t),
        duration: 0.02,
        velocity: 0.0,
        down_b: Vector3::new(0.0, 0.0, 1.0),
    }
}

#[test]
fn steps_that_are_past_or_not_numbers_change_nothing() {
    let mut filter = HeaveFilter::new(&GRADES[0].spec(50.0), &[ABEAM]);
    (1..500).for_each(|i| filter.advance(&step(f64::from(i) * 0.02)));
    let before = filter.clone();
    filter.advance(&step(9.9));
    filter.advance(&VerticalStep { velocity: f64::NAN, ..step(10.0) });
    filter.advance(&VerticalStep { duration: 0.0, ..step(10.0) });
    assert_eq!(filter, before);
    filter.advance(&step(9.985));
    assert_ne!(filter, before);
    assert_eq!(filter.heave(0).map(|heave| heave.time), Some(Time::from_seconds(9.985)));
}

#[test]
fn there_is_no_heave_of_a_point_that_is_not_there_nor_before_the_first_tenth_of_a_second() {
    let mut filter = HeaveFilter::new(&GRADES[0].spec(50.0), &[Body::default()]);
    (1..=4).for_each(|i| filter.advance(&step(f64::from(i) * 0.02)));
    assert!(filter.heave(0).is_none());
    filter.advance(&step(0.1));
    assert!(filter.heave(0).is_some() && filter.heave(1).is_some() && filter.heave(2).is_none());
}
