//! Ships at their berths over some seeds: claims that hold in a swell, while she leaves, and with coarse gyros.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use std::ops::Range;

use insd_base::units::wrap_pi;
use insd_base::{Message, Solution, Truth, earth};
use insd_engine::{Engine, EngineConfig, Output};
use insd_simulator::{Scenario, limit, shipped, simulate};
use rayon::iter::{IntoParallelIterator, ParallelIterator};

/// The shipped scenario of this number, cut off, s.
fn scenario(number: &str, duration: u32) -> Scenario {
    scenario_with(number, duration, &[])
}

/// The same with some keys set.
fn scenario_with(number: &str, duration: u32, sets: &[&str]) -> Scenario {
    let (_, text) = shipped().iter().find(|(file, _)| file.starts_with(number)).unwrap();
    let cut = format!("duration_s={duration}").parse().unwrap();
    let sets = sets.iter().map(|set| set.parse().unwrap());
    let overrides: Vec<_> = std::iter::once(cut).chain(sets).collect();
    Scenario::with_overrides(text, &overrides).unwrap()
}

/// Solutions with the truth at their time, one a second.
fn sailed(scenario: &Scenario, seed: u64) -> Vec<(Solution, Truth)> {
    sailed_hearing(scenario, seed, |_| true)
}

/// The same with the receiver heard at some times alone, s.
fn sailed_hearing(
    scenario: &Scenario,
    seed: u64,
    is_heard: impl Fn(f64) -> bool,
) -> Vec<(Solution, Truth)> {
    let voyage = simulate(scenario, seed);
    let mut engine = Engine::new(EngineConfig::for_voyage(&voyage.header, 1.0));
    let mut solutions = Vec::new();
    let is_silent = |message: &Message| matches!(message, Message::Gnss(fix) if !is_heard(fix.time.as_seconds()));
    for received in voyage.received().into_iter().filter(|received| !is_silent(&received.message)) {
        engine.handle(&received);
        while let Some(output) = engine.poll_output() {
            if let Output::Solution(solution) = output {
                let at = voyage.truth.binary_search_by_key(&solution.time, |row| row.time);
                solutions.extend(at.ok().map(|at| (solution, voyage.truth[at])));
            }
        }
    }
    solutions
}

/// The error of the heading, rad.
fn off((solution, truth): &(Solution, Truth)) -> f64 {
    wrap_pi(solution.attitude.heading - truth.attitude.unwrap().heading)
}

fn last(rows: &[(Solution, Truth)]) -> &(Solution, Truth) {
    rows.last().unwrap()
}

#[test]
fn in_a_swell_no_heading_is_claimed_that_the_swell_alone_makes() {
    let swell = scenario("18", 100);
    let worst_of = |seed: u64| {
        let rows = sailed(&swell, seed);
        let late = rows.iter().filter(|row| row.0.time.as_seconds() >= 30.0);
        let sigmas = late.map(|row| (off(row) / row.0.sigma.heading).abs());
        sigmas.fold(0.0, f64::max)
    };
    let seeds = [14_u64, 122, 136, 155, 163, 173, 181, 200];
    let worst = seeds.into_par_iter().map(worst_of).reduce(|| 0.0, f64::max);
    assert!(worst < 4.0, "{worst} claimed sigmas");
}

#[test]
fn a_ship_that_leaves_is_not_drawn_back_to_her_berth() {
    let departure = scenario("23", 300);
    let square_of = |seed: u64| {
        let rows = sailed(&departure, seed);
        let (solution, truth) = last(&rows);
        let away = earth::ecef(&solution.position).0 - earth::ecef(&truth.position).0;
        let off = earth::c_ne(&truth.position) * away;
        let sigma = solution.sigma.position.0;
        0.5 * ((off.x / sigma.x).powi(2) + (off.y / sigma.y).powi(2))
    };
    let squares: Vec<f64> = (101_u64..113).into_par_iter().map(square_of).collect();
    let nees = squares.iter().sum::<f64>() / squares.len() as f64;
    assert!(nees < 2.5, "{nees}");
}

#[test]
fn coarse_gyros_and_gnss_find_the_heading_of_a_ship_alongside_as_well_as_can_be() {
    let alongside = scenario("25", 600);
    let best = limit(&alongside, &[600.0]).unwrap()[0].heading;
    let offs: Vec<f64> =
        (1_u64..17).into_par_iter().map(|seed| off(last(&sailed(&alongside, seed)))).collect();
    let rms = (offs.iter().map(|off| off * off).sum::<f64>() / offs.len() as f64).sqrt();
    assert!(rms < 1.5 * best, "{} times the limit", rms / best);
}

#[test]
fn coarse_gyros_keep_roll_and_pitch_of_a_ship_that_hardly_moves_and_claim_no_heading() {
    for height in ["sea.significant_height_m=0.0", "sea.significant_height_m=0.05"] {
        let still = scenario_with("25", 600, &[height]);
        let best = limit(&still, &[600.0]).unwrap()[0];
        let of = |seed: u64| {
            let rows = sailed(&still, seed);
            let tilts = |(said, truth): &(Solution, Truth)| {
                let truth = truth.attitude.unwrap();
                let (attitude, sigma) = (said.attitude, said.sigma);
                let roll = (attitude.roll - truth.roll, sigma.roll);
                let pitch = (attitude.pitch - truth.pitch, sigma.pitch);
                [roll, pitch]
            };
            let late = rows.iter().filter(|row| row.0.time.as_seconds() >= 60.0);
            let sigmas = late.clone().flat_map(tilts).map(|(off, sigma)| (off / sigma).abs());
            let turned = late.map(|row| (off(row) / row.0.sigma.heading).abs());
            let [roll, pitch] = tilts(last(&rows));
            assert!(roll.1 < 1.5 * best.roll, "claimed {} of {}", roll.1, best.roll);
            (
                sigmas.fold(0.0, f64::max),
                turned.fold(0.0, f64::max),
                roll.0.powi(2) + pitch.0.powi(2),
            )
        };
        let ships: Vec<(f64, f64, f64)> = (1_u64..9).into_par_iter().map(of).collect();
        let worst = ships.iter().map(|ship| ship.0).fold(0.0, f64::max);
        assert!(worst < 3.5, "{height}: {worst} claimed sigmas of roll or pitch");
        let worst = ships.iter().map(|ship| ship.1).fold(0.0, f64::max);
        assert!(worst < 4.0, "{height}: {worst} claimed sigmas of heading");
        let rms = (ships.iter().map(|ship| ship.2).sum::<f64>() / (2 * ships.len()) as f64).sqrt();
        assert!(rms < 1.4 * best.roll, "{height}: {} times the limit", rms / best.roll);
    }
}

#[test]
fn coarse_gyros_claim_no_heading_that_is_not_there_where_a_receiver_tells_positions_alone() {
    let sets = ["sea.significant_height_m=0.05", "gnss.with_velocity=false"];
    let still = scenario_with("25", 900, &sets);
    let worst_of = |silent: &Range<f64>| {
        let of = |seed: u64| {
            let rows = sailed_hearing(&still, seed, |at| !silent.contains(&at));
            let late = rows.iter().filter(|row| row.0.time.as_seconds() >= 60.0);
            late.map(|row| (off(row) / row.0.sigma.heading).abs()).fold(0.0, f64::max)
        };
        (1_u64..7).into_par_iter().map(of).reduce(|| 0.0, f64::max)
    };
    for silent in [0.0..0.0, 0.0..200.0, 200.0..600.0] {
        let worst = worst_of(&silent);
        assert!(worst < 4.0, "silent {silent:?}: {worst} claimed sigmas");
    }
}
