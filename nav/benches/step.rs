//! What a step of the navigator costs, in instructions counted by callgrind: the same number on a
//! busy machine as on an idle one. Needs `valgrind` and the `gungraun-runner` of the version of
//! `gungraun` in `Cargo.lock`; `cargo install gungraun-runner` puts it in the path.
//!
//! The benchmarks of many steps run a second of 100 Hz samples after the filter has settled: divide
//! by [`STEPS`].

#![allow(missing_docs)] // the macros generate public items without any

use std::hint::black_box;
use std::sync::Arc;

use gungraun::{library_benchmark, library_benchmark_group, main};
use insd_base::satellites::{
    ArcPhase, Constellation, Measured, SatelliteId, SatelliteRange, SatelliteRanges, Transmitter,
};
use insd_base::units::{DEG_PER_HOUR, DEG_PER_SQRT_HOUR, MICRO_G, MPS_PER_SQRT_HOUR};
use insd_base::{
    Body, FixQuality, Geodetic, GnssFix, ImuSample, ImuSpec, LeverArms, Message, Ned, Received,
    Source, Time, Triad, earth,
};
use insd_nav::declaration::Regime;
use insd_nav::error_state::{ATTITUDE, Covariance, POSITION, VELOCITY};
use insd_nav::initial::sensor_covariance;
use insd_nav::propagation::{Passage, Stretch};
use insd_nav::strapdown::{LocalGravity, Step, integrate};
use insd_nav::{
    Conditioned, Conditioner, Estimator, Filter, Increment, InitialState, NavConfig, Nominal,
    Report,
};
use nalgebra::{Matrix3, Vector3};

/// Samples in the benchmarks of many steps: one second.
const STEPS: usize = 100;
/// Satellites in an epoch of ranges, of which the navigator takes twenty-four.
const SATELLITES_SEEN: usize = 30;
/// Samples before, in which the filter leaves its initial state.
const WARM_UP: usize = 6000;

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

/// A place on the sea.
fn place() -> Geodetic {
    Geodetic::from_degrees(35.0, 139.0, 20.0)
}

fn nominal() -> Nominal {
    Nominal::at(&place(), &Vector3::zeros(), &Matrix3::identity())
}

/// A ship that rolls and heaves, sample by sample.
fn increments(count: usize) -> Vec<Increment> {
    let mut conditioner = Conditioner::new(&IMU);
    let sample = |index: usize| {
        let t = index as f64 / IMU.rate;
        let roll_rate = 0.02 * (0.6 * t).cos();
        let heave = 0.3 * (0.7 * t).sin();
        ImuSample {
            time: Time::from_seconds(t),
            delta_theta: Body(Vector3::new(roll_rate, 0.3 * roll_rate, 1e-3) / IMU.rate),
            delta_velocity: Body(Vector3::new(0.02 * heave, 0.01, heave - 9.797) / IMU.rate),
        }
    };
    let conditioned = (1..=count).map(|index| match conditioner.take(&sample(index)) {
        Conditioned::Sample(increment) => increment,
        other => unreachable!("{other:?}"),
    });
    conditioned.collect()
}

fn covariance(config: &NavConfig) -> Covariance {
    let mut covariance = sensor_covariance(config);
    POSITION.renew(&mut covariance, &Matrix3::from_diagonal_element(25.0));
    VELOCITY.renew(&mut covariance, &Matrix3::from_diagonal_element(0.01));
    ATTITUDE.renew(&mut covariance, &Matrix3::from_diagonal_element(1e-6));
    covariance
}

fn fix(seconds: f64) -> Received {
    let time = Time::from_seconds(seconds);
    let message = Message::Gnss(GnssFix {
        time,
        position: Some(place()),
        velocity: Some(Ned::new(0.0, 0.0, 0.0)),
        position_std: Some(Ned::new(1.0, 1.0, 2.0)),
        velocity_std: Some(Ned::new(0.03, 0.03, 0.05)),
        hdop: Some(0.9),
        satellites: Some(14),
        quality: FixQuality::Differential,
        lever: None,
        redated: 0.0,
        rank: 0,
    });
    Received { receipt: time, source: Source::Gnss(0), message }
}

/// So many satellites of two systems, evenly over the sky from 12 degrees up, with code and phase.
fn ranges(seconds: f64, count: usize) -> Received {
    let time = Time::from_seconds(seconds);
    let (antenna, c_en) = (earth::ecef(&place()).0, earth::c_ne(&place()).transpose());
    let range = |index: usize| {
        let azimuth = index as f64 * 2.4;
        let elevation = (12.0 + 75.0 * index as f64 / count as f64).to_radians();
        let (across, up) = elevation.sin_cos();
        let line = Vector3::new(up * azimuth.cos(), up * azimuth.sin(), -across);
        let position = antenna + c_en * line * 2.2e7;
        let transmitter = Transmitter { position, velocity: Vector3::zeros() };
        let value = transmitter.range(&antenna);
        let constellation = [Constellation::Gps, Constellation::Galileo][index % 2];
        SatelliteRange {
            offset: Vector3::zeros(),
            satellite: SatelliteId { constellation, number: index as u8 + 1 },
            transmitter,
            elevation,
            code: Some(Measured { value, variance: 0.1 }),
            rate: None,
            phase: Some(ArcPhase { phase: Measured { value, variance: 1e-5 }, arc: 1 }),
            slow_std: 1.0,
            by_ionosphere: 3.0,
            multipath_std: 0.5,
        }
    };
    let told = SatelliteRanges {
        time,
        clock: Some((0.0, 0.0)),
        ranges: (0..count).map(range).collect(),
        displacement: None,
        heard: Vec::new(),
    };
    let message = Message::Ranges(Arc::new(told));
    Received { receipt: time, source: Source::Gnss(0), message }
}

/// The same that goes by ranges: after an epoch of thirty satellites in each second the next is due.
fn among_satellites() -> (Filter, Vec<Increment>) {
    let (mut filter, ahead) = under_way(0.1);
    for increment in &ahead {
        filter.advance(increment);
    }
    for seconds in [60.0, 61.0] {
        filter.apply(&ranges(seconds, SATELLITES_SEEN));
    }
    (filter, ahead)
}

/// A filter that has run for a minute with a fix every second, and the second that follows.
fn under_way(covariance_interval: f64) -> (Filter, Vec<Increment>) {
    let lever_arms = LeverArms { gnss: Body::new(-6.0, -0.8, -14.0), log: Body::default() };
    let config = NavConfig { covariance_interval, ..NavConfig::new(IMU, lever_arms) };
    let initial = InitialState::new(Time::START, nominal(), covariance(&config), Vector3::zeros());
    let mut filter = Filter::new(&config, &initial);
    filter.begin_navigation();
    let mut increments = increments(WARM_UP + STEPS);
    let ahead = increments.split_off(WARM_UP);
    for (index, increment) in increments.iter().enumerate() {
        filter.advance(increment);
        if index % 100 == 99 {
            filter.apply(&fix(increment.to.as_seconds()));
        }
    }
    (filter, ahead)
}

fn one_sample() -> (Nominal, LocalGravity, Increment) {
    let nominal = nominal();
    let gravity = LocalGravity::around(&nominal.position, &place());
    (nominal, gravity, increments(10)[9])
}

#[library_benchmark]
#[bench::one_sample(one_sample())]
fn strapdown((mut nominal, gravity, increment): (Nominal, LocalGravity, Increment)) -> Step {
    black_box(integrate(black_box(&mut nominal), &gravity, &increment))
}

/// A tenth of a second of steps, before the covariance is propagated over it.
fn stretch() -> Box<(Covariance, Stretch, LocalGravity, NavConfig)> {
    let config = NavConfig::new(IMU, LeverArms::default());
    let (mut nominal, gravity, _) = one_sample();
    let mut stretch = Stretch::new();
    for increment in increments(10) {
        stretch.add(&integrate(&mut nominal, &gravity, &increment));
        stretch.add_noise(&increment);
    }
    Box::new((covariance(&config), stretch, gravity, config))
}

#[library_benchmark]
#[bench::one_stretch(stretch())]
fn covariance_propagation(
    mut run: Box<(Covariance, Stretch, LocalGravity, NavConfig)>,
) -> Box<(Covariance, Stretch, LocalGravity, NavConfig)> {
    let (covariance, stretch, gravity, config) = &mut *run;
    let regime = Regime { rtk: false, warmer: 0.0 };
    let passage = Passage { stretch, gradient: gravity.gradient(), config, regime };
    passage.propagate(black_box(covariance));
    run
}

/// Kept on the heap, so that moving it does not count.
type Run = Box<(Filter, Vec<Increment>)>;

#[library_benchmark]
#[bench::at_10_hz(Box::new(under_way(0.1)))]
#[bench::at_every_step(Box::new(under_way(0.01)))]
fn hundred_steps(mut run: Run) -> Run {
    let (filter, ahead) = &mut *run;
    for increment in ahead.iter() {
        filter.advance(black_box(increment));
    }
    run
}

#[library_benchmark]
#[bench::position_and_velocity(Box::new(under_way(0.1)))]
fn gnss_update(mut run: Run) -> (Run, Report) {
    let report = run.0.apply(black_box(&fix(60.0)));
    (run, report)
}

#[library_benchmark]
#[bench::thirty_satellites(Box::new(among_satellites()))]
fn range_update(mut run: Run) -> (Run, Report) {
    let report = run.0.apply(black_box(&ranges(61.0, SATELLITES_SEEN)));
    (run, report)
}

library_benchmark_group!(
    name = steps,
    benchmarks = [strapdown, covariance_propagation, hundred_steps, gnss_update, range_update]
);

main!(library_benchmark_groups = steps);
