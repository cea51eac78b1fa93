//! Honest sensors of a kind that not every voyage has: nobody is named.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use std::f64::consts::TAU;

use insd_base::{Event, Standing, Voyage};
use insd_engine::{Engine, EngineConfig, Output};
use insd_simulator::{Scenario, shipped, simulate};
use rayon::iter::{IntoParallelIterator, ParallelIterator};

/// Who was left out on a voyage, and when, s.
fn left_out(scenario: &Scenario, seed: u64) -> Vec<(f64, &'static str)> {
    judged(&simulate(scenario, seed), |standing| standing == Standing::Excluded)
}

/// Who came to stand so on a voyage, and when, s.
fn judged(voyage: &Voyage, is_so: impl Fn(Standing) -> bool) -> Vec<(f64, &'static str)> {
    let mut engine = Engine::new(EngineConfig::for_voyage(&voyage.header, 1.0));
    let mut all = Vec::new();
    for received in voyage.received() {
        engine.handle(&received);
        while let Some(output) = engine.poll_output() {
            if let Output::Event(Event::Judged { time, stands }) = output
                && is_so(stands.standing)
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

/// Height, m, velocity, m/s, and acceleration, m/s^2, upwards of a craft that climbs by 30 m in a minute from 500 s on.
fn climb(second: f64) -> [f64; 3] {
    const HILL: (f64, f64) = (30.0, 60.0);
    let (height, time) = HILL;
    let share = ((second - 500.0) / time).clamp(0.0, 1.0);
    let (sin, cos) = (TAU * share).sin_cos();
    let (speed, rate) = (height / time, TAU / time);
    [height * (share - sin / TAU), speed * (1.0 - cos), speed * rate * sin]
}

/// In a lock, on a river or on land the mean sea level is not where it was.
#[test]
fn a_craft_that_climbs_has_nobody_doubted() {
    let (_, text) = shipped().iter().find(|(file, _)| file.starts_with("10")).unwrap();
    let scenario = Scenario::with_overrides(text, &[]).unwrap().with_duration(900.0);
    let mut voyage = simulate(&scenario, 1);
    for fix in &mut voyage.gnss {
        let [up, rising, _] = climb(fix.message.time.as_seconds());
        fix.message.position.iter_mut().for_each(|place| place.height += up);
        fix.message.velocity.iter_mut().for_each(|velocity| velocity.0.z -= rising);
    }
    let tick = 1.0 / voyage.header.imu.rate;
    for sample in &mut voyage.imu {
        let [_, _, pushed] = climb(sample.message.time.as_seconds());
        sample.message.delta_velocity.0.z -= pushed * tick;
    }
    let all = judged(&voyage, |standing| standing != Standing::Trusted);
    assert!(all.is_empty(), "{all:?}");
}
