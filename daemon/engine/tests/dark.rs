//! Long without satellites: a heading bounds no velocity, and what holds the height tells nothing of the place.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use insd_base::{Message, Solution, Truth, earth};
use insd_engine::{Engine, EngineConfig, Output};
use insd_simulator::lies::{Grade, Suite, case, catalogue};

/// When the receiver falls silent, s.
const DARK: f64 = 1500.0;

/// Horizontal error in claimed sigmas.
fn sigmas(said: &Solution, truth: &Truth) -> f64 {
    let apart = earth::ecef(&said.position).0 - earth::ecef(&truth.position).0;
    let off = (earth::c_ne(&truth.position) * apart).xy().norm();
    off / said.sigma.position.0.xy().norm()
}

#[test]
fn a_small_imu_with_a_compass_claims_what_it_drifts_by() {
    let voyage = case(&catalogue()[0], Grade::Mems, Suite::Compass, 1).honest().unwrap();
    let mut engine = Engine::new(EngineConfig::for_voyage(&voyage.header, 1.0));
    let mut worst = 0.0_f64;
    for received in voyage.received() {
        let is_dark = received.receipt.as_seconds() > DARK;
        if is_dark && matches!(received.message, Message::Gnss(_)) {
            continue;
        }
        engine.handle(&received);
        while let Some(output) = engine.poll_output() {
            let Output::Solution(said) = output else { continue };
            if let Ok(at) = voyage.truth.binary_search_by_key(&said.time, |row| row.time)
                && said.time.as_seconds() > DARK
            {
                worst = worst.max(sigmas(&said, &voyage.truth[at]));
            }
        }
    }
    assert!(worst < 3.5, "{worst} sigmas");
}
