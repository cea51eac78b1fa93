//! Compasses that are watched and not used, beside the ship that finds her heading.

use insd_base::units::DEG;
use insd_base::{Arrival, Body, Input, PortId, Span, Time, earth};
use insd_intake::config::{IntakeConfig, Kind, PortSpec, SensorConfig};
use insd_intake::port::Link;
use insd_output::alerts::Condition;
use insd_tests::engines::{Fleet, truth_at};
use insd_tests::feed::{LineSending, Reception, arrivals};
use insd_vessel::{Pipeline, Plan, Product, WatchLimits, WatchPlan};
use insd_wire::nmea::{AlertState, Hdt, Talker};

use super::fleet;

/// Names and ports of the compasses, behind those of IMU, receiver and log.
const COMPASSES: [(&str, usize); 2] = [("gyro 1", 3), ("gyro 2", 4)];

/// What the compasses send: the truth, what they are off, deg, and the last decimal of a sentence.
fn sentences(fleet: &Fleet, until: f64, off: impl Fn(usize, f64) -> f64) -> Vec<LineSending> {
    let mut all = Vec::new();
    for (number, (_, port)) in COMPASSES.iter().enumerate() {
        // one speaks once a second, the other four times
        let step = [1.0, 0.25][number];
        for count in 1..(until / step) as u32 {
            let at = f64::from(count) * step + 0.13;
            let Some((heading, _)) = truth_at(&fleet.voyage.truth, at) else { continue };
            let heading = Some(heading + off(number, at) * DEG);
            let line = Hdt { heading }.write(Talker::HE);
            let input = Input::Bytes(line.as_bytes().to_vec());
            all.push(LineSending { at: Time::from_seconds(at), port: *port, input });
        }
    }
    all.sort_by_key(|sending| sending.at);
    all
}

fn plan(fleet: &Fleet) -> Plan {
    let mut plan = fleet.plan();
    let IntakeConfig { ports, sensors, watched, .. } = &mut plan.intake;
    assert_eq!(sensors.len(), COMPASSES[0].1);
    for (name, index) in COMPASSES {
        ports.push(PortSpec { name: name.to_owned(), link: Link::Stream });
        sensors.push(SensorConfig {
            heading_std_deg: 0.5,
            ..SensorConfig::new(name, name, Kind::Compass)
        });
        watched.push(name.to_owned());
        plan.watched.push(WatchPlan {
            sensor: index,
            name: name.to_owned(),
            lever: Body::default(),
            limits: WatchLimits { heading: 1.5 * DEG, position: 100.0, attitude: DEG },
            attitude_std: 0.1 * DEG,
            smooth: Span::from_seconds(3.0),
            hold: Span::from_seconds(3.0),
        });
    }
    plan
}

/// What was told of the compasses, when, and what the alert said then; and when she began to navigate.
fn sail(until: f64, off: impl Fn(usize, f64) -> f64) -> Vec<(f64, String, Option<String>)> {
    let mut fleet = fleet().clone().until(until);
    fleet.imus.truncate(1);
    fleet.engines.truncate(1);
    let (mut all, reception): (Vec<Arrival>, Reception) = fleet.arrivals();
    all.extend(arrivals(&sentences(&fleet, until, off), &reception));
    all.sort_by_key(|arrival| arrival.stamp.monotonic);
    let mut pipeline = Pipeline::new(plan(&fleet), Fleet::reader());
    let mut told: Vec<(f64, String, Option<String>)> = Vec::new();
    let (mut news, mut is_up, mut navigates) = (Vec::new(), false, false);
    for arrival in all {
        let now = arrival.stamp;
        let at = (now.monotonic - reception.offset).as_seconds();
        let mut note = |product| {
            if let Product::Watch(change) = product {
                news.push((at, change.comparison.to_string()));
            }
        };
        pipeline.handle(&arrival, &mut note);
        if pipeline.wake_up(now.monotonic).is_some_and(|due| due.at <= now.monotonic) {
            let tick = Arrival { stamp: now, port: PortId(u16::MAX), input: Input::Tick };
            pipeline.handle(&tick, &mut note);
        }
        if !navigates && pipeline.mode().is_navigating() {
            navigates = true;
            told.push((at, "navigates".to_owned(), None));
        }
        told.extend(news.drain(..).map(|(at, line)| (at, line, None)));
        let board = pipeline.outputs().station().alerts();
        let up = board.state(Condition::HeadingMonitor) == AlertState::Unacknowledged;
        if up != is_up {
            is_up = up;
            let view = board.views().find(|view| view.identifier == 10_050).unwrap();
            told.push((at, format!("alert {up}"), Some(view.description.to_string())));
        }
    }
    println!("{told:#?}");
    told
}

#[test]
fn a_watched_compass_that_steps_by_two_degrees_is_named_within_ten_seconds_and_moves_nothing() {
    const STEP: f64 = 300.0;
    let told = sail(340.0, |number, at| if number == 1 && at > STEP { 2.1 } else { 0.1 });
    let after: Vec<_> = told.iter().filter(|(at, ..)| *at < STEP + 10.0).collect();
    assert!(
        told.iter().all(|(at, line, _)| *at > STEP || line == "navigates"),
        "there was nothing to tell before"
    );
    let is_told = |text: &str| after.iter().any(|(_, line, _)| line.contains(text));
    assert!(is_told("gyro 1 and gyro 2 differ") && is_told("gyro 2 and insd differ"));
    let lines = after.iter().filter(|(_, line, _)| line.contains("differ"));
    assert!(lines.clone().all(|(_, line, _)| line.ends_with("gyro 2 is wrong")));
    let alert = after.iter().find(|(_, line, _)| line == "alert true").unwrap();
    assert_eq!(alert.2.as_deref(), Some("gyro 2 wrong. Do not use"));
}

#[test]
fn while_she_seeks_her_heading_two_that_contradict_are_told_and_neither_is_named_before_she_knows()
{
    let told = sail(240.0, |number, _| if number == 1 { 2.1 } else { 0.1 });
    let (at, first, _) = &told[0];
    assert!(*at < 10.0 && first.ends_with("who is wrong is not known"), "{at} {first}");
    let named = told.iter().find(|(_, line, _)| line.ends_with("gyro 2 is wrong")).unwrap();
    let navigates = told.iter().find(|(_, line, _)| line == "navigates").unwrap();
    assert!(*at < navigates.0 && named.0 >= navigates.0, "{navigates:?} {named:?}");
    assert!(told.iter().all(|(_, line, _)| !line.ends_with("gyro 1 is wrong")));
}

#[test]
fn compasses_that_are_watched_have_no_part_in_the_solution() {
    let place = |off: f64| {
        let mut fleet = fleet().clone().until(120.0);
        fleet.imus.truncate(1);
        fleet.engines.truncate(1);
        let (mut all, reception) = fleet.arrivals();
        all.extend(arrivals(&sentences(&fleet, 120.0, |_, _| off), &reception));
        all.sort_by_key(|arrival| arrival.stamp.monotonic);
        let mut pipeline = Pipeline::new(plan(&fleet), Fleet::reader());
        all.iter().for_each(|arrival| pipeline.handle(arrival, |_| {}));
        let solution = pipeline.motion().unwrap().solution;
        (earth::ecef(&solution.position).0, solution.attitude)
    };
    assert_eq!(place(0.0), place(30.0));
}
