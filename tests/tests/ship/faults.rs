//! Bad GNSS, a filter that got lost, bad IMU data, bad standard deviations.

use insd_base::{Event, GnssFix, Mode, Ned, Rejection, Time, Voyage};
use insd_simulator::simulate;
use insd_tests::sailing::{sail, sail_all, sail_voyage};
use insd_tests::scores::{Scores, pooled};
use insd_tests::{scenario, variant};

use super::figure;

#[test]
fn s05_jumps_and_spikes_and_spoofing_are_refused_with_a_reason_and_never_believed() {
    let shortened = [
        ("count = 18, window_s = [850.0, 3500.0]", "count = 6, window_s = [700.0, 1100.0]"),
        ("count = 6, window_s = [850.0, 2350.0]", "count = 2, window_s = [500.0, 700.0]"),
        ("at_s = [2400.0]", "at_s = [1200.0]"),
    ];
    let passages = sail_all(&variant(5, &shortened).with_duration(1500.0), 0..2);
    for passage in &passages {
        let scores = passage.scores_from(450.0);
        let log = &passage.log;
        figure!("s05 {:?} {:?}", scores.horizontal(), log.counts.rejected);
        assert!(scores.horizontal().max < 8.0, "{:?}", scores.horizontal());
        assert!(log.rejected_for("gnss_position", Rejection::DopTest) >= 6, "{:?}", log.counts);
        let told = log.events.iter().filter(|e| matches!(e, Event::Rejected { .. })).count();
        assert_eq!(told as u64, log.counts.rejected_total());
        assert!(!log.events.iter().any(|e| matches!(e, Event::PositionReset { .. })));
        assert_eq!(log.mode_at(1490.0), Some(Mode::Aided));
    }
}

#[test]
fn after_a_long_outage_a_filter_that_went_astray_takes_gnss_again_within_seconds() {
    let lost = [
        (
            "when = { at_s = [2064.5] }\nduration_s = 60.0",
            "when = { at_s = [1300.5] }\nduration_s = 1200.0",
        ),
        ("\n[log]\n", "\n"),
    ];
    let passages = sail_all(&variant(3, &lost).with_duration(2700.0), 0..3);
    for passage in &passages {
        let astray = passage.scores_between(2490.0, 2500.0).horizontal();
        let last = passage.log.solutions.iter().rfind(|s| s.mode == Mode::Inertial);
        let aided_at = last.unwrap().time.as_seconds();
        figure!("lock-out {astray:?} back at {aided_at}");
        assert!(astray.rms > 100.0, "no test of anything: {astray:?}");
        assert!(aided_at < 2510.0, "still inertial at {aided_at} s");
        let found = passage.scores_from(2515.0).horizontal();
        assert!(found.max < 10.0, "{found:?}");
    }
}

#[test]
fn s16_gaps_and_duplicates_of_the_imu_are_counted_one_by_one_and_bridged() {
    let shortened = [
        ("count = 30, window_s = [100.0, 1700.0]", "count = 20, window_s = [100.0, 800.0]"),
        ("count = 50, window_s = [50.0, 1750.0]", "count = 30, window_s = [50.0, 850.0]"),
    ];
    let passages = sail_all(&variant(16, &shortened).with_duration(900.0), 0..2);
    for passage in &passages {
        let (counts, expected) = (&passage.log.counts, LineFaults::of(&passage.voyage));
        figure!("s16 {expected:?} {:?}", passage.scores_from(400.0).horizontal());
        assert_eq!(counts.imu_gaps, expected.gaps);
        assert_eq!(counts.imu_duplicates, expected.duplicates);
        assert_eq!(counts.imu_samples, expected.samples);
        assert_eq!((counts.imu_out_of_order, counts.imu_out_of_range), (0, 0));
        let told = passage.log.events.iter().filter(|e| matches!(e, Event::ImuGap { .. }));
        assert_eq!(told.count() as u64, expected.gaps);
    }
    let scores: Vec<Scores> = passages.iter().map(|p| p.scores_from(400.0)).collect();
    let all = pooled(&scores).horizontal();
    assert!(all.rms < 2.0, "{all:?}");
}

/// What the simulator did to the samples, read off the 100 Hz grid on which they were due.
#[derive(Debug, PartialEq)]
struct LineFaults {
    gaps: u64,
    duplicates: u64,
    samples: u64,
}

impl LineFaults {
    fn of(voyage: &Voyage) -> Self {
        let due = |time: Time| (time.as_seconds() * 100.0).round() as i64;
        let places: Vec<i64> = voyage.imu.iter().map(|sample| due(sample.message.time)).collect();
        let steps = || places.windows(2).map(|pair| pair[1] - pair[0]);
        let duplicates = steps().filter(|step| *step == 0).count() as u64;
        LineFaults {
            gaps: steps().filter(|step| *step > 1).count() as u64,
            duplicates,
            samples: places.len() as u64 - duplicates,
        }
    }
}

/// The same voyage whose receiver states something else about its own errors.
fn stating(voyage: &Voyage, state: impl Fn(&mut GnssFix)) -> Voyage {
    let mut other = voyage.clone();
    for fix in &mut other.gnss {
        state(&mut fix.message);
    }
    other
}

#[test]
fn standard_deviations_that_are_zero_missing_or_absurd_are_replaced_and_counted() {
    let voyage = simulate(&scenario(10).with_duration(400.0), 1);
    let fixes = voyage.gnss.len() as u64;
    let honest = sail_voyage(&voyage);
    assert_eq!((honest.floored("gnss_position"), honest.floored("gnss_velocity")), (0, 0));
    let all = |sigma: f64| Some(Ned::new(sigma, sigma, sigma));
    for sigma in [None, all(0.0), all(-1.0), all(f64::NAN), all(f64::INFINITY), all(1e7)] {
        let log = sail_voyage(&stating(&voyage, |fix| {
            (fix.position_std, fix.velocity_std) = (sigma, sigma);
        }));
        assert_eq!(log.floored("gnss_position"), fixes, "{sigma:?}");
        assert_eq!(log.floored("gnss_velocity"), fixes, "{sigma:?}");
        let passage = insd_tests::sailing::Passage { voyage: voyage.clone(), log };
        let error = passage.scores_from(300.0).horizontal();
        figure!("sigmas {sigma:?} {error:?}");
        let bound = if sigma == all(1e7) { 1000.0 } else { 8.0 };
        assert!(error.max < bound, "{sigma:?} {error:?}");
    }
}

#[test]
fn a_receiver_without_velocity_still_aids() {
    let mut voyage = simulate(&scenario(10).with_duration(600.0), 1);
    for fix in &mut voyage.gnss {
        fix.message.velocity = None;
    }
    let log = sail_voyage(&voyage);
    assert_eq!(log.accepted("gnss_velocity"), 0);
    assert!(log.accepted("gnss_position") > 500, "{:?}", log.counts);
}

#[test]
fn a_voyage_sailed_twice_in_one_thread_or_in_two_counts_the_same() {
    let scenario = scenario(5).with_duration(120.0);
    let alone = sail(&scenario, 1).log.counts;
    let together = sail_all(&scenario, 1..3);
    assert_eq!(together[0].log.counts, alone);
}
