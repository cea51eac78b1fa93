//! Voyages that are sailed through the engine and back: what is known afterwards, against the truth.

#![allow(clippy::unwrap_used)]

use insd_base::units::wrap_pi;
use insd_base::{Message, Received, Solution, Span, Truth, Voyage, earth};
use insd_engine::{Engine, EngineConfig, Output};
use insd_nav::smoothing::{Smoothed, SmoothedVoyage};
use insd_simulator::{Scenario, simulate};
use rayon::iter::{IntoParallelIterator, ParallelIterator};

/// Fixes are away for a minute from here on, s.
const OUTAGE: f64 = 500.0;
/// Heading and biases are known from here on, s.
const SETTLED: f64 = 300.0;

/// Twelve minutes under way with a MEMS unit and a receiver, and a turn.
fn scenario() -> Scenario {
    let text = r#"
name = "smoothing"
mode = "underway"
[start]
lat_deg = 35.0
lon_deg = 61.75
height_m = 20.0
[[route.legs]]
heading_deg = 145.0
speed_kn = 12.0
duration_s = 240.0
[[route.legs]]
heading_deg = 35.0
speed_kn = 12.0
duration_s = 480.0
[sea]
state = 3
from_deg = 290.0
[imu]
grade = "mems"
[gnss]
"#;
    Scenario::with_overrides(text, &[]).unwrap()
}

fn is_away(received: &Received) -> bool {
    let time = received.message.time().as_seconds();
    matches!(received.message, Message::Gnss(_)) && (OUTAGE..OUTAGE + 60.0).contains(&time)
}

/// Messages without the fixes that are away, the others `late` by up to so much, s, in the order in which they are received.
fn messages(voyage: &Voyage, late: f64) -> Vec<Received> {
    let mut all = voyage.received();
    all.retain(|received| !is_away(received));
    for (index, received) in all.iter_mut().enumerate() {
        if matches!(received.message, Message::Gnss(_)) {
            let share = (index as f64 * 0.618_033_988_749_895).fract();
            received.receipt = received.message.time() + Span::from_seconds(late * share);
        }
    }
    all.sort_by_key(|received| received.receipt);
    all
}

/// What was told at the time, and what is known afterwards.
fn sailed(voyage: &Voyage, messages: &[Received]) -> (Vec<Solution>, SmoothedVoyage) {
    let config =
        EngineConfig { smoothing: Some(1.0), ..EngineConfig::for_voyage(&voyage.header, 1.0) };
    let mut engine = Engine::new(config);
    let mut solutions = Vec::new();
    for received in messages {
        engine.handle(received);
        while let Some(output) = engine.poll_output() {
            if let Output::Solution(solution) = output {
                solutions.push(solution);
            }
        }
    }
    (solutions, engine.smoothed())
}

/// Horizontal distance from the truth at the same instant, m.
fn off(voyage: &Voyage, row: &Smoothed) -> Option<(f64, Truth)> {
    let truth = voyage.truth.iter().find(|truth| truth.time == row.time)?;
    let apart = earth::ecef(&row.position).0 - earth::ecef(&truth.position).0;
    Some(((earth::c_ne(&truth.position) * apart).xy().norm(), *truth))
}

fn as_row(told: &Solution) -> Smoothed {
    Smoothed {
        time: told.time,
        position: told.position,
        velocity: told.velocity,
        attitude: told.attitude,
        sigma: told.sigma,
    }
}

/// Mean square over rows of an outage and the second after it.
fn in_outage(voyage: &Voyage, rows: &[Smoothed]) -> f64 {
    let is_in = |row: &&Smoothed| (OUTAGE..OUTAGE + 60.0).contains(&row.time.as_seconds());
    let squares: Vec<f64> =
        rows.iter().filter(is_in).filter_map(|row| Some(off(voyage, row)?.0.powi(2))).collect();
    assert!(squares.len() > 50);
    squares.iter().sum::<f64>() / squares.len() as f64
}

/// Mean square of the normalised errors of horizontal velocity and of heading.
fn nees(voyage: &Voyage, rows: &[Smoothed]) -> [f64; 2] {
    let (mut sums, mut count) = ([0.0; 2], 0.0);
    for row in rows.iter().filter(|row| row.time.as_seconds() >= SETTLED) {
        let Some((_, truth)) = off(voyage, row) else { continue };
        let (velocity, attitude) = (truth.velocity.unwrap(), truth.attitude.unwrap());
        let velocity = (row.velocity.0 - velocity.0).component_div(&row.sigma.velocity.0);
        let turned = wrap_pi(row.attitude.heading - attitude.heading);
        sums[0] += 0.5 * velocity.xy().norm_squared();
        sums[1] += (turned / row.sigma.heading).powi(2);
        count += 1.0;
    }
    sums.map(|sum| sum / count)
}

#[test]
fn a_minute_without_fixes_is_known_afterwards_to_a_third_of_what_was_known_then() {
    let one = |seed: u64| {
        let voyage = simulate(&scenario(), seed);
        let (told, smoothed) = sailed(&voyage, &messages(&voyage, 0.0));
        let told: Vec<Smoothed> = told.iter().map(as_row).collect();
        assert!(smoothed.cuts.is_empty());
        let nees = nees(&voyage, &smoothed.rows);
        [in_outage(&voyage, &told), in_outage(&voyage, &smoothed.rows), nees[0], nees[1]]
    };
    let all: Vec<[f64; 4]> = (1..9).into_par_iter().map(one).collect();
    let mean = |at: usize| all.iter().map(|own| own[at]).sum::<f64>() / all.len() as f64;
    let [then, afterwards] = [mean(0).sqrt(), mean(1).sqrt()];
    println!("{then:.3} m, {afterwards:.3} m, NEES {:.3} {:.3}", mean(2), mean(3));
    assert!(afterwards < 0.35 * then, "{afterwards} and {then}");
    assert!((0.7..1.5).contains(&mean(2)), "velocity: {}", mean(2));
    // eight voyages are eight headings
    assert!((0.3..2.2).contains(&mean(3)), "heading: {}", mean(3));
}

#[test]
fn fixes_that_come_late_leave_the_same_smoothed_voyage() {
    let voyage = simulate(&scenario().with_duration(420.0), 3);
    let (_, prompt) = sailed(&voyage, &messages(&voyage, 0.0));
    let (_, late) = sailed(&voyage, &messages(&voyage, 0.8));
    let settled = |rows: &[Smoothed]| -> Vec<Smoothed> {
        rows.iter().filter(|row| row.time.as_seconds() >= SETTLED).copied().collect()
    };
    let (prompt, late) = (settled(&prompt.rows), settled(&late.rows));
    assert!(prompt.len() > 100);
    // a start chooses its first estimate from what has arrived: closely, and not to the bit
    for (a, b) in prompt.iter().zip(&late) {
        assert_eq!(a.time, b.time);
        let apart = earth::ecef(&a.position).0 - earth::ecef(&b.position).0;
        assert!(apart.norm() < 0.05 * a.sigma.position.0.norm(), "{a:?} {b:?}");
    }
}

#[test]
fn the_last_instant_is_known_as_well_afterwards_as_then() {
    let voyage = simulate(&scenario().with_duration(200.0), 4);
    let (told, smoothed) = sailed(&voyage, &messages(&voyage, 0.0));
    let (then, now) = (told.last().unwrap(), smoothed.rows.last().unwrap());
    assert_eq!(then.time, now.time);
    let apart = earth::ecef(&then.position).0 - earth::ecef(&now.position).0;
    assert!(apart.norm() < 0.2 * then.sigma.position.0.norm(), "{apart:?}");
}

#[test]
fn who_does_not_ask_for_it_keeps_nothing() {
    let voyage = simulate(&scenario().with_duration(60.0), 4);
    let mut engine = Engine::new(EngineConfig::for_voyage(&voyage.header, 1.0));
    voyage.received().iter().for_each(|received| engine.handle(received));
    assert!(engine.smoothed().rows.is_empty());
}
