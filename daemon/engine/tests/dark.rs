//! Long without satellites: a heading bounds no velocity, and what holds the height tells nothing of the place.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use insd_base::units::wrap_pi;
use insd_base::{Message, Solution, Truth, Voyage, earth};
use insd_engine::{Engine, EngineConfig, Output};
use insd_simulator::lies::{Grade, Suite, case, catalogue};
use rayon::prelude::*;

/// When the receiver falls silent, s.
const DARK: f64 = 1500.0;

/// Horizontal error in claimed sigmas.
fn sigmas(said: &Solution, truth: &Truth) -> f64 {
    let apart = earth::ecef(&said.position).0 - earth::ecef(&truth.position).0;
    let off = (earth::c_ne(&truth.position) * apart).xy().norm();
    off / said.sigma.position.0.xy().norm()
}

/// What she says while no receiver is heard from an instant on, s, beside the truth.
fn in_the_dark(voyage: &Voyage, from: f64) -> Vec<(Solution, Truth)> {
    let mut engine = Engine::new(EngineConfig::for_voyage(&voyage.header, 1.0));
    let mut said = Vec::new();
    for received in voyage.received() {
        let is_dark = received.receipt.as_seconds() > from;
        if is_dark && matches!(received.message, Message::Gnss(_)) {
            continue;
        }
        engine.handle(&received);
        while let Some(output) = engine.poll_output() {
            let Output::Solution(solution) = output else { continue };
            let row = voyage.truth.binary_search_by_key(&solution.time, |row| row.time);
            if let Ok(at) = row
                && solution.time.as_seconds() > from
            {
                said.push((solution, voyage.truth[at]));
            }
        }
    }
    said
}

#[test]
fn a_small_imu_with_a_compass_claims_what_it_drifts_by() {
    let voyage = case(&catalogue()[0], Grade::Mems, Suite::Compass, 1).honest().unwrap();
    let said = in_the_dark(&voyage, DARK);
    let worst = said.iter().map(|(said, truth)| sigmas(said, truth)).fold(0.0, f64::max);
    assert!(worst < 3.5, "{worst} sigmas");
}

#[test]
fn a_small_imu_with_a_log_does_not_take_turns_for_knowledge_of_its_heading() {
    let moored = catalogue().iter().find(|kind| kind.name == "moored: gnss jump").unwrap();
    let of_seed = |seed: u64| {
        let voyage = case(moored, Grade::Mems, Suite::Log, seed).honest().unwrap();
        let (said, truth) = in_the_dark(&voyage, 0.0).pop().unwrap();
        let off = wrap_pi(said.attitude.heading - truth.attitude.unwrap().heading);
        (off / said.sigma.heading).powi(2)
    };
    let squares: Vec<f64> = (1..=8).into_par_iter().map(of_seed).collect();
    let mean = squares.iter().sum::<f64>() / 8.0;
    // nine of ten means of eight squares are below 1.7, 999 of 1000 below 3.3
    assert!(mean < 3.3, "{squares:?}");
}
