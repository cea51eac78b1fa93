//! Warm starts: the state stored at one visit to the berth, offered at the next.

use insd_alignment::StoredState;
use insd_base::units::{DEG, wrap_two_pi};
use insd_base::{Event, Geodetic, StoredDoubt};
use insd_engine::{Engine, EngineConfig};
use insd_lab::evaluation::Component;
use insd_simulator::{Scenario, simulate};
use insd_tests::sailing::{Logbook, OUTPUT_RATE, sail, sail_messages};
use insd_tests::scenario;
use insd_tests::scores::Scores;

use super::figure;

/// The state at the end of a first visit of five minutes.
fn stored(scenario: &Scenario, seed: u64) -> StoredState {
    let voyage = simulate(&scenario.clone().with_duration(300.0), seed);
    let mut engine = Engine::new(EngineConfig::for_voyage(&voyage.header, OUTPUT_RATE));
    for received in voyage.received() {
        engine.handle(&received);
    }
    engine.stored_state().unwrap()
}

/// A second visit, of so many seconds, that starts from a state.
fn warm(scenario: &Scenario, seed: u64, seconds: f64, state: StoredState) -> (Logbook, Scores) {
    let voyage = simulate(&scenario.clone().with_duration(seconds), seed);
    let mut config = EngineConfig::for_voyage(&voyage.header, OUTPUT_RATE);
    config.stored = Some(state);
    let log = sail_messages(&config, &voyage.received(), 1);
    let scores = Scores::new(&log.solutions, &voyage.truth, 0.0, f64::MAX);
    (log, scores)
}

fn turned(state: StoredState, degrees: f64) -> StoredState {
    let mut state = state;
    state.attitude.heading = wrap_two_pi(state.attitude.heading + degrees * DEG);
    state
}

/// When the claim first is below so many degrees, s.
fn claims(scores: &Scores, degrees: f64) -> f64 {
    let below = |epoch: &&insd_lab::evaluation::EpochError| {
        epoch.sigma_of(Component::Heading) < degrees * DEG
    };
    scores.epochs.iter().find(below).unwrap().time.as_seconds()
}

/// The boldest claim of the heading, in sigmas.
fn boldest(scores: &Scores) -> f64 {
    insd_lab::evaluation::worst_heading(&scores.epochs).unwrap().ratio
}

/// When and why the state was dropped, told once.
fn dropped(log: &Logbook) -> Option<(f64, StoredDoubt)> {
    let mut told = log.events.iter().filter_map(|event| match event {
        Event::StoredStateDropped { time, reason } => Some((time.as_seconds(), *reason)),
        _ => None,
    });
    let first = told.next();
    assert_eq!(told.next(), None);
    first
}

fn used(log: &Logbook) -> bool {
    log.events.iter().any(|event| matches!(event, Event::StoredStateUsed { .. }))
}

#[test]
fn s17_a_right_stored_state_shortens_the_way_to_the_first_heading() {
    let state = stored(&scenario(17), 101);
    let (log, scores) = warm(&scenario(17), 1, 150.0, state);
    let cold = sail(&scenario(17).with_duration(150.0), 1).scores_from(0.0);
    let (soon, late) = (claims(&scores, 2.0), claims(&cold, 2.0));
    figure!("s17 first 2 deg: warm {soon} s, cold {late} s");
    assert!(soon + 4.0 < late, "{soon} {late}");
    assert!(used(&log) && dropped(&log).is_none());
    assert!(boldest(&scores) < 4.0, "{}", boldest(&scores));
}

#[test]
fn s17_a_small_turn_in_a_calm_is_never_claimed_to_be_none() {
    let state = turned(stored(&scenario(17), 102), 5.0);
    let (_, scores) = warm(&scenario(17), 2, 150.0, state);
    assert!(boldest(&scores) < 4.0, "{}", boldest(&scores));
}

#[test]
fn s07_a_turn_of_20_degrees_is_dropped_before_a_cold_alignment_knows_two() {
    for seed in [3, 4] {
        let state = turned(stored(&scenario(7), 100 + seed), 20.0);
        let (log, scores) = warm(&scenario(7), seed, 150.0, state);
        let (at, reason) = dropped(&log).unwrap();
        figure!("s07 20 deg dropped at {at} s, boldest claim {}", boldest(&scores));
        assert_eq!(reason, StoredDoubt::Turned);
        assert!(at < 108.0, "{at}");
        assert!(boldest(&scores) < 4.0, "{}", boldest(&scores));
    }
}

#[test]
fn s07_a_turn_by_a_right_angle_is_dropped_within_a_minute() {
    let state = turned(stored(&scenario(7), 105), 90.0);
    let (log, _) = warm(&scenario(7), 5, 90.0, state);
    let (at, reason) = dropped(&log).unwrap();
    assert!(at <= 60.0 && reason == StoredDoubt::Turned, "{at} {reason:?}");
}

#[test]
fn s17_another_berth_imu_or_mounting_is_dropped_at_once_and_leaves_a_cold_start() {
    let sound = stored(&scenario(17), 106);
    let mut elsewhere = sound;
    elsewhere.position = Geodetic { latitude: sound.position.latitude + 2e-5, ..sound.position };
    let other = StoredState { imu: sound.imu ^ 1, ..sound };
    let mut tilted = sound;
    tilted.attitude.roll += 90.0 * DEG;
    let at_sea = StoredState { moored: false, ..sound };
    let cold = sail(&scenario(17).with_duration(60.0), 6);
    for (state, wanted) in [
        (elsewhere, StoredDoubt::Moved),
        (other, StoredDoubt::OtherImu),
        (tilted, StoredDoubt::Tilted),
        (at_sea, StoredDoubt::NotMoored),
    ] {
        let (log, _) = warm(&scenario(17), 6, 60.0, state);
        let (at, reason) = dropped(&log).unwrap();
        assert!(at < 1.0 && reason == wanted, "{at} {reason:?}");
        assert_eq!(log.solutions, cold.log.solutions, "{wanted:?}");
    }
}

#[test]
fn no_state_is_stored_under_way_or_before_she_is_aligned() {
    let end = |number: usize, seconds: f64| {
        let voyage = simulate(&scenario(number).with_duration(seconds), 1);
        let mut engine = Engine::new(EngineConfig::for_voyage(&voyage.header, OUTPUT_RATE));
        for received in voyage.received() {
            engine.handle(&received);
        }
        engine.stored_state()
    };
    assert_eq!(end(17, 40.0), None);
    assert_eq!(end(10, 400.0), None);
}
