//! The errors of an inertial system on level axes, and what they grow from.

use nalgebra::{DMatrix, Matrix3, Vector3};

use insd_base::ImuSpec;
use insd_base::earth::{radii, rate_n, transport_rate};
use insd_base::units::DEG;

use super::block::Block;
use super::way::{Stretch, level_turn};
use crate::motion::Swing;

/// Error of position north and east, m.
pub(super) const POSITION: Block = Block::first(2);
/// Of velocity north and east, m/s.
pub(super) const VELOCITY: Block = POSITION.then(2);
/// Of attitude, a small turn about north, east and down, rad.
pub(super) const ATTITUDE: Block = VELOCITY.then(3);
/// Of the gyros from switching on, forward, starboard, down, rad/s.
pub(super) const GYRO_TURN_ON: Block = ATTITUDE.then(3);
/// Of the gyros in the run, rad/s.
pub(super) const GYRO_IN_RUN: Block = GYRO_TURN_ON.then(3);
/// Scale factor of the gyro of the vertical axis, which alone turns for long.
pub(super) const GYRO_SCALE: Block = GYRO_IN_RUN.then(1);
/// Of the level accelerometers from switching on, forward and starboard, m/s^2.
pub(super) const ACCEL_TURN_ON: Block = GYRO_SCALE.then(2);
/// Of the level accelerometers in the run, m/s^2.
pub(super) const ACCEL_IN_RUN: Block = ACCEL_TURN_ON.then(2);
/// Scale factors of the level accelerometers.
pub(super) const ACCEL_SCALE: Block = ACCEL_IN_RUN.then(2);
/// How many states these are.
pub(super) const STATES: usize = ACCEL_SCALE.end();

/// 1-sigma of a heading of which nothing is known: that of the uniform distribution, rad.
const UNKNOWN_HEADING: f64 = 104.0 * DEG;
/// 1-sigma of roll and pitch at the start, rad: what the accelerometers say at once.
const START_TILT: f64 = DEG;
/// 1-sigma of position and velocity at the start under way, m and m/s: next to nothing is known.
const START_UNDER_WAY: (f64, f64) = (100.0, 10.0);
/// 1-sigma of the velocity at the start at the berth, m/s.
const START_VELOCITY: f64 = 1.0;

/// 1-sigma at the start.
#[derive(Clone, Copy, Debug)]
pub(super) struct Start {
    position: f64,
    velocity: f64,
}

/// What is known at the start: at a berth that the position is off by some motion about it, of
/// `swings` in moorings and waves, and the velocity small.
pub(super) fn start(swings: Option<&[[Swing; 2]; 2]>) -> Start {
    let (position, velocity) = START_UNDER_WAY;
    swings.map_or(Start { position, velocity }, |swings| {
        let power: f64 = swings.iter().flatten().map(|swing| swing.std.powi(2)).sum();
        Start { position: (power / 2.0).sqrt().max(0.01), velocity: START_VELOCITY }
    })
}

/// The covariance at the start.
pub(super) fn initial(spec: &ImuSpec, start: &Start) -> DMatrix<f64> {
    let mut sigma = DMatrix::zeros(STATES, 1);
    let (gyro, accel) = (&spec.gyro, &spec.accel);
    for (block, value) in [
        (POSITION, start.position),
        (VELOCITY, start.velocity),
        (ATTITUDE, START_TILT),
        (GYRO_TURN_ON, gyro.bias_std),
        (GYRO_IN_RUN, gyro.instability_std),
        (GYRO_SCALE, gyro.scale_std),
        (ACCEL_TURN_ON, accel.bias_std),
        (ACCEL_IN_RUN, accel.instability_std),
        (ACCEL_SCALE, accel.scale_std),
    ] {
        block.places().for_each(|place| sigma[place] = value);
    }
    sigma[ATTITUDE.at(2)] = UNKNOWN_HEADING;
    DMatrix::from_diagonal(&sigma.column(0).map(|sigma| sigma * sigma))
}

/// Spectral density of the white noise that drives the errors.
pub(super) fn noise(spec: &ImuSpec) -> DMatrix<f64> {
    density(spec, STATES, [VELOCITY, ATTITUDE, GYRO_IN_RUN, ACCEL_IN_RUN])
}

/// Spectral density of what an IMU of this kind drives so many states with, those of velocity, attitude and the in-run biases of gyros and accelerometers among
/// them: random walks of the sensors, and 2 sigma^2 / tau of the Gauss-Markov biases.
pub(super) fn density(spec: &ImuSpec, states: usize, blocks: [Block; 4]) -> DMatrix<f64> {
    let mut density = DMatrix::zeros(states, states);
    let (gyro, accel) = (&spec.gyro, &spec.accel);
    let markov = |std: f64, time: f64| 2.0 * std * std / time;
    let values = [
        accel.random_walk.powi(2),
        gyro.random_walk.powi(2),
        markov(gyro.instability_std, gyro.instability_time),
        markov(accel.instability_std, accel.instability_time),
    ];
    for (block, value) in blocks.into_iter().zip(values) {
        block.places().for_each(|place| density[(place, place)] = value);
    }
    density
}

/// The matrix F of dx/dt = F x + w along a stretch of the way: Groves, 2nd ed., section 14.2.4,
/// with the attitude error phi such that the system's axes are (1 - phi x) the true ones:
///
/// - dp/dt = v
/// - dv/dt = f x phi - (2 omega_ie + omega_en) x v + C (b + s f), level components
/// - dphi/dt = -omega_in x phi + d(omega_en)/dv v + C b + down s r
///
/// f specific force, C the turn from body to level axes by the heading, b biases, s scale factors,
/// r the rate of turn. The change of the Earth rate with the error of latitude is left out: 1e-11
/// rad/s for a metre.
pub(super) fn dynamics(spec: &ImuSpec, stretch: &Stretch) -> DMatrix<f64> {
    let mut f = DMatrix::zeros(STATES, STATES);
    let point = &stretch.point;
    let omega_ie = rate_n(point.latitude);
    let omega_en = transport_rate(point, &stretch.velocity);
    let force = cross(&stretch.force);
    let coriolis = cross(&(omega_ie * 2.0 + omega_en));
    let turn = cross(&(omega_ie + omega_en));
    for row in 0..2 {
        f[(POSITION.at(row), VELOCITY.at(row))] = 1.0;
        for axis in 0..2 {
            f[(VELOCITY.at(row), VELOCITY.at(axis))] = -coriolis[(row, axis)];
        }
        for axis in 0..3 {
            f[(VELOCITY.at(row), ATTITUDE.at(axis))] = force[(row, axis)];
        }
    }
    for row in 0..3 {
        for axis in 0..3 {
            f[(ATTITUDE.at(row), ATTITUDE.at(axis))] = -turn[(row, axis)];
        }
    }
    let (meridian, normal) = radii(point.latitude);
    let (meridian, normal) = (meridian + point.height, normal + point.height);
    f[(ATTITUDE.at(0), VELOCITY.at(1))] = 1.0 / normal;
    f[(ATTITUDE.at(1), VELOCITY.at(0))] = -1.0 / meridian;
    f[(ATTITUDE.at(2), VELOCITY.at(1))] = -point.latitude.tan() / normal;
    couple_sensors(&mut f, spec, stretch);
    f
}

/// How the errors of the sensors enter, and decay.
fn couple_sensors(f: &mut DMatrix<f64>, spec: &ImuSpec, stretch: &Stretch) {
    let c = level_turn(stretch.heading);
    let force_b = c.tr_mul(&stretch.force);
    for row in 0..3 {
        for axis in 0..3 {
            f[(ATTITUDE.at(row), GYRO_TURN_ON.at(axis))] = c[(row, axis)];
            f[(ATTITUDE.at(row), GYRO_IN_RUN.at(axis))] = c[(row, axis)];
        }
    }
    f[(ATTITUDE.at(2), GYRO_SCALE.at(0))] = stretch.turn_rate;
    for row in 0..2 {
        for axis in 0..2 {
            f[(VELOCITY.at(row), ACCEL_TURN_ON.at(axis))] = c[(row, axis)];
            f[(VELOCITY.at(row), ACCEL_IN_RUN.at(axis))] = c[(row, axis)];
            f[(VELOCITY.at(row), ACCEL_SCALE.at(axis))] = c[(row, axis)] * force_b[axis];
        }
    }
    for (block, time) in
        [(GYRO_IN_RUN, spec.gyro.instability_time), (ACCEL_IN_RUN, spec.accel.instability_time)]
    {
        block.places().for_each(|place| f[(place, place)] = -1.0 / time);
    }
}

/// The matrix that multiplies like a vector product from the left.
pub(super) fn cross(v: &Vector3<f64>) -> Matrix3<f64> {
    v.cross_matrix()
}
