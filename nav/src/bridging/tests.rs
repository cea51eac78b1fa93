//! Bridges over motions of which the truth is known.

use std::f64::consts::TAU;

use super::*;

const STEP: f64 = 0.01;

/// A ship that rolls and yaws: rate about forward and down at an instant, rad/s.
fn rolling(t: f64) -> Vector3<f64> {
    let roll = 0.10 * (TAU / 9.0 * t).cos() + 0.04 * (TAU / 7.1 * t + 1.0).cos();
    Vector3::new(roll, 0.0, 0.01 * (TAU / 13.0 * t).sin())
}

fn moment(t: f64, rate: &impl Fn(f64) -> Vector3<f64>) -> Moment {
    Moment { rate: rate(t), force: Vector3::new(0.0, 0.0, -9.8) }
}

/// What is learnt of a motion up to an instant.
fn learnt(until: f64, rate: impl Fn(f64) -> Vector3<f64>) -> Bridging {
    let mut bridging = Bridging::default();
    for step in 0..(until / STEP).round() as i64 {
        let (from, to) = (STEP * step as f64, STEP * (step + 1) as f64);
        let middle = moment(0.5 * (from + to), &rate);
        let increment = Increment {
            from: Time::from_seconds(from),
            to: Time::from_seconds(to),
            rotation: middle.rate * STEP,
            velocity: middle.force * STEP,
            end_rate: middle.rate,
            end_rate_variance: 0.0,
            angular_acceleration: Vector3::zeros(),
            rate_noise: Vector3::zeros(),
            force_noise: Vector3::zeros(),
            bridged: None,
            celsius: None,
        };
        bridging.learn(&increment, &middle);
    }
    bridging
}

/// The true rotation about each axis, one at a time: exact where one of them is small.
fn truth(from: f64, length: f64, rate: impl Fn(f64) -> Vector3<f64>) -> Vector3<f64> {
    let steps = (length / STEP).round() as i64;
    (0..steps).map(|step| rate(from + STEP * (step as f64 + 0.5)) * STEP).sum()
}

fn bridge(
    bridging: &Bridging,
    from: f64,
    length: f64,
    rate: impl Fn(f64) -> Vector3<f64>,
) -> Bridge {
    let (before, after) = (moment(from, &rate), moment(from + length, &rate));
    bridging.bridge(Time::from_seconds(from), length, &before, &after)
}

#[test]
fn what_was_learnt_bridges_a_swing_far_better_than_the_mean_of_the_ends() {
    for length in [0.5, 1.0, 2.0, 4.5, 9.0] {
        let (mut square, mut plain, mut claimed) = (0.0, 0.0, 0.0);
        for start in 0..20 {
            let from = 150.0 + 1.7 * f64::from(start);
            let bridging = learnt(from, rolling);
            let made_up = bridge(&bridging, from, length, rolling);
            let truth = truth(from, length, rolling).x;
            let mean = (rolling(from).x + rolling(from + length).x) * 0.5 * length;
            square += (made_up.rotation.x - truth).powi(2);
            plain += (mean - truth).powi(2);
            claimed += made_up.rotation_variance.x;
        }
        let ratio = (square / claimed).sqrt();
        assert!(square < 0.5 * plain, "{length} s: {square:e} of {plain:e}");
        assert!((0.2..1.5).contains(&ratio), "{length} s: {ratio}");
    }
}

#[test]
fn a_calm_is_bridged_with_little_doubt_and_the_unknown_with_much() {
    let calm = learnt(150.0, |_| Vector3::zeros());
    let still = |_| Vector3::zeros();
    let known = bridge(&calm, 150.0, 2.0, still).rotation_variance.map(f64::sqrt);
    assert!(known.xy().max() < 1e-6 && known.z < 2e-3, "{known}");
    let unknown = bridge(&Bridging::default(), 0.0, 2.0, still).rotation_variance.map(f64::sqrt);
    assert!(unknown.min() > 0.09, "{unknown}");
}

#[test]
fn a_turn_that_begins_in_the_gap_is_covered() {
    let calm = learnt(150.0, |_| Vector3::zeros());
    for begins in [0.0, 1.0, 2.5, 4.0, 4.9] {
        let turning = |t: f64| Vector3::new(0.0, 0.0, if t > 150.0 + begins { 0.035 } else { 0.0 });
        let made_up = bridge(&calm, 150.0, 5.0, turning);
        let error = made_up.rotation.z - truth(150.0, 5.0, turning).z;
        let sigma = made_up.rotation_variance.z.sqrt();
        assert!(error.abs() < 2.0 * sigma && sigma < 0.15, "{begins} s: {error} of {sigma}");
    }
}

#[test]
fn what_is_kept_bridges_as_what_it_was_taken_from() {
    let bridging = learnt(150.0, rolling);
    let last = Time::from_seconds(150.0);
    let kept = bridging.kept(last, &moment(150.0, &rolling));
    assert!(kept.is_finite());
    let (one, other) = (bridge(&bridging, 150.0, 3.0, rolling), bridge(&kept, 150.0, 3.0, rolling));
    assert_eq!(one, other);
}

#[test]
fn longer_gaps_add_more() {
    let bridging = learnt(150.0, rolling);
    let std = |length: f64| bridging.rotation_variance(length).x;
    for length in [0.01, 0.1, 0.25, 0.4, 0.9] {
        assert!(std(1.5 * length) > std(length), "{length}");
    }
    assert!(std(60.0) > std(30.0));
}
