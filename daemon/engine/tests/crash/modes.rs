//! The mode and its reasons, from the first sample to a ship that has been resumed.

use insd_base::{Event, Message, Mode, ModeReason, Received, Time};
use insd_engine::{Engine, EngineConfig, Output};
use insd_simulator::simulate;

use crate::voyages::{RATE, Way, scenario, watch};

type Change = (f64, Option<Mode>, Mode, ModeReason);

/// Changes of the mode, each with the one before it.
fn changes(events: impl IntoIterator<Item = Event>) -> Vec<Change> {
    let change = |event| match event {
        Event::ModeChanged { time, from, to, why } => Some((time.as_seconds(), from, to, why)),
        _ => None,
    };
    let changes: Vec<Change> = events.into_iter().filter_map(change).collect();
    for pair in changes.windows(2) {
        assert_eq!(pair[1].1, Some(pair[0].2), "{changes:?}");
        assert!(pair[0].0 <= pair[1].0, "{changes:?}");
    }
    changes
}

fn sail(way: Way, keep: impl Fn(&Received) -> bool) -> (Vec<Change>, Engine) {
    let voyage = simulate(&scenario(way, 3, "navigation", 420.0), 3);
    let mut engine = Engine::new(EngineConfig::for_voyage(&voyage.header, RATE));
    assert_eq!(engine.mode(), Mode::Standby);
    let mut events = Vec::new();
    for received in voyage.received().iter().filter(|received| keep(received)) {
        engine.handle(received);
        while let Some(output) = engine.poll_output() {
            match output {
                Output::Event(event) => events.push(event),
                Output::Solution(solution) => assert_ne!(solution.mode, Mode::Standby),
                _ => {}
            }
        }
    }
    (changes(events), engine)
}

fn is_between(received: &Received, from: f64, to: f64) -> bool {
    (Time::from_seconds(from)..Time::from_seconds(to)).contains(&received.receipt)
}

#[test]
fn a_voyage_tells_why_each_mode_came() {
    let (changes, engine) = sail(Way::Steady, |received| {
        let imu = matches!(received.message, Message::Imu(_));
        !(is_between(received, 330.0, 333.5) && imu || is_between(received, 380.0, 395.0) && !imu)
    });
    let told: Vec<_> = changes.iter().map(|(_, _, to, why)| (*to, *why)).collect();
    let expected = [
        (Mode::CoarseAlignment, ModeReason::ImuHeard),
        (Mode::InMotionAlignment, ModeReason::Level),
        (Mode::Aided, ModeReason::HeadingSettled),
        (Mode::Standby, ModeReason::ImuSilent),
        (Mode::Aided, ModeReason::ImuHeard),
        (Mode::Inertial, ModeReason::GnssLost),
        (Mode::Aided, ModeReason::GnssInUse),
    ];
    assert_eq!(told, expected, "{changes:?}");
    assert_eq!(changes[0].1, None);
    assert!(changes[0].0 < 0.1, "{changes:?}");
    assert!((332.0..333.5).contains(&changes[3].0), "{changes:?}");
    assert_eq!(engine.mode(), Mode::Aided);
}

#[test]
fn a_long_silence_of_the_imu_starts_over_and_says_so() {
    let (changes, _) = sail(Way::Steady, |received| {
        !(is_between(received, 300.0, 370.0) && matches!(received.message, Message::Imu(_)))
    });
    let told: Vec<_> = changes.iter().map(|(_, _, to, why)| (*to, *why)).collect();
    let silent = (Mode::Standby, ModeReason::ImuSilent);
    let begun = (Mode::CoarseAlignment, ModeReason::GapTooLong);
    let place = told.iter().position(|change| *change == silent).unwrap();
    assert_eq!(told[place + 1], begun, "{changes:?}");
    assert_eq!(told[place + 2], (Mode::InMotionAlignment, ModeReason::Level));
}

#[test]
fn at_the_berth_the_heading_settles() {
    let (changes, engine) = sail(Way::Moored, |_| true);
    let told: Vec<_> = changes.iter().map(|(_, _, to, why)| (*to, *why)).collect();
    let expected =
        [(Mode::CoarseAlignment, ModeReason::ImuHeard), (Mode::FineAlignment, ModeReason::Level)];
    assert_eq!(told[..2], expected, "{changes:?}");
    let next = told.get(2).map(|(_, why)| *why);
    assert!(next.is_none_or(|why| why == ModeReason::HeadingSettled), "{changes:?}");
    let estimates = engine.estimates().unwrap();
    assert!(estimates.moored);
    let off = estimates.gyro_bias.0.component_div(&estimates.gyro_bias_sigma.0).amax();
    assert!(estimates.gyro_bias_sigma.0.min() > 0.0 && off < 4.0, "{estimates:?}");
}

#[test]
fn a_resumed_engine_says_so_and_has_its_mode_at_once() {
    let watched = watch(&scenario(Way::Steady, 3, "navigation", 480.0), 2, 400.0, 20.0);
    let after = watched.resume(&watched.kept[0], 1.0, 15.0).unwrap();
    let told = changes(after.events.iter().copied());
    assert_eq!(told.len(), 1, "{told:?}");
    assert_eq!((told[0].1, told[0].2, told[0].3), (None, Mode::Aided, ModeReason::Resumed));
    assert!(told[0].0 < 0.05, "{told:?}");
    let resumed = after.events.iter().find_map(|event| match event {
        Event::Resumed { time, gap } => Some((time.as_seconds(), *gap)),
        _ => None,
    });
    let (time, gap) = resumed.unwrap();
    assert!(time.abs() < 0.05 && (gap - 1.0).abs() < 0.05, "{time} {gap}");
}

#[test]
fn the_sea_is_a_spectrum_with_the_period_of_the_waves() {
    let voyage = simulate(&scenario(Way::Steady, 5, "navigation", 480.0), 3);
    let mut engine = Engine::new(EngineConfig::for_voyage(&voyage.header, 1.0));
    assert_eq!(engine.disturbance(), None);
    for received in &voyage.received() {
        engine.handle(received);
        while engine.poll_output().is_some() {}
    }
    let sea = engine.disturbance().unwrap();
    assert_eq!((sea.method, sea.interval), ("window", 0.5));
    assert!(!sea.coefficients.is_empty() && sea.coefficients.len().is_multiple_of(4));
    let peak = sea.spectrum.iter().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
    assert!((0.05..0.2).contains(&peak.0), "{peak:?}");
}
