//! The transition matrix against perturbed mechanisations, driven from one table.

use insd_base::units::{DEG, DEG_PER_HOUR, MICRO_G, PPM};
use insd_base::{Attitude, Geodetic, ImuSpec, LeverArms, Span, Time, Triad};
use nalgebra::Vector3;

use super::*;
use crate::error_state::ErrorState;
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
fn predicted(state: usize, rows: &StrapdownRows, stretch: &Stretch) -> Vec<f64> {
    let dt = stretch.duration;
    let axis = |start: usize| state - start;
    let column: Vec<f64> = if state < STRAPDOWN_STATES {
        rows.transition.column(state).iter().copied().collect()
    } else if (GYRO_BIAS.start()..GYRO_BIAS.end()).contains(&state) {
        rows.gyro.column(axis(GYRO_BIAS.start())).iter().copied().collect()
    } else if (GYRO_SCALE.start()..GYRO_SCALE.end()).contains(&state) {
        let i = axis(GYRO_SCALE.start());
        (rows.gyro.column(i) * (stretch.rotation[i] / dt)).iter().copied().collect()
    } else if (ACCEL_BIAS.start()..ACCEL_BIAS.end()).contains(&state) {
        rows.accel.column(axis(ACCEL_BIAS.start())).iter().copied().collect()
    } else {
        let i = axis(ACCEL_SCALE.start());
        (rows.accel.column(i) * (stretch.velocity[i] / dt)).iter().copied().collect()
    };
    column
}

#[test]
fn the_transition_agrees_with_perturbed_mechanisations() {
    let start = estimate();
    let (end, stretch) = sail(&start);
    let gravity = LocalGravity::around(&start.position, &start.geodetic());
    let rows = strapdown_rows(&stretch, gravity.gradient());
    let blocks = [
        (POSITION.start(), 1.0),
        (VELOCITY.start(), 1e-2),
        (ATTITUDE.start(), 1e-5),
        (GYRO_BIAS.start(), 1e-4),
        (GYRO_SCALE.start(), 1e-4),
        (ACCEL_BIAS.start(), 1e-2),
        (ACCEL_SCALE.start(), 1e-3),
    ];
    for (block, step) in blocks {
        for state in block..block + 3 {
            let mut error = ErrorState::zeros();
            error[state] = step;
            let mut moved = start;
            moved.inject(&error);
            let slope = end.error_to(&sail(&moved).0) / step;
            for (row, expected) in predicted(state, &rows, &stretch).into_iter().enumerate() {
                // Left out are effects of third order in the stretch: g dt^3 / 6 = 0.0016 m of
                // position for a gyro bias of 1 rad/s.
                let tolerance =
                    [2e-3, 1e-2, 1e-2][row / 3] * [0.1, 1.0][usize::from(state < 9 || row < 3)];
                assert!(
                    (slope[row] - expected).abs() < tolerance,
                    "state {state} row {row}: {} against {expected}",
                    slope[row],
                );
            }
        }
    }
}

const REGIME: Regime = Regime { rtk: false };

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
    let mut phi = Covariance::identity();
    phi.fixed_view_mut::<9, 9>(0, 0).copy_from(&rows.transition);
    let triads = [
        (GYRO_BIAS.start(), GYRO_DRIFT.start(), GYRO_SCALE.start(), rows.gyro, stretch.rotation),
        (
            ACCEL_BIAS.start(),
            ACCEL_DRIFT.start(),
            ACCEL_SCALE.start(),
            rows.accel,
            stretch.velocity,
        ),
    ];
    for (bias, drift, scale, input, integral) in triads {
        phi.fixed_view_mut::<9, 3>(0, bias).copy_from(&input);
        phi.fixed_view_mut::<9, 3>(0, drift).copy_from(&input);
        let mean = Matrix3::from_diagonal(&(integral / stretch.duration));
        phi.fixed_view_mut::<9, 3>(0, scale).copy_from(&(input * mean));
    }
    let root = Covariance::from_fn(|i, j| ((i * 5 + j * 11) as f64).sin() * DEG);
    let start = root * root.transpose();
    let mut full = phi * start * phi.transpose();
    relax_markov(&mut full, stretch.duration, &config(), &REGIME);
    add_noise(&mut full, &stretch, &config());
    let mut cheap = start;
    propagate(&mut cheap, &stretch, gravity.gradient(), &config(), &REGIME);
    assert!((full - cheap).amax() < 1e-9 * full.amax());
    assert!((cheap - cheap.transpose()).amax() < 1e-15 * full.amax());
}
