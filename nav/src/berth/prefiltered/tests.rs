//! Claims about the reference method.

use crate::error_state::{ACCEL_BIAS, GYRO_BIAS, POSITION, VELOCITY};
use crate::initial::sensor_covariance;
use crate::{Estimator, Increment, InitialState, NavConfig, Nominal};
use insd_base::units::{DEG, DEG_PER_HOUR, DEG_PER_SQRT_HOUR, MICRO_G};
use insd_base::{
    Attitude, ExternalReference, Geodetic, ImuSpec, LeverArms, Message, Received, Source, Triad,
    earth,
};
use nalgebra::{Matrix3, UnitQuaternion, Vector3};

use super::*;
use crate::Navigator;
use crate::berth::Method;

const STEP: f64 = 0.1;

fn berth() -> Geodetic {
    Geodetic::from_degrees(35.0, 139.0, 10.0)
}

fn imu() -> ImuSpec {
    let triad = |bias_std: f64, random_walk: f64| Triad {
        bias_std,
        instability_std: 0.3 * bias_std,
        instability_time: 3600.0,
        random_walk,
        scale_std: 1e-5,
    };
    ImuSpec {
        rate: 1.0 / STEP,
        gyro: triad(0.01 * DEG_PER_HOUR, 0.003 * DEG_PER_SQRT_HOUR),
        accel: triad(50.0 * MICRO_G, 1e-4),
    }
}

fn lying() -> Attitude {
    Attitude { roll: 0.01, pitch: -0.02, heading: 200.0 * DEG }
}

/// A filter whose estimate is wrong by `error`.
pub(in crate::berth) fn filter(error: &Errors) -> Filter {
    let config = NavConfig::new(imu(), LeverArms::default());
    let mut nominal = Nominal::at(&berth(), &Vector3::zeros(), &lying().c_nb());
    nominal.inject(&-error);
    let mut covariance = sensor_covariance(&config);
    for block in [POSITION, VELOCITY, ATTITUDE] {
        block.renew(&mut covariance, &Matrix3::from_diagonal_element(1e-2));
    }
    Filter::new(&config, &InitialState::new(Time::START, nominal, covariance, Vector3::zeros()))
}

/// What the sensors of a ship say that does not move.
pub(in crate::berth) fn increment(step: usize) -> Increment {
    let at = |step: usize| Time::START + Span::from_seconds(step as f64 * STEP);
    let turn = UnitQuaternion::from_matrix(&lying().c_nb()).inverse();
    let gravity = Vector3::z() * earth::normal_gravity(berth().latitude, berth().height);
    let rate = turn * earth::rate_n(berth().latitude);
    Increment {
        from: at(step),
        to: at(step + 1),
        rotation: rate * STEP,
        velocity: turn * -gravity * STEP,
        end_rate: rate,
        end_rate_variance: 0.0,
        angular_acceleration: Vector3::zeros(),
        rate_noise: Vector3::zeros(),
        force_noise: Vector3::zeros(),
        bridged: None,
        celsius: None,
    }
}

/// Errors of tilt, heading, velocity and sensors as they are while a ship is being aligned.
pub(in crate::berth) fn errors() -> Errors {
    let c_en = earth::c_ne(&berth()).transpose();
    let mut error = Errors::none();
    error.set(ATTITUDE, &(c_en * Vector3::new(1e-5, -2e-5, 0.1 * DEG)));
    error.set(VELOCITY, &(c_en * Vector3::new(0.005, -0.01, 0.0)));
    error.set(GYRO_BIAS, &Vector3::new(0.002, -0.003, 0.001).map(|rate| rate * DEG_PER_HOUR));
    error.set(ACCEL_BIAS, &Vector3::new(4e-5, -3e-5, 0.0));
    error
}

#[test]
fn a_corrected_filter_leaves_the_window_as_if_it_had_always_been_right() {
    let (mut wrong, mut right) = (filter(&errors()), filter(&Errors::none()));
    let (mut seen, mut ideal) = (Prefiltered::new(&wrong), Prefiltered::new(&right));
    for step in 0..3000 {
        wrong.advance(&increment(step));
        right.advance(&increment(step));
        if step % 10 == 9 {
            seen.sample(&mut wrong);
            ideal.sample(&mut right);
        }
    }
    let distance = |seen: &Prefiltered| {
        let pairs = seen.prefilter.samples().zip(ideal.prefilter.samples());
        pairs.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
    };
    assert!(distance(&seen) > 0.04, "the errors make {} m/s", distance(&seen));
    wrong.settle();
    right.settle();
    wrong.join(&right, 1.0);
    let correction = wrong.take_correction();
    seen.prefilter.shift(&derivatives(&wrong, &correction));
    // the square of the heading error is left
    assert!(distance(&seen) < 1e-4, "{} m/s are left", distance(&seen));
}

#[test]
fn the_derivatives_that_are_left_out_are_small() {
    let all = derivatives(&filter(&Errors::none()), &errors());
    let share = |n: usize| {
        let factorial: f64 = (1..=n).map(|k| k as f64).product();
        all[n].norm() * PrefilterConfig::default().window.as_seconds().powi(n as i32) / factorial
    };
    let largest = (0..DERIVATIVES).map(share).fold(0.0, f64::max);
    assert!(share(DERIVATIVES - 1) < 2e-3 * largest, "{} of {largest}", share(DERIVATIVES - 1));
}

fn named(at: f64) -> Received {
    let time = Time::from_seconds(at);
    let place = Geodetic::from_degrees(35.001, 139.0, 10.0);
    let reference = ExternalReference {
        time,
        v_north: None,
        v_east: None,
        velocity_std: None,
        position: Some(place),
        position_std: Some(0.5),
        position_lasting_std: None,
        heading: None,
        heading_std: None,
    };
    Received { receipt: time, source: Source::Reference(0), message: Message::Reference(reference) }
}

#[test]
fn only_the_moorings_hold_the_position_to_the_berth_once_it_is_named() {
    for method in Method::ALL {
        let mut navigator = Navigator::of(filter(&Errors::none()), Some(method));
        let mut place = Vec::new();
        for second in 0..2 {
            navigator.apply(&named(f64::from(second)));
            place.push(navigator.filter().nominal().position);
        }
        let moved = (place[1] - place[0]).norm();
        assert!(moved < 1e-9, "{}: moved by {moved} m", method.as_str());
    }
}

#[test]
fn the_plain_filter_learns_how_fast_the_sea_is() {
    let mut filter = filter(&Errors::none());
    let mut white = WhiteNoise::new(&filter);
    assert!(white.std() > 0.2);
    for step in 0..6000 {
        filter.advance(&increment(step));
        white.hold(&mut filter);
    }
    assert!(white.std() < 0.05, "{} m/s on a ship that does not move", white.std());
}
