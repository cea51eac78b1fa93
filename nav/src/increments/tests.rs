//! Conditioning: what is told apart, and what coning and sculling leave.

use insd_base::{Body, Triad};
use nalgebra::UnitQuaternion;

use super::*;

fn imu(rate: f64) -> ImuSpec {
    let triad = Triad {
        bias_std: 1e-6,
        instability_std: 1e-7,
        instability_time: 100.0,
        random_walk: 1e-6,
        scale_std: 1e-5,
    };
    ImuSpec { rate, gyro: triad, accel: triad }
}

fn sample(time: f64, rate: f64) -> ImuSample {
    ImuSample {
        time: Time::from_seconds(time),
        delta_theta: Body::new(0.1 / rate, 0.0, 0.0),
        delta_velocity: Body::new(0.0, 0.0, -9.8 / rate),
    }
}

#[test]
fn duplicates_disorder_and_nonsense_are_told_apart() {
    let mut conditioner = Conditioner::new(&imu(100.0));
    assert!(matches!(conditioner.take(&sample(0.01, 100.0)), Conditioned::Sample(_)));
    let repeated = conditioner.take(&sample(0.01, 100.0));
    assert_eq!(repeated, Conditioned::Rejected(Rejection::Duplicate));
    let earlier = conditioner.take(&sample(0.005, 100.0));
    assert_eq!(earlier, Conditioned::Rejected(Rejection::OutOfOrder));
    let mut nonsense = sample(0.02, 100.0);
    nonsense.delta_theta = Body::new(f64::NAN, 0.0, 0.0);
    assert_eq!(conditioner.take(&nonsense), Conditioned::Rejected(Rejection::OutOfRange));
    assert!(matches!(conditioner.take(&sample(0.02, 100.0)), Conditioned::Sample(_)));
}

#[test]
fn a_gap_is_bridged_and_an_uneven_stamp_is_not_a_gap() {
    let mut conditioner = Conditioner::new(&imu(100.0));
    conditioner.take(&sample(0.01, 100.0));
    assert!(matches!(conditioner.take(&sample(0.022, 100.0)), Conditioned::Sample(_)));
    match conditioner.take(&sample(0.102, 100.0)) {
        Conditioned::AfterGap(bridge, after) => {
            assert_eq!(bridge.bridged, Some(bridge.duration()));
            assert_eq!(bridge.to, after.from);
            assert_eq!(after.to, Time::from_seconds(0.102));
            assert!((bridge.duration() + after.duration() - 0.08).abs() < 1e-9);
        }
        other => panic!("not a gap: {other:?}"),
    }
}

#[test]
fn a_late_stamp_costs_no_more_than_its_neighbours() {
    let mut conditioner = Conditioner::new(&imu(100.0));
    // stamped a ninth of an interval late, as may be the first after a restart: gravity seems to be a tenth less, which
    // is just no spike; in the next, as she rises, it is one
    let late = |k: u32| if k < 500 { 0.0 } else { 1.12e-3 };
    let force = |k: u32| if k <= 500 { 9.9 } else { 9.95 };
    let refused: Vec<u32> = (0..1000)
        .filter(|k| {
            let mut stamped = sample(0.01 * f64::from(*k) + late(*k), 100.0);
            stamped.delta_velocity = Body::new(0.0, 0.0, -force(*k) / 100.0);
            matches!(conditioner.take(&stamped), Conditioned::Rejected(_))
        })
        .collect();
    assert_eq!(refused, [501]);
}

#[test]
fn the_parts_of_a_split_increment_make_the_whole() {
    let mut conditioner = Conditioner::new(&imu(100.0));
    conditioner.take(&sample(0.01, 100.0));
    let Conditioned::Sample(whole) = conditioner.take(&sample(0.02, 100.0)) else {
        panic!("a sample")
    };
    let (head, tail) = whole.split(Time::from_seconds(0.013));
    assert_eq!((head.from, head.to, tail.to), (whole.from, tail.from, whole.to));
    assert!((head.rotation + tail.rotation - whole.rotation).norm() < 1e-18);
    assert!((head.velocity + tail.velocity - whole.velocity).norm() < 1e-15);
    assert_eq!(tail.end_rate, whole.end_rate);
}

/// Body rate of a coning motion of half-angle `a` at `w` rad/s, integrated over [t0, t1]: the body
/// axes nutate about a fixed cone and, apart from it, do not turn.
fn coning_increment(a: f64, w: f64, t0: f64, t1: f64) -> Vector3<f64> {
    // omega = [-w sin(a) sin(wt), w sin(a) cos(wt), 2 w sin(a/2)^2]
    let s = a.sin();
    Vector3::new(
        s * ((w * t1).cos() - (w * t0).cos()),
        s * ((w * t1).sin() - (w * t0).sin()),
        -2.0 * w * (0.5 * a).sin().powi(2) * (t1 - t0),
    )
}

/// Drift about the cone's axis after a minute of coning, rad.
fn coning_drift(intervals: &[f64], compensate: bool) -> f64 {
    let (a, w) = (0.5_f64.to_radians(), 2.0 * std::f64::consts::PI * 5.0);
    let attitude = |t: f64| {
        let axis = Vector3::new((w * t).cos(), (w * t).sin(), 0.0);
        UnitQuaternion::new(axis * a)
    };
    let mut conditioner = Conditioner::new(&imu(100.0));
    let mut time = 0.0;
    let mut q = attitude(0.0);
    for h in intervals.iter().cycle().take(6000) {
        let next = time + h;
        let delta_theta = coning_increment(a, w, time, next);
        let sample = ImuSample {
            time: Time::from_seconds(next),
            delta_theta: Body(delta_theta),
            delta_velocity: Body::default(),
        };
        let Conditioned::Sample(increment) = conditioner.take(&sample) else { panic!("a sample") };
        q *= UnitQuaternion::new(if compensate { increment.rotation } else { delta_theta });
        time = next;
    }
    (attitude(time).inverse() * q).scaled_axis().norm()
}

#[test]
fn coning_at_five_hertz_leaves_a_hundredth_of_its_drift_even_with_uneven_intervals() {
    for intervals in [&[0.01][..], &[0.009, 0.011, 0.0105, 0.0095][..]] {
        let plain = coning_drift(intervals, false);
        let compensated = coning_drift(intervals, true);
        assert!(compensated < 0.03 * plain, "{compensated} against {plain}");
    }
}

#[test]
fn several_increments_as_one_carry_an_estimate_to_the_same_place() {
    use crate::nominal::Nominal;
    use crate::strapdown::{LocalGravity, integrate};
    use insd_base::Geodetic;
    use nalgebra::Matrix3;

    let place = Geodetic::from_degrees(54.0, 8.0, 20.0);
    let mut fine = Nominal::at(&place, &Vector3::new(3.0, 1.0, 0.1), &Matrix3::identity());
    let mut coarse = fine;
    let gravity = LocalGravity::around(&fine.position, &place);
    let mut conditioner = Conditioner::new(&imu(100.0));
    let mut waiting: Option<Increment> = None;
    for step in 1..=6000 {
        // a ship that rolls and pitches by degrees
        let t = f64::from(step) * 0.01;
        let rate = Vector3::new(0.1 * (0.7 * t).cos(), 0.06 * (0.9 * t).sin(), 0.02);
        let force = Vector3::new(0.8 * (0.7 * t).sin(), 0.5 * (0.9 * t).cos(), -9.81);
        let sample = ImuSample {
            time: Time::from_seconds(t),
            delta_theta: Body(rate * 0.01),
            delta_velocity: Body(force * 0.01),
        };
        let Conditioned::Sample(increment) = conditioner.take(&sample) else { continue };
        integrate(&mut fine, &gravity, &increment);
        let both = waiting.map_or(increment, |waiting| waiting.then(&increment));
        waiting = Some(both);
        if step % 5 == 0 {
            integrate(&mut coarse, &gravity, &both);
            waiting = None;
        }
    }
    assert!(fine.attitude.angle_to(&coarse.attitude) < 1e-9);
    let (by, moved) = (fine.velocity - coarse.velocity, fine.position - coarse.position);
    assert!(by.norm() < 1e-5, "{} m/s", by.norm());
    assert!(moved.norm() < 1e-3, "{} m after a minute", moved.norm());
}
