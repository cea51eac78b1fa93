//! Two receivers on one ship: one is used, the other is compared, and whoever lies is named and left out.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod sail;

use insd_base::{Party, Span, Time};
use insd_engine::{Engine, EngineConfig};
use insd_simulator::lies::{GnssLie, Grade, Suite, Window};
use nalgebra::Vector2;
use rayon::prelude::*;

use sail::{RTK, SINGLE_POINT, Sailed, Ship, sail};

/// When lies begin, s.
const FROM: f64 = 1500.0;
/// 300 m off at once; dragged off with 1 m/s, velocity included, or not.
const JUMP: GnssLie = GnssLie::Jump(Vector2::new(200.0, -224.0));
const DRAG: GnssLie = GnssLie::Drag { velocity: Vector2::new(0.6, 0.8), consistent: true };
const SLIDE: GnssLie = GnssLie::Drag { velocity: Vector2::new(-0.8, 0.6), consistent: false };

const SHIPS: [(Grade, Suite); 4] = [
    (Grade::Navigation, Suite::Gnss),
    (Grade::Navigation, Suite::Log),
    (Grade::Mems, Suite::Gnss),
    (Grade::Mems, Suite::Log),
];

fn for_good() -> Window {
    Window { from: FROM, until: f64::INFINITY }
}

/// A ship with good gyros and a log, and one with neither, with each lie, told by the one or the other.
fn of_all(lies: &[GnssLie], spoil: fn(Ship, GnssLie) -> Ship, look: fn(&Sailed, &str)) {
    let ships = SHIPS[1..3].iter();
    let cases: Vec<_> = ships.flat_map(|ship| lies.iter().map(move |lie| (*ship, *lie))).collect();
    cases.into_par_iter().for_each(|((grade, suite), lie)| {
        let ship = spoil(Ship::new(grade, suite, 1, SINGLE_POINT), lie);
        let sailed = sail(&ship);
        look(&sailed, &format!("{grade:?} {suite} {lie:?}: {}", sailed.summary(FROM)));
    });
}

#[test]
fn a_receiver_that_lies_is_named_and_the_other_is_used() {
    let spoil = |ship: Ship, lie| ship.with_first_spoilt(lie, for_good());
    of_all(&[JUMP, DRAG, SLIDE, GnssLie::FrozenPosition], spoil, |sailed, case| {
        assert!(sailed.worst(FROM + 60.0) < 20.0, "{case}");
        assert!(sailed.named("gnss").is_some_and(|at| at < FROM + 60.0), "{case}");
        assert_eq!(sailed.all_named(), ["gnss"], "{case}");
        let [(at, change)] = sailed.changes[..] else { panic!("{case}") };
        assert_eq!((change.from, change.to), (Party::Gnss, Party::Gnss2), "{case}");
        assert!(change.is_for_lie && (FROM..FROM + 60.0).contains(&at), "{case}");
        assert!(sailed.in_doubt() < 20, "{case}");
        assert!(sailed.greatest_step(FROM) < 3.0, "the position does not jump: {case}");
    });
}

#[test]
fn a_spare_that_lies_is_named_and_nothing_else_happens() {
    let spoil = |ship: Ship, lie| ship.with_spare_spoilt(lie, for_good());
    of_all(&[DRAG, GnssLie::VelocitySign], spoil, |sailed, case| {
        assert!(sailed.worst(FROM) < 4.0, "{case}");
        assert!(sailed.named("gnss2").is_some_and(|at| at < FROM + 90.0), "{case}");
        assert_eq!(sailed.all_named(), ["gnss2"], "{case}");
        assert!(sailed.changes.is_empty() && sailed.in_doubt() < 20, "{case}");
    });
}

#[test]
fn two_honest_receivers_raise_no_alarm_and_cost_no_accuracy() {
    let cases: Vec<_> = SHIPS.into_iter().zip([1, 2, 3, 2]).collect();
    cases.into_par_iter().for_each(|((grade, suite), seed)| {
        let spare = if seed == 1 { RTK } else { SINGLE_POINT };
        let ship = Ship::new(grade, suite, seed, spare);
        let ship = if seed == 2 { ship.with_first(RTK) } else { ship };
        let both = sail(&ship);
        let case = format!("{grade:?} {suite} {seed}: {}", both.summary(600.0));
        assert!(both.verdicts.is_empty() && both.changes.is_empty(), "{case}");
        assert_eq!(both.in_doubt(), 0, "{case}");
        if seed == 3 {
            let alone = sail(&Ship { spare: Vec::new(), ..ship });
            let [with, without] = [&both, &alone].map(|sailed| sailed.rms(600.0));
            assert!((with / without - 1.0).abs() < 0.01, "{without} m alone, {case}");
        }
    });
}

#[test]
fn when_the_one_in_use_falls_silent_the_other_carries_on() {
    SHIPS[1..3].par_iter().for_each(|(grade, suite)| {
        let outage = Window { from: FROM, until: FROM + 600.0 };
        let ship = Ship::new(*grade, *suite, 2, SINGLE_POINT).without_first(outage);
        let sailed = sail(&ship);
        let case = format!("{grade:?} {suite}: {}", sailed.summary(FROM));
        assert!(sailed.worst(FROM) < 8.0 && sailed.verdicts.is_empty(), "{case}");
    });
}

#[test]
fn a_spare_that_lies_is_not_taken_when_the_other_falls_silent() {
    let outage = Window { from: FROM + 300.0, until: FROM + 600.0 };
    let ship = Ship::new(Grade::Navigation, Suite::Log, 1, SINGLE_POINT);
    let sailed = sail(&ship.with_spare_spoilt(JUMP, for_good()).without_first(outage));
    let case = sailed.summary(FROM);
    assert!(sailed.worst(FROM) < 20.0, "{case}");
    assert_eq!(sailed.all_named(), ["gnss2"], "{case}");
    assert_eq!(sailed.rows.last().unwrap().excluded, ["gnss2"], "{case}");
}

#[test]
fn a_receiver_that_tells_the_truth_again_is_taken_back() {
    let (lie, window) = (JUMP, Window { from: FROM, until: FROM + 120.0 });
    let ship = Ship::new(Grade::Mems, Suite::Log, 1, SINGLE_POINT);
    let sailed = sail(&ship.with_first_spoilt(lie, window));
    let case = sailed.summary(FROM);
    let used: Vec<Party> = sailed.changes.iter().map(|(_, change)| change.to).collect();
    assert_eq!(used, [Party::Gnss2, Party::Gnss], "{case}");
    assert!(sailed.changes[1].0 >= FROM + 180.0, "not before it has agreed for a minute: {case}");
    assert!(sailed.rows.last().unwrap().excluded.is_empty(), "{case}");
    assert!(sailed.worst(FROM + 60.0) < 10.0, "{case}");
}

#[test]
fn fixes_that_come_late_change_nothing_and_the_same_messages_give_the_same_bits() {
    let ship =
        Ship::new(Grade::Mems, Suite::Gnss, 1, SINGLE_POINT).with_first_spoilt(JUMP, for_good());
    let late = sail(&ship.clone().arriving_late(0.4));
    let again = sail(&ship.arriving_late(0.4));
    assert_eq!(late.rows, again.rows);
    let case = late.summary(FROM);
    assert!(late.worst(FROM + 60.0) < 20.0 && late.all_named() == ["gnss"], "{case}");
    assert_eq!(late.changes.len(), 1, "{case}");
}

#[test]
fn a_restart_does_not_forget_who_lied() {
    let ship = Ship::new(Grade::Navigation, Suite::Log, 1, SINGLE_POINT)
        .with_first_spoilt(JUMP, for_good());
    let config = EngineConfig::for_voyage(&ship.voyage.header, 1.0);
    let (mut before, mut after) = (Engine::new(config.clone()), Engine::new(config));
    let mut saved = None;
    let restart = Time::from_seconds(FROM + 100.0);
    let until = restart + Span::from_seconds(120.0);
    for received in ship.received() {
        if received.receipt <= restart {
            before.handle(&received);
            if received.receipt == restart {
                saved = before.checkpoint();
            }
        } else if received.receipt <= until {
            if let Some(bytes) = saved.take() {
                after.resume(&bytes, restart, Span::ZERO).unwrap();
            }
            after.handle(&received);
        }
    }
    let excluded: Vec<&str> = after.excluded().iter().map(Party::as_str).collect();
    assert_eq!(excluded, ["gnss"]);
    let truth = ship.voyage.truth.iter().find(|truth| truth.time == until).unwrap();
    let off = sail::apart(&after.motion().unwrap().solution, truth);
    assert!(off < 10.0, "{off} m");
}
