//! What alignment costs on top of navigation, in instructions counted by callgrind (see
//! `nav/benches/step.rs` for how to run it). Each benchmark runs sixteen seconds of 100 Hz samples,
//! four samples of the moorings: compare with `navigating`, the same filter under way.

#![allow(missing_docs)] // the macros generate public items without any

use std::hint::black_box;

use gungraun::{library_benchmark, library_benchmark_group, main};
use insd_alignment::kinematics::Kinematics;
use insd_alignment::{Bank, EightState, Level};
use insd_base::units::{DEG_PER_HOUR, DEG_PER_SQRT_HOUR, MICRO_G, MPS_PER_SQRT_HOUR};
use insd_base::{Body, Geodetic, ImuSample, ImuSpec, LeverArms, Time, Triad};
use insd_nav::berth::Method;
use insd_nav::error_state::{ATTITUDE, Covariance, POSITION, VELOCITY};
use insd_nav::initial::sensor_covariance;
use insd_nav::{
    Conditioned, Conditioner, Estimator, Filter, Increment, InitialState, NavConfig, Navigator,
    Nominal,
};
use nalgebra::{Matrix3, Vector3};

/// Samples that are counted.
const COUNTED: usize = 1600;
/// Samples before: long enough for a prefilter to have its window.
const WARM_UP: usize = 32_000;

const IMU: ImuSpec = ImuSpec {
    rate: 100.0,
    gyro: Triad {
        bias_std: 0.01 * DEG_PER_HOUR,
        instability_std: 0.003 * DEG_PER_HOUR,
        instability_time: 3600.0,
        random_walk: 0.003 * DEG_PER_SQRT_HOUR,
        scale_std: 1e-5,
    },
    accel: Triad {
        bias_std: 50.0 * MICRO_G,
        instability_std: 10.0 * MICRO_G,
        instability_time: 3600.0,
        random_walk: 0.005_884 * MPS_PER_SQRT_HOUR,
        scale_std: 5e-5,
    },
};

fn place() -> Geodetic {
    Geodetic::from_degrees(35.0, 139.0, 20.0)
}

fn config() -> NavConfig {
    NavConfig::new(IMU, LeverArms::default())
}

/// A ship that rolls, heaves and sways, sample by sample.
fn increments(count: usize) -> Vec<Increment> {
    let mut conditioner = Conditioner::new(&IMU);
    let sample = |index: usize| {
        let t = index as f64 / IMU.rate;
        let roll_rate = 0.02 * (0.6 * t).cos();
        let heave = 0.3 * (0.7 * t).sin();
        ImuSample {
            time: Time::from_seconds(t),
            delta_theta: Body(Vector3::new(roll_rate, 0.3 * roll_rate, 1e-4) / IMU.rate),
            delta_velocity: Body(
                Vector3::new(0.1 * heave, 0.1 * (0.8 * t).cos(), heave - 9.797) / IMU.rate,
            ),
        }
    };
    let conditioned = (1..=count).map(|index| match conditioner.take(&sample(index)) {
        Conditioned::Sample(increment) => increment,
        other => unreachable!("{other:?}"),
    });
    conditioned.collect()
}

fn filter() -> Filter {
    let nominal = Nominal::at(&place(), &Vector3::zeros(), &Matrix3::identity());
    let mut covariance: Covariance = sensor_covariance(&config());
    POSITION.renew(&mut covariance, &Matrix3::from_diagonal_element(25.0));
    VELOCITY.renew(&mut covariance, &Matrix3::from_diagonal_element(1.0));
    ATTITUDE.renew(&mut covariance, &Matrix3::from_diagonal_element(1e-4));
    let rate = Vector3::zeros();
    Filter::new(&config(), &InitialState::new(Time::START, nominal, covariance, rate))
}

/// An estimator and the samples that are counted; on the heap, so that moving it does not count.
type Run<E> = Box<(E, Vec<Increment>)>;

fn prepared<E: Estimator>(mut estimator: E, warm_up: usize) -> Run<E> {
    let mut increments = increments(warm_up + COUNTED);
    let ahead = increments.split_off(warm_up);
    for increment in &increments {
        estimator.advance(increment);
    }
    Box::new((estimator, ahead))
}

fn navigating() -> Run<Navigator> {
    prepared(Navigator::of(filter(), None), 1000)
}

fn moored(method: Method) -> Run<Navigator> {
    prepared(Navigator::of(filter(), Some(method)), WARM_UP)
}

fn level() -> Level {
    Level { time: Time::START, force: Vector3::new(0.0, 0.0, -9.797), rate: Vector3::zeros() }
}

fn kinematics(moored: bool) -> Kinematics {
    Kinematics {
        position: place(),
        position_std: 100.0,
        velocity: Vector3::zeros(),
        velocity_std: 2.0,
        acceleration: Vector3::zeros(),
        moored,
        gnss_position: !moored,
        gnss_velocity: !moored,
    }
}

fn bank(method: Method) -> Run<Bank> {
    let bank = Bank::new(&config(), &level(), &kinematics(true), method);
    prepared(bank, 100)
}

fn eight_state() -> Run<EightState> {
    prepared(EightState::new(&config(), &level(), &kinematics(false)), 100)
}

fn run<E: Estimator>(mut run: Run<E>) -> Run<E> {
    let (estimator, ahead) = &mut *run;
    for increment in ahead.iter() {
        estimator.advance(black_box(increment));
    }
    run
}

#[library_benchmark]
#[bench::navigating(navigating())]
#[bench::moorings(moored(Method::Moorings))]
#[bench::as_published(moored(Method::AsPublished))]
#[bench::autoregressive(moored(Method::Autoregressive))]
#[bench::white_noise(moored(Method::WhiteNoise))]
fn one_heading(prepared: Run<Navigator>) -> Run<Navigator> {
    run(prepared)
}

#[library_benchmark]
#[bench::moorings(bank(Method::Moorings))]
#[bench::autoregressive(bank(Method::Autoregressive))]
fn searching(prepared: Run<Bank>) -> Run<Bank> {
    run(prepared)
}

#[library_benchmark]
#[bench::eight_state(eight_state())]
fn in_motion(prepared: Run<EightState>) -> Run<EightState> {
    run(prepared)
}

library_benchmark_group!(name = alignment, benchmarks = [one_heading, searching, in_motion]);

main!(library_benchmark_groups = alignment);
