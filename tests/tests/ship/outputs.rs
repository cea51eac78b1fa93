//! What the ports are told of a ship that turns hard and rolls, against the truth of that very instant.

use insd_base::units::{DEG, wrap_pi};
use insd_base::{Body, Time, UtcTime, Voyage};
use insd_engine::{Engine, EngineConfig};
use insd_output::{MessageKind, OutputPortConfig, Rate};
use insd_simulator::{Scenario, simulate};
use insd_vessel::{OutputPlan, Outputs, Spoken};
use insd_wire::nmea::Sentence;

use super::figure;

/// She finds her heading in a minute of zigzag, then turns by 180 deg at 20 deg/s and back again.
const TURNING: &str = r#"
name = "follow-up"
description = "turns at 20 deg/s"
mode = "underway"
[start]
lat_deg = 54.0
lon_deg = 8.0
height_m = 30.0
[[route.legs]]
heading_deg = 0.0
speed_kn = 12.0
duration_s = 60.0
[[route.legs]]
heading_deg = 60.0
speed_kn = 12.0
duration_s = 60.0
turn_rate_deg_s = 3.0
[[route.legs]]
heading_deg = 0.0
speed_kn = 12.0
duration_s = 120.0
turn_rate_deg_s = 3.0
[[route.legs]]
heading_deg = 178.0
speed_kn = 12.0
duration_s = 30.0
turn_rate_deg_s = 20.0
[[route.legs]]
heading_deg = 0.0
speed_kn = 12.0
duration_s = 30.0
turn_rate_deg_s = 20.0
[sea]
state = 4
from_deg = 250.0
[imu]
grade = "navigation"
[gnss]
"#;

/// True attitude between the rows of the truth, rad: roll, pitch, heading, and the rate of turn, rad/s.
fn truth_at(voyage: &Voyage, time: Time) -> Option<[f64; 4]> {
    let next = voyage.truth.partition_point(|row| row.time <= time);
    let (one, other) = (voyage.truth.get(next.checked_sub(1)?)?, voyage.truth.get(next)?);
    let (first, second) = (one.attitude?, other.attitude?);
    let length = (other.time - one.time).as_seconds();
    let share = (time - one.time).as_seconds() / length;
    let between = |one: f64, other: f64| one + share * wrap_pi(other - one);
    Some([
        between(first.roll, second.roll),
        between(first.pitch, second.pitch),
        between(first.heading, second.heading),
        wrap_pi(second.heading - first.heading) / length,
    ])
}

/// Every sentence of a port at 50 Hz with the instant it is valid at. The port speaks just before the
/// next IMU sample comes: what it knows is as old as it gets.
fn said(voyage: &Voyage, kinds: &[&str]) -> Vec<(Time, Sentence)> {
    let rate = Rate::from_hertz(50.0);
    let messages = kinds.iter().map(|kind| (MessageKind::named(kind).unwrap(), rate)).collect();
    let port = OutputPortConfig { messages, ..OutputPortConfig::default() };
    let mut outputs = Outputs::new(OutputPlan {
        ports: vec![port],
        points: vec![Body::default()],
        ..OutputPlan::default()
    });
    let mut engine = Engine::new(EngineConfig::for_voyage(&voyage.header, 10.0));
    let start = UtcTime::from_civil((2026, 1, 1), (0, 0, 0), 3_000_000).unwrap();
    let mut sentences = Vec::new();
    for received in voyage.received() {
        let now = received.receipt;
        outputs.speak(&engine, now, Some(start.plus(now - Time::START)), |spoken| {
            let Spoken::Messages(_, messages) = spoken else { return };
            for message in messages {
                let bytes = message.content.to_bytes();
                sentences.push((message.valid, Sentence::read(&bytes).unwrap().1));
            }
        });
        engine.handle(&received);
        while engine.poll_output().is_some() {}
    }
    sentences
}

#[test]
fn in_a_turn_of_20_deg_per_second_the_heading_told_lags_by_less_than_a_tenth_of_a_degree() {
    let voyage = simulate(&Scenario::from_toml(TURNING).unwrap(), 1);
    let (mut turning, mut steady) = ((0, 0.0), (0, 0.0));
    for (valid, sentence) in said(&voyage, &["HDT", "THS"]) {
        let heading = match sentence {
            Sentence::Hdt(hdt) => hdt.heading,
            Sentence::Ths(ths) => ths.heading,
            _ => None,
        };
        let Some(truth) = truth_at(&voyage, valid).filter(|_| valid.as_seconds() > 200.0) else {
            continue;
        };
        // late is positive, whichever way she turns
        let late = wrap_pi(truth[2] - heading.unwrap()) * truth[3].signum() / DEG;
        let (count, sum) = if truth[3].abs() > 15.0 * DEG { &mut turning } else { &mut steady };
        *count += 1;
        *sum += if truth[3].abs() > 15.0 * DEG { late } else { late.abs() };
    }
    let mean = |(count, sum): (u32, f64)| sum / f64::from(count.max(1));
    figure!("{turning:?} lag {:.4} deg, elsewhere off by {:.4}", mean(turning), mean(steady));
    assert!(turning.0 > 500, "{turning:?}");
    assert!(mean(turning).abs() < 0.1, "{:.3} deg behind", mean(turning));
}
