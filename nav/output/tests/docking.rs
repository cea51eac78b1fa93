//! A ship alongside, to the byte: what a port says of berth, bow and stern, and when it says nothing.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use insd_base::units::{DEG, KNOT};
use insd_base::{
    Attitude, Body, Geodetic, Integrity, Judgement, Mode, Motion, MotionCovariance, Ned,
    Protection, Solution, SolutionSigma, SolutionSource, Time, UtcTime,
};
use insd_output::alerts::Condition;
use insd_output::docking::{DockingConfig, DockingLimits, Fender, Hull, Quay, WaterSide};
use insd_output::{Manner, MessageKind, OutputPortConfig, OutputStation, Rate, Situation};
use insd_wire::nmea::{
    AlertState, Pinsd, PinsdChoice, PinsdDocking, PinsdPart, PinsdSide, Sentence, Vbw,
};

/// Metres of a degree of longitude at 54 degrees north, and of latitude.
const EAST: f64 = 65_578.4;
const NORTH: f64 = 111_294.8;

/// A quay of 200 m to the east, the water south of it.
fn berths(chosen: bool) -> DockingConfig {
    let name = "Pier 3".to_owned();
    DockingConfig {
        berths: vec![Quay {
            name: name.clone(),
            line: [
                Geodetic::from_degrees(54.0, 8.0, 0.0),
                Geodetic::from_degrees(54.0, 8.0 + 200.0 / EAST, 0.0),
            ],
            water: WaterSide::Right,
            fenders: vec![Fender { at: 0.0, off: 1.0 }],
            bollards: Vec::new(),
            height: None,
            sigma: 0.1,
        }],
        hull: Some(Hull {
            outline: vec![[50.0, -10.0], [50.0, 10.0], [-50.0, 10.0], [-50.0, -10.0]],
            bow: Body::new(50.0, 0.0, 0.0),
            stern: Body::new(-50.0, 0.0, 0.0),
            manifold: None,
        }),
        rate_sigma: 1e-5,
        limits: DockingLimits { contact_speed: Some(0.15), distance: Some(5.0), level: None },
        chosen: chosen.then_some(name),
    }
}

/// 30 m south of the quay's middle, heading east, nearing it at 0.2 m/s and swinging her bow to it.
fn motion(time: Time) -> Motion {
    let sigmas = [0.1, 0.1, 0.2, 0.01, 0.01, 0.01, 0.05 * DEG, 0.05 * DEG, 0.1 * DEG];
    let covariance = MotionCovariance::from_diagonal(&sigmas.map(|own: f64| own * own).into());
    Motion {
        solution: Solution {
            time,
            position: Geodetic::from_degrees(54.0 - 30.0 / NORTH, 8.0 + 100.0 / EAST, 5.0),
            velocity: Ned::new(0.2, 0.3, 0.0),
            attitude: Attitude { roll: 0.0, pitch: 0.0, heading: 90.0 * DEG },
            rate: Body::new(0.0, 0.0, -0.001),
            sigma: SolutionSigma::of_variances(&covariance.diagonal()),
            mode: Mode::Aided,
            judgement: Judgement { integrity: Integrity::Consistent, ..Judgement::default() },
            source: Some(SolutionSource::Rtk),
            hidden: Protection::default(),
        },
        acceleration: Some(Ned::default()),
        covariance: Some(covariance),
        current: None,
    }
}

/// A port with such messages, from a simulator or not.
fn port(simulated: bool) -> OutputPortConfig {
    let kind = |name| (MessageKind::named(name).unwrap(), Rate::from_hertz(5.0));
    OutputPortConfig {
        messages: vec![kind("PINSD.DOK"), kind("VBW")],
        manner: Manner { simulated, ..Manner::default() },
        ..OutputPortConfig::default()
    }
}

/// What a station says in some seconds of a ship that is changed so.
fn said(station: &mut OutputStation, seconds: f64, change: &dyn Fn(&mut Motion)) -> Vec<Sentence> {
    let mut said = Vec::new();
    for step in 0..=(seconds * 10.0) as i64 {
        let now = Time::from_nanos(step * 100_000_000);
        let utc =
            UtcTime::from_civil((2026, 1, 2), (3, 4, 0), 0).map(|utc| utc.plus(now - Time::START));
        let mut own = motion(now);
        change(&mut own);
        let moment = Situation { motion: Some(own), ..Situation::default() };
        for boundary in station.due(now, utc) {
            station.messages(&boundary, &moment, |_, messages| {
                for message in messages {
                    let bytes = message.content.to_bytes();
                    for line in bytes.split_inclusive(|byte| *byte == b'\n') {
                        said.push(Sentence::read(line).unwrap().1);
                    }
                }
            });
        }
    }
    said
}

fn station(chosen: bool, simulated: bool) -> OutputStation {
    OutputStation::new([port(simulated)], vec![Body::default()], None).with_berths(berths(chosen))
}

#[test]
fn a_berth_and_each_part_of_the_ship_are_told_five_times_a_second() {
    let said = said(&mut station(true, false), 1.0, &|_| ());
    let told: Vec<_> = said.iter().filter(|own| matches!(own, Sentence::Pinsd(_))).collect();
    assert!(told.len() >= 15, "{}", told.len());
    let [
        Sentence::Pinsd(Pinsd::Berth(berth)),
        Sentence::Pinsd(Pinsd::Part(bow)),
        Sentence::Pinsd(Pinsd::Part(stern)),
        ..,
    ] = told[..]
    else {
        unreachable!("{told:?}")
    };
    assert_eq!(
        (berth.state, berth.berth, berth.choice),
        (PinsdDocking::Valid, Some(1), Some(PinsdChoice::Chosen))
    );
    assert_eq!((berth.side, berth.first), (Some(PinsdSide::Port), Some(PinsdPart::Bow)));
    assert!((berth.contact_speed.unwrap() - 0.25).abs() < 1e-3, "{berth:?}");
    assert!((berth.seconds.unwrap() - 19.0 / 0.25).abs() < 0.2, "{berth:?}");
    assert_eq!((bow.part, stern.part), (PinsdPart::Bow, PinsdPart::Stern));
    assert!(
        (bow.distance.unwrap() - 19.0).abs() < 0.02 && (stern.closing.unwrap() - 0.15).abs() < 1e-3
    );
    // position, heading at the arm, survey
    let sigma = 0.1_f64.hypot(50.0 * 0.1 * DEG).hypot(0.1);
    assert!((bow.distance_sigma.unwrap() - sigma).abs() < 0.006, "{bow:?}");
    assert!((bow.level.unwrap() - 5.2 * sigma).abs() < 0.006, "{bow:?}");
}

#[test]
fn the_stern_moves_athwart_as_the_ship_turns() {
    let said = said(&mut station(false, false), 1.0, &|_| ());
    let vbw = said.iter().rev().find_map(|own| match own {
        Sentence::Vbw(vbw) => Some(*vbw),
        _ => None,
    });
    let Vbw { ground, stern_ground, stern_water, without_stern, .. } = vbw.unwrap();
    assert!((ground.transverse.unwrap() + 0.2).abs() < KNOT * 1e-3, "to port");
    assert!((stern_ground.transverse.unwrap() + 0.15).abs() < KNOT * 1e-3, "less than her middle");
    assert!(stern_ground.valid && !stern_water.valid && !without_stern);
    assert_eq!(stern_water.transverse, None, "no log");
}

#[test]
fn without_a_berth_without_a_solution_and_from_a_simulator_no_number_is_told() {
    let parts = |said: &[Sentence]| {
        said.iter().filter(|own| matches!(own, Sentence::Pinsd(Pinsd::Part(_)))).count()
    };
    let states = |said: &[Sentence]| {
        let state = |own: &Sentence| match own {
            Sentence::Pinsd(Pinsd::Berth(berth)) => Some((berth.state, berth.berth)),
            _ => None,
        };
        said.iter().filter_map(state).next_back()
    };
    let away = said(&mut station(false, false), 1.0, &|own| own.solution.position.latitude += 0.1);
    assert_eq!((states(&away), parts(&away)), (Some((PinsdDocking::NotValid, None)), 0));
    let fault = said(&mut station(true, false), 1.0, &|own| own.solution.mode = Mode::Fault);
    assert_eq!((states(&fault), parts(&fault)), (Some((PinsdDocking::NotValid, Some(1))), 0));
    // the port's policy does not tell a heading of 5 degrees
    let wide = said(&mut station(true, false), 1.0, &|own| own.solution.sigma.heading = 5.0 * DEG);
    assert_eq!((states(&wide), parts(&wide)), (Some((PinsdDocking::NotValid, Some(1))), 0));
    let simulated = said(&mut station(true, true), 1.0, &|_| ());
    assert!(simulated.is_empty(), "it has no mark: {simulated:?}");
}

#[test]
fn a_hard_approach_raises_a_warning_at_the_berth_that_was_chosen() {
    for (chosen, state) in [(true, AlertState::Unacknowledged), (false, AlertState::Normal)] {
        let mut station = station(chosen, false);
        said(&mut station, 2.5, &|_| ());
        assert_eq!(station.alerts().state(Condition::ApproachFast), state);
        assert_eq!(station.alerts().state(Condition::QuayNear), AlertState::Normal);
    }
    let mut slow = station(true, false);
    said(&mut slow, 2.5, &|own| {
        own.solution.velocity.0.x = 0.06;
        own.solution.rate = Body::default();
        own.solution.position.latitude += (16.0 / NORTH).to_radians();
    });
    assert_eq!(slow.alerts().state(Condition::ApproachFast), AlertState::Normal);
    // a caution needs no answer
    assert_eq!(slow.alerts().state(Condition::QuayNear), AlertState::Acknowledged);
}

#[test]
fn a_berth_is_chosen_by_its_name_and_stays_chosen_over_another_configuration() {
    let mut station = station(false, false);
    assert!(!station.choose_berth(Some("Pier 4")) && station.choose_berth(Some("Pier 3")));
    let mut next =
        OutputStation::new([port(false)], vec![Body::default()], None).with_berths(berths(false));
    next.inherit(&station);
    assert_eq!(next.berths().chosen(), Some("Pier 3"));
    assert!(next.choose_berth(None) && next.berths().chosen().is_none());
}
