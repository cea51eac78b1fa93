//! Honest sensors of a kind that not every voyage has: nobody is named.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use insd_base::{Event, Standing};
use insd_engine::{Engine, EngineConfig, Output};
use insd_simulator::{Scenario, shipped, simulate};
use rayon::iter::{IntoParallelIterator, ParallelIterator};

/// Who was left out on a voyage, and when, s.
fn left_out(scenario: &Scenario, seed: u64) -> Vec<(f64, &'static str)> {
    let voyage = simulate(scenario, seed);
    let mut engine = Engine::new(EngineConfig::for_voyage(&voyage.header, 1.0));
    let mut all = Vec::new();
    for received in voyage.received() {
        engine.handle(&received);
        while let Some(output) = engine.poll_output() {
            if let Output::Event(Event::Judged { time, stands }) = output
                && stands.standing == Standing::Excluded
            {
                all.push((time.as_seconds(), stands.party.as_str()));
            }
        }
    }
    all
}

#[test]
fn a_log_of_two_components_is_not_left_out_for_what_they_scatter() {
    let (_, text) = shipped().iter().find(|(file, _)| file.starts_with("10")).unwrap();
    let text = text.replace("[gnss]", "[gnss]\nrate_hz = 5.0\n[log]\naxes = \"uv\"");
    let scenario = Scenario::with_overrides(&text, &[]).unwrap().with_duration(900.0);
    let all: Vec<_> = (1_u64..=4)
        .into_par_iter()
        .map(|seed| (seed, left_out(&scenario, seed)))
        .filter(|(_, out)| !out.is_empty())
        .collect();
    assert!(all.is_empty(), "{all:?}");
}
