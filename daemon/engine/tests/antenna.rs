//! Small IMUs, and antennas that are not where they are said to be: the ship has left her berth and stays where she is.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use insd_base::{Body, Span, Voyage, earth};
use insd_engine::{Engine, EngineConfig, Output};
use insd_simulator::{Override, Scenario, shipped, simulate};
use nalgebra::Vector3;

/// From her berth into a swell with gyros of some deg/h; where the antenna is, and where it is said to be.
fn coastal(seconds: f64, seed: u64, mast: [f64; 3], said: [f64; 3]) -> Voyage {
    let (_, text) = shipped().iter().find(|(name, _)| name.starts_with("03")).unwrap();
    let ship: Override = format!("gnss.lever_arm_m={mast:?}").parse().unwrap();
    let scenario = Scenario::with_overrides(text, &[ship]).unwrap().with_duration(seconds);
    let mut voyage = simulate(&scenario, seed);
    voyage.header.lever_arms.gnss = Body(Vector3::from(said));
    voyage
}

/// The greatest horizontal error, m, and that of the last minutes in claimed sigmas.
fn sailed(voyage: &Voyage) -> (f64, f64) {
    let mut engine = Engine::new(EngineConfig::for_voyage(&voyage.header, 1.0));
    let end = voyage.truth.last().unwrap().time - Span::from_seconds(180.0);
    let mut truth = voyage.truth.iter();
    let (mut worst, mut sigmas) = (0.0_f64, 0.0_f64);
    for received in voyage.received() {
        engine.handle(&received);
        while let Some(output) = engine.poll_output() {
            let Output::Solution(solution) = output else { continue };
            let Some(truth) = truth.find(|truth| truth.time >= solution.time) else { continue };
            let apart = earth::ecef(&solution.position).0 - earth::ecef(&truth.position).0;
            let off = (earth::c_ne(&truth.position) * apart).xy().norm();
            worst = worst.max(off);
            if solution.time > end {
                sigmas = sigmas.max(off / solution.sigma.position.0.xy().norm());
            }
        }
    }
    (worst, sigmas)
}

#[test]
fn an_antenna_on_the_wrong_side_of_a_small_imu_does_not_turn_her_round() {
    for (seed, height) in [(3, 14.0), (4, 14.0), (4, 33.0)] {
        let voyage = coastal(1000.0, seed, [-6.0, -0.8, -height], [-6.0, -0.8, height]);
        let (worst, sigmas) = sailed(&voyage);
        assert!(worst < 20.0 && sigmas < 3.0, "{seed}, {height} m: {worst} m, {sigmas} sigmas");
    }
}

#[test]
fn the_rolling_of_an_antenna_that_may_be_anywhere_tells_no_heading_at_the_berth() {
    let (worst, sigmas) = sailed(&coastal(1300.0, 3, [-6.0, -0.8, -33.0], [0.0; 3]));
    assert!(worst < 30.0 && sigmas < 3.0, "{worst} m, {sigmas} sigmas");
}

#[test]
fn an_antenna_beyond_any_ship_counts_as_one_that_was_not_measured() {
    let (worst, sigmas) = sailed(&coastal(1300.0, 3, [-6.0, -0.8, -14.0], [-60.0, -8.0, -140.0]));
    assert!(worst < 30.0 && sigmas < 3.0, "{worst} m, {sigmas} sigmas");
}

#[test]
fn a_receiver_that_is_a_fifth_of_a_second_late_does_not_hold_her_back() {
    let said = [-6.0, -0.8, -14.0];
    let mut voyage = coastal(1500.0, 4, said, said);
    for fix in &mut voyage.gnss {
        fix.message.time = fix.message.time + Span::from_seconds(0.2);
        fix.arrival = Some(fix.message.time);
    }
    let (worst, sigmas) = sailed(&voyage);
    assert!(worst < 6.0 && sigmas < 3.0, "{worst} m, {sigmas} sigmas");
}
