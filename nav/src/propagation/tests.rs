//! The transition matrix against perturbed mechanisations, driven from one table.

use insd_base::units::{DEG, DEG_PER_HOUR, MICRO_G, PPM};
use insd_base::{Attitude, Geodetic, ImuSpec, LeverArms, Span, Time, Triad};
use nalgebra::{DMatrix, Vector3};

use super::*;
use crate::error_state::no_covariance;
use crate::increments::Increment;
use crate::nominal::Nominal;
use crate::strapdown::{self, LocalGravity};

const STEPS: i64 = 10;

fn increment(step: i64) -> Increment {
    let time = |k: i64| Time::START + Span::from_nanos(k * 10_000_000);
    let phase = step as f64 * 0.05;
    Increment {
        from: time(step),
        to: time(step + 1),
        rotation: Vector3::new(2e-3 * phase.cos(), -1e-3, 3e-3 * phase.sin()),
        velocity: Vector3::new(0.004, 0.002 * phase.sin(), -0.098),
        end_rate: Vector3::zeros(),
        end_rate_variance: 0.0,
        angular_acceleration: Vector3::zeros(),
        rate_noise: Vector3::zeros(),
        force_noise: Vector3::zeros(),
        bridged: None,
        celsius: None,
    }
}

fn estimate() -> Nominal {
    let attitude = Attitude { roll: 0.1, pitch: -0.05, heading: 1.2 };
    let place = Geodetic::from_degrees(48.0, -5.0, 20.0);
    Nominal::at(&place, &Vector3::new(6.0, -2.0, 0.3), &attitude.c_nb())
}

/// Sails over the steps; returns the end and the stretch.
fn sail(start: &Nominal) -> (Nominal, Stretch) {
    let gravity = LocalGravity::around(&start.position, &start.geodetic());
    let mut nominal = *start;
    let mut stretch = Stretch::new();
    for step in 0..STEPS {
        let done = strapdown::integrate(&mut nominal, &gravity, &increment(step));
        stretch.add(&done);
    }
    (nominal, stretch)
}

/// What the rows say becomes of one error.
fn predicted(block: Block<3>, axis: usize, rows: &StrapdownRows, stretch: &Stretch) -> Vec<f64> {
    let dt = stretch.duration;
    let heads = [POSITION, VELOCITY, ATTITUDE];
    let column = match block {
        GYRO_BIAS => rows.gyro.column(axis).into_owned(),
        GYRO_SCALE => rows.gyro.column(axis) * (stretch.rotation[axis] / dt),
        ACCEL_BIAS => rows.accel.column(axis).into_owned(),
        ACCEL_SCALE => rows.accel.column(axis) * (stretch.velocity[axis] / dt),
        head => {
            let at = heads.iter().position(|own| *own == head).unwrap_or_default();
            rows.transition.column(3 * at + axis).into_owned()
        }
    };
    column.iter().copied().collect()
}

#[test]
fn the_transition_agrees_with_perturbed_mechanisations() {
    let start = estimate();
    let (end, stretch) = sail(&start);
    let gravity = LocalGravity::around(&start.position, &start.geodetic());
    let rows = strapdown_rows(&stretch, gravity.gradient());
    let blocks = [
        (POSITION, 1.0),
        (VELOCITY, 1e-2),
        (ATTITUDE, 1e-5),
        (GYRO_BIAS, 1e-4),
        (GYRO_SCALE, 1e-4),
        (ACCEL_BIAS, 1e-2),
        (ACCEL_SCALE, 1e-3),
    ];
    for (at, (block, step)) in blocks.into_iter().enumerate() {
        for axis in 0..3 {
            let mut error = Errors::none();
            error.set(block, &Vector3::ith(axis, step));
            let mut moved = start;
            moved.inject(&error);
            let slope = end.error_to(&sail(&moved).0).values() / step;
            let all = predicted(block, axis, &rows, &stretch);
            for (row, expected) in all.into_iter().enumerate() {
                // Left out are effects of third order in the stretch: g dt^3 / 6 = 0.0016 m of
                // position for a gyro bias of 1 rad/s.
                let tolerance =
                    [2e-3, 1e-2, 1e-2][row / 3] * [0.1, 1.0][usize::from(at < 3 || row < 3)];
                assert!(
                    (slope[row] - expected).abs() < tolerance,
                    "{block:?} {axis} row {row}: {} against {expected}",
                    slope[row],
                );
            }
        }
    }
}

const REGIME: Regime = Regime { rtk: false, warmer: 0.0 };

fn config() -> NavConfig {
    let gyro = Triad {
        bias_std: DEG_PER_HOUR,
        instability_std: 0.1 * DEG_PER_HOUR,
        instability_time: 600.0,
        random_walk: 1e-5,
        scale_std: 100.0 * PPM,
    };
    let accel = Triad {
        bias_std: 500.0 * MICRO_G,
        instability_std: 50.0 * MICRO_G,
        instability_time: 600.0,
        random_walk: 1e-4,
        scale_std: 100.0 * PPM,
    };
    NavConfig::new(ImuSpec { rate: 100.0, gyro, accel }, LeverArms::default())
}

#[test]
fn the_cheap_propagation_is_the_full_matrix_product() {
    let (_, stretch) = sail(&estimate());
    let gravity = LocalGravity::around(&estimate().position, &estimate().geodetic());
    let rows = strapdown_rows(&stretch, gravity.gradient());
    let mut p = no_covariance();
    let (states, dt) = (p.states(), stretch.duration);
    let mut phi = DMatrix::<f64>::identity(states, states);
    phi.fixed_view_mut::<9, 9>(0, 0).copy_from(&rows.transition);
    let at = |block: Block<3>| p.layout().start(block.key()).unwrap();
    let triads = [
        ([GYRO_BIAS, GYRO_DRIFT, GYRO_SCALE], rows.gyro, stretch.rotation),
        ([ACCEL_BIAS, ACCEL_DRIFT, ACCEL_SCALE], rows.accel, stretch.velocity),
    ];
    for ([bias, drift, scale], input, integral) in triads {
        phi.fixed_view_mut::<9, 3>(0, at(bias)).copy_from(&input);
        phi.fixed_view_mut::<9, 3>(0, at(drift)).copy_from(&input);
        let mean = Matrix3::from_diagonal(&(integral / dt));
        phi.fixed_view_mut::<9, 3>(0, at(scale)).copy_from(&(input * mean));
    }
    let mut added = no_covariance();
    for (place, std, time) in markov(p.layout(), &config(), &REGIME) {
        let left = markov_decay(dt, time);
        (place.start..place.start + place.width).for_each(|i| phi[(i, i)] = left);
        added.inflate(place.key, std * std * (1.0 - left * left));
    }
    add_noise(&mut added, &stretch, &config(), &REGIME);
    let root = DMatrix::from_fn(states, states, |i, j| ((i * 5 + j * 11) as f64).sin() * DEG);
    let start = &root * root.transpose();
    let full = &phi * &start * phi.transpose() + added.matrix();
    p.matrix_mut().copy_from(&start);
    let (gradient, config) = (gravity.gradient(), &config());
    Passage { stretch: &stretch, gradient, config, regime: REGIME }.propagate(&mut p);
    assert!((&full - p.matrix()).amax() < 1e-9 * full.amax());
    assert!((p.matrix() - p.matrix().transpose()).amax() < 1e-15 * full.amax());
}
