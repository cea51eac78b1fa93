//! An IMU of which an axis is mirrored: at the berth it looks like a mast that points down, in the first turn like a receiver
//! that creeps away.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use insd_base::{Event, Finding, Mode, Voyage, earth};
use insd_engine::{Engine, EngineConfig, Output};
use insd_simulator::{Scenario, shipped, simulate};

/// What is beyond so many claimed sigmas misleads.
const CLAIMED: f64 = 3.0;

/// With gyros of some degrees an hour from the berth to the first turns, which begin after 780 s.
fn coastal(seconds: f64, seed: u64, axis: usize) -> Voyage {
    let (_, text) = shipped().iter().find(|(name, _)| name.starts_with("03")).unwrap();
    let scenario = Scenario::from_toml(text).unwrap().with_duration(seconds);
    let mut voyage = simulate(&scenario, seed);
    for sample in &mut voyage.imu {
        sample.message.delta_theta.0[axis] *= -1.0;
    }
    voyage
}

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
    let (misled, _) = sail(&coastal(1000.0, 1, 2));
    assert!(misled < 20.0, "{misled} m");
}

#[test]
fn a_gyro_that_tells_rolling_backwards_is_found_out_at_the_berth() {
    let (misled, found) = sail(&coastal(300.0, 2, 0));
    assert!(misled < 20.0, "{misled} m");
    assert_eq!(found, ["imu_axes"]);
}
