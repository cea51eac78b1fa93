//! What the alignment says of itself: when it will be done, why not sooner, what it cannot do, the sea.

use insd_alignment::AlignmentConfig;
use insd_base::units::DEG;
use insd_base::{AlignmentPhase, AlignmentStatus, Event, Forecast, Lack, Limiting, StartCondition};
use insd_engine::EngineConfig;
use insd_nav::berth::Method;
use insd_simulator::{Scenario, simulate};
use insd_tests::sailing::{
    Logbook, OUTPUT_RATE, Passage, sail, sail_aligned, sail_all, sail_messages, sail_voyage,
};
use insd_tests::{scenario, variant};

use super::figure;

/// The first status at or after an instant, s.
fn status_at(log: &Logbook, seconds: f64) -> AlignmentStatus {
    *log.alignment.iter().find(|status| status.time.as_seconds() >= seconds).unwrap()
}

/// When the claimed heading sigma first was below a bar, s.
fn claimed(log: &Logbook, bar: f64) -> f64 {
    let first = log.solutions.iter().find(|solution| solution.sigma.heading < bar);
    first.unwrap().time.as_seconds()
}

#[test]
fn after_two_minutes_it_says_when_the_heading_will_be_good() {
    for number in [8, 22, 24] {
        for passage in sail_all(&scenario(number).with_duration(480.0), 0..2) {
            let said = status_at(&passage.log, 120.0);
            let Forecast::Expected { at, limiting } = said.ready else {
                panic!("s{number:02}: {said}");
            };
            let actual = claimed(&passage.log, said.target.unwrap());
            figure!("s{number:02} {at:?} {limiting:?}, in fact {actual} s");
            assert!((at.as_seconds() / actual - 1.0).abs() < 0.25, "s{number:02}: {said}");
            let last = passage.log.alignment.last().unwrap();
            assert_eq!(last.phase, AlignmentPhase::Aligned);
            assert!((last.ready.ready_at().unwrap().as_seconds() - actual).abs() < 2.0);
        }
    }
}

#[test]
fn where_the_sea_is_learnt_as_an_autoregression_it_says_so_too() {
    let voyage = simulate(&scenario(7).with_duration(360.0), 1);
    let alignment =
        AlignmentConfig { moored: Method::Autoregressive, ..AlignmentConfig::default() };
    let log = sail_aligned(&voyage, &alignment);
    let said = status_at(&log, 120.0);
    let Forecast::Expected { at, .. } = said.ready else { panic!("{said}") };
    let actual = claimed(&log, said.target.unwrap());
    figure!("{at:?}, in fact {actual} s");
    assert!((at.as_seconds() / actual - 1.0).abs() < 0.25, "{said}");
    let sway = said.sea.and_then(|sea| sea.sway_std).unwrap();
    assert!((0.15..0.6).contains(&sway), "{sway} m");
}

#[test]
fn gyros_too_coarse_for_the_accuracy_are_named_with_what_they_can_do() {
    let passage = sail(&scenario(9).with_duration(200.0), 1);
    assert!(passage.log.alignment.len() > 10);
    for status in &passage.log.alignment {
        let Forecast::Unreachable { best, limiting } = status.ready else { panic!("{status}") };
        assert_eq!(limiting, Limiting::GyroBias);
        assert!((2.2..2.6).contains(&(best / DEG)), "{status}");
        assert!(status.can_gyrocompass());
    }
}

fn at_latitude(degrees: &str, grade: &str) -> Scenario {
    let (place, imu) = (format!("lat_deg = {degrees}"), format!("grade = \"{grade}\""));
    variant(7, &[("lat_deg = 35.0", &place), ("grade = \"navigation\"", &imu)]).with_duration(60.0)
}

#[test]
fn near_a_pole_it_says_that_there_is_no_gyrocompassing() {
    for (latitude, grade) in [("89.8", "navigation"), ("-88.0", "tactical")] {
        let passage = sail(&at_latitude(latitude, grade), 1);
        for status in &passage.log.alignment {
            assert!(!status.can_gyrocompass(), "{status}");
            let unreachable =
                matches!(status.ready, Forecast::Unreachable { limiting: Limiting::Latitude, .. });
            assert!(unreachable && status.to_string().contains("not possible (latitude)"));
        }
    }
    let passage = sail(&at_latitude("88.0", "navigation"), 1);
    assert!(passage.log.alignment.iter().all(AlignmentStatus::can_gyrocompass));
}

#[test]
fn period_and_height_of_the_sea_are_those_of_the_true_motion() {
    for number in [7, 8, 17, 18] {
        let passage = sail(&scenario(number).with_duration(420.0), 2);
        let sea = passage.log.alignment.last().unwrap().sea.unwrap();
        let (period, height) = true_heave(&passage);
        let (found, heave) = (sea.period, sea.significant_heave);
        figure!("s{number:02} {found:?} s of {period:.2} s, {heave:.3} m of {height:.3} m");
        assert!((heave - height).abs() < 0.2 * height + 0.01, "s{number:02}: {sea:?}");
        // a heave of a few millimetres has no period
        let close = |found: f64| (found / period - 1.0).abs() < 0.2;
        assert!(found.map_or(number == 17, close), "s{number:02}: {sea:?}, not {period} s");
    }
}

/// Mean zero-crossing period, s, and significant height of the true heave, m.
fn true_heave(passage: &Passage) -> (f64, f64) {
    let heights: Vec<f64> = passage.voyage.truth.iter().map(|t| t.position.height).collect();
    let mean = heights.iter().sum::<f64>() / heights.len() as f64;
    let variance = heights.iter().map(|h| (h - mean).powi(2)).sum::<f64>() / heights.len() as f64;
    let crossings = heights.windows(2).filter(|w| w[0] < mean && w[1] >= mean).count();
    let length = passage.voyage.truth.last().unwrap().time.as_seconds();
    (length / crossings as f64, 4.0 * variance.sqrt())
}

#[test]
fn a_ship_that_leaves_her_berth_is_told_once() {
    let passage = sail(&scenario(23), 1);
    let left: Vec<f64> = passage
        .log
        .events
        .iter()
        .filter_map(|event| match event {
            Event::LeftBerth { time } => Some(time.as_seconds()),
            _ => None,
        })
        .collect();
    figure!("left at {left:?}");
    assert_eq!(left.len(), 1, "{left:?}");
}

#[test]
fn under_way_it_says_what_the_heading_lacks() {
    let voyage = simulate(&scenario(10).with_duration(120.0), 1);
    let with_gnss = sail_voyage(&voyage);
    let first = with_gnss.alignment.iter().find(|s| s.phase == AlignmentPhase::InMotion).unwrap();
    assert_eq!(first.ready, Forecast::Unknown { lacks: Lack::Manoeuvres });
    let mut config = EngineConfig::for_voyage(&voyage.header, OUTPUT_RATE);
    assert_eq!(config.start, StartCondition::Underway);
    config.initial = voyage.truth.first().map(|truth| truth.position);
    let alone: Vec<_> = voyage
        .received()
        .into_iter()
        .filter(|received| matches!(received.message, insd_base::Message::Imu(_)))
        .collect();
    let log = sail_messages(&config, &alone, 1);
    let last = log.alignment.last().unwrap();
    assert_eq!((last.phase, last.moored), (AlignmentPhase::InMotion, false));
    assert_eq!(last.ready, Forecast::Unknown { lacks: Lack::Aid }, "{last}");
}

#[test]
fn while_it_aligns_it_speaks_every_ten_seconds_and_then_no_more() {
    let log = sail(&scenario(17).with_duration(400.0), 1).log;
    let times: Vec<f64> = log.alignment.iter().map(|s| s.time.as_seconds()).collect();
    let mut phases: Vec<_> = log.alignment.iter().map(|s| s.phase).collect();
    phases.dedup();
    let expected = [
        AlignmentPhase::Levelling,
        AlignmentPhase::Searching,
        AlignmentPhase::Fine,
        AlignmentPhase::Aligned,
    ];
    assert_eq!(phases, expected);
    assert!(times.windows(2).all(|pair| pair[1] - pair[0] < 11.1), "{times:?}");
    assert!(log.alignment.len() < 30);
}
