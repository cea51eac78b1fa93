use super::*;
use insd_base::units::DEG;
use insd_base::{Attitude, Body, Judgement, Mode, Ned, Protection, Solution, SolutionSigma};

const OWN: f64 = 40.0 * DEG;

fn plan(sensor: usize, name: &str) -> WatchPlan {
    WatchPlan {
        sensor,
        name: name.to_owned(),
        lever: Body::default(),
        limits: WatchLimits { heading: 1.5 * DEG, position: 50.0, attitude: 1.0 * DEG },
        attitude_std: 0.1 * DEG,
        smooth: Span::from_seconds(3.0),
        hold: Span::from_seconds(3.0),
    }
}

/// Two gyrocompasses and a receiver of others.
fn watch() -> ReferenceWatch {
    ReferenceWatch::new(vec![plan(4, "gyro 1"), plan(7, "gyro 2"), plan(9, "ecdis")])
}

fn motion(seconds: f64, mode: Mode, sigma: f64) -> Motion {
    let sigma = SolutionSigma {
        heading: sigma,
        position: Ned::new(2.0, 2.0, 4.0),
        ..SolutionSigma::default()
    };
    let solution = Solution {
        time: Time::from_seconds(seconds),
        position: Geodetic::from_degrees(35.0, 139.0, 40.0),
        velocity: Ned::new(3.0, 4.0, 0.0),
        attitude: Attitude { roll: 0.0, pitch: 0.0, heading: OWN },
        rate: Body::default(),
        sigma,
        mode,
        judgement: Judgement::default(),
        source: None,
        hidden: Protection::default(),
    };
    Motion { solution, acceleration: None, covariance: None, current: None }
}

/// What has changed, and when, while compasses say so much more than we do, each once a second but not at the same time.
fn told(
    watch: &mut ReferenceWatch,
    seconds: std::ops::Range<u32>,
    own: impl Fn(f64) -> Option<Motion>,
    errors: &[(usize, f64)],
) -> Vec<(f64, String)> {
    let mut all = Vec::new();
    for tenth in seconds.start * 10..seconds.end * 10 {
        let now = f64::from(tenth) / 10.0;
        watch.look(
            Time::from_seconds(now),
            || own(now),
            |change| {
                all.push((now, change.comparison.to_string()));
            },
        );
        for (sensor, error) in errors {
            if (tenth as usize + sensor).is_multiple_of(10) {
                let value = WatchedValue::Heading(OWN + error * DEG);
                let time = Time::from_seconds(now);
                let told = Watched { sensor: *sensor, time, value, std: Some(0.5 * DEG) };
                watch.hear(&told, own(now).as_ref());
            }
        }
    }
    all
}

fn aligned(now: f64) -> Option<Motion> {
    Some(motion(now, Mode::Aided, 0.1 * DEG))
}

fn text(watch: &ReferenceWatch, seconds: f64) -> Option<String> {
    let now = Time::from_seconds(seconds);
    watch.contradicted(now).heading.map(|text| text.to_string())
}

#[test]
fn of_two_compasses_two_degrees_apart_the_wrong_one_is_named_within_ten_seconds() {
    let mut watch = watch();
    assert_eq!(told(&mut watch, 0..60, aligned, &[(4, 0.1), (7, 0.0)]), []);
    assert_eq!(text(&watch, 60.0), None);
    let changes = told(&mut watch, 60..80, aligned, &[(4, 0.1), (7, 2.1)]);
    let lines: Vec<&str> = changes.iter().map(|(_, line)| line.as_str()).collect();
    assert_eq!(changes.len(), 2, "{changes:?}");
    assert!(changes.iter().all(|(at, _)| *at < 70.0), "{changes:?}");
    assert!(lines.iter().all(|line| line.ends_with("gyro 2 is wrong")), "{lines:?}");
    assert!(lines.iter().any(|line| line.starts_with("heading: gyro 1 and gyro 2 differ by")));
    assert!(lines.iter().any(|line| line.starts_with("heading: gyro 2 and insd differ by")));
    assert_eq!(text(&watch, 80.0).as_deref(), Some("gyro 2 wrong. Do not use"));
    let [over, ..] = &told(&mut watch, 80..120, aligned, &[(4, 0.1), (7, 0.1)])[..] else {
        unreachable!("it is not over")
    };
    assert!(over.1.ends_with("agree again"), "{over:?}");
    assert_eq!(text(&watch, 120.0), None);
}

#[test]
fn before_she_is_aligned_two_contradict_and_neither_is_named() {
    let mut watch = watch();
    let unaligned = |now| Some(motion(now, Mode::InMotionAlignment, 0.1 * DEG));
    let changes = told(&mut watch, 0..20, unaligned, &[(4, 0.0), (7, 2.0)]);
    assert_eq!(changes.len(), 1, "{changes:?}");
    assert!(changes[0].0 < 10.0 && changes[0].1.ends_with("who is wrong is not known"));
    assert_eq!(text(&watch, 20.0).as_deref(), Some("gyro 1 and gyro 2 differ"));
    let changes = told(&mut watch, 20..40, aligned, &[(4, 0.0), (7, 2.0)]);
    assert!(changes.iter().any(|(_, line)| line.ends_with("gyro 2 is wrong")), "{changes:?}");
    assert_eq!(text(&watch, 40.0).as_deref(), Some("gyro 2 wrong. Do not use"));
}

#[test]
fn who_claims_less_than_the_difference_is_no_evidence_against_a_compass() {
    let mut watch = watch();
    let unsure = |now| Some(motion(now, Mode::DeadReckoning, 1.0 * DEG));
    assert_eq!(told(&mut watch, 0..60, unsure, &[(4, 2.5)]), []);
    let comparison = &watch.comparisons(Time::from_seconds(60.0))[0];
    assert!((comparison.difference / DEG - 2.5).abs() < 1e-6 && !comparison.differ);
    assert!((comparison.sigma / DEG - 1.0_f64.hypot(0.5)).abs() < 1e-6);
}

#[test]
fn two_compasses_that_agree_against_us_are_told_and_nobody_is_named() {
    let mut watch = watch();
    let changes = told(&mut watch, 0..20, aligned, &[(4, 4.0), (7, 4.3)]);
    assert_eq!(changes.len(), 2, "{changes:?}");
    assert!(changes.iter().all(|(_, line)| line.ends_with("who is wrong is not known")));
}

#[test]
fn what_falls_silent_is_compared_no_more_and_its_alert_ends() {
    let mut watch = watch();
    told(&mut watch, 0..20, aligned, &[(4, 4.0)]);
    assert!(text(&watch, 20.0).is_some());
    told(&mut watch, 20..30, aligned, &[]);
    assert_eq!((text(&watch, 30.0), watch.comparisons(Time::from_seconds(30.0)).len()), (None, 0));
}

#[test]
fn north_is_no_seam_and_a_compass_that_is_late_in_a_turn_is_not_wrong() {
    let mut watch = watch();
    let turning = |now: f64| {
        let mut own = motion(now, Mode::Aided, 0.1 * DEG);
        own.solution.attitude.heading = insd_base::units::wrap_two_pi(3.0 * DEG * now);
        own.solution.rate.0.z = 3.0 * DEG;
        Some(own)
    };
    let mut changes = 0;
    for tenth in 0..3000 {
        let now = f64::from(tenth) / 10.0;
        let time = Time::from_seconds(now);
        watch.look(time, || turning(now), |_| changes += 1);
        // half a second behind: 1.5 deg
        for sensor in [4, 7] {
            let value =
                WatchedValue::Heading(turning(now - 0.5).unwrap().solution.attitude.heading);
            let told = Watched { sensor, time, value, std: Some(0.5 * DEG) };
            watch.hear(&told, turning(now).as_ref());
        }
    }
    assert_eq!(changes, 0);
}

#[test]
fn positions_are_compared_where_their_antennas_are() {
    let mut watch = ReferenceWatch::new(vec![WatchPlan {
        lever: Body::new(80.0, 0.0, 0.0),
        ..plan(9, "ecdis")
    }]);
    let ahead = |now: f64| aligned(now).unwrap().at_point(&Body::new(80.0, 0.0, 0.0));
    for tenth in 0..200 {
        let now = f64::from(tenth) / 10.0;
        let time = Time::from_seconds(now);
        let value = WatchedValue::Position(ahead(now).solution.position);
        watch.hear(&Watched { sensor: 9, time, value, std: Some(10.0) }, aligned(now).as_ref());
        watch.look(time, || aligned(now), |change| unreachable!("{change:?}"));
    }
    let found = &watch.comparisons(Time::from_seconds(20.0))[0];
    assert!(found.difference < 0.01 && found.quantity == WatchQuantity::Position, "{found:?}");
}

#[test]
fn a_ship_that_doubts_herself_names_nobody() {
    let mut watch = watch();
    let doubting = |now| {
        let mut own = motion(now, Mode::Aided, 0.1 * DEG);
        own.solution.judgement =
            Judgement { integrity: Integrity::Contradiction, ..Judgement::default() };
        Some(own)
    };
    let changes = told(&mut watch, 0..20, doubting, &[(4, 0.0), (7, 2.0)]);
    assert_eq!(changes.len(), 1);
    assert!(changes[0].1.ends_with("who is wrong is not known"));
}
