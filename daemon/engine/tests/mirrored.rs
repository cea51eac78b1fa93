//! An IMU of which an axis is mirrored: at the berth it looks like a mast that points down, in the first turn like a receiver
//! that creeps away; gravity, the turns that log and course tell of, and the way that her antenna swings under way give it away.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use insd_base::{Event, Finding, Mode, Voyage, earth};
use insd_engine::{Engine, EngineConfig, Output};
use insd_simulator::{Scenario, shipped, simulate};

/// What is beyond so many claimed sigmas misleads.
const CLAIMED: f64 = 3.0;

/// The beginning of a shipped voyage with a gyro, and its accelerometer if its factor is -1, of the wrong sign.
fn mirrored(number: &str, seconds: f64, seed: u64, axis: usize, accel: f64) -> Voyage {
    let (_, text) = shipped().iter().find(|(name, _)| name.starts_with(number)).unwrap();
    let scenario = Scenario::from_toml(text).unwrap().with_duration(seconds);
    let mut voyage = simulate(&scenario, seed);
    for sample in &mut voyage.imu {
        sample.message.delta_theta.0[axis] *= -1.0;
        sample.message.delta_velocity.0[axis] *= accel;
    }
    voyage
}

/// With gyros of some degrees an hour from the berth to the first turns, which begin after 780 s.
const COASTAL: &str = "03";
/// With gyros that find north, under way when the navigator is started.
const RESTART: &str = "10";
/// With gyros that find north from a calm berth, which she leaves after 700 s with a turn.
const HARBOUR: &str = "01";

/// The greatest horizontal error told as valid that is beyond the claims, m, and what was found.
fn sail(voyage: &Voyage) -> (f64, Vec<&'static str>) {
    let mut engine = Engine::new(EngineConfig::for_voyage(&voyage.header, 1.0));
    let mut truth = voyage.truth.iter().peekable();
    let (mut misled, mut found) = (0.0_f64, Vec::new());
    for received in voyage.received() {
        engine.handle(&received);
        while let Some(output) = engine.poll_output() {
            let Output::Solution(solution) = output else {
                if let Output::Event(Event::InstallationFound { finding, .. }) = output {
                    found.push(Finding::as_str(&finding));
                }
                continue;
            };
            while truth.next_if(|truth| truth.time < solution.time).is_some() {}
            let Some(truth) = truth.peek() else { continue };
            let apart = earth::ecef(&solution.position).0 - earth::ecef(&truth.position).0;
            let off = (earth::c_ne(&truth.position) * apart).xy().norm();
            let is_told =
                !matches!(solution.mode, Mode::CoarseAlignment | Mode::Standby | Mode::Fault);
            if is_told && off > CLAIMED * solution.sigma.position.0.xy().norm() {
                misled = misled.max(off);
            }
        }
    }
    (misled, found)
}

#[test]
fn a_gyro_that_tells_turns_backwards_has_no_honest_receiver_left_out() {
    let (misled, _) = sail(&mirrored(COASTAL, 1000.0, 1, 2, 1.0));
    assert!(misled < 20.0, "{misled} m");
}

#[test]
fn a_gyro_that_tells_turns_backwards_is_named_in_the_first_turn_out_of_a_harbour() {
    let (misled, found) = sail(&mirrored(HARBOUR, 850.0, 1, 2, 1.0));
    assert!(misled < 50.0, "{misled} m");
    assert!(found.contains(&"imu_turns"), "{found:?}");
}

#[test]
fn an_axis_that_is_mirrored_is_named_at_the_berth() {
    for (number, seed, axis, accel) in
        [(COASTAL, 2, 0, 1.0), (COASTAL, 2, 1, -1.0), (HARBOUR, 11, 0, 1.0), (HARBOUR, 12, 1, -1.0)]
    {
        let (misled, found) = sail(&mirrored(number, 300.0, seed, axis, accel));
        assert!(misled < 50.0, "{number}, axis {axis}: {misled} m");
        assert_eq!(found.last(), Some(&"imu_axes"), "{number}, axis {axis}");
    }
}

#[test]
fn a_gyro_about_starboard_that_is_mirrored_alone_is_named_under_way() {
    let (misled, found) = sail(&mirrored(RESTART, 300.0, 1, 1, 1.0));
    assert!(misled < 20.0, "{misled} m");
    assert!(found.contains(&"imu_axes"), "{found:?}");
}
