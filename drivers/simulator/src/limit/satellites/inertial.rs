//! Errors of an inertial system in three dimensions, on level axes: as [`super::super::model`], with the vertical.

use insd_base::ImuSpec;
use insd_base::earth::{c_ne, normal_gravity, rate_n};
use insd_base::units::DEG;
use nalgebra::{DMatrix, Matrix3, Vector3};

use super::super::block::Block;
use super::super::covariance::discrete;
use super::super::model::{cross, density};
use crate::track::Track;

/// Error of position, north, east, down, m.
pub(super) const POSITION: Block = Block::first(3);
/// Of velocity, m/s.
pub(super) const VELOCITY: Block = POSITION.then(3);
/// Of attitude, a small turn about north, east and down, rad.
pub(super) const ATTITUDE: Block = VELOCITY.then(3);
const GYRO_TURN_ON: Block = ATTITUDE.then(3);
const GYRO_IN_RUN: Block = GYRO_TURN_ON.then(3);
const GYRO_SCALE: Block = GYRO_IN_RUN.then(3);
const ACCEL_TURN_ON: Block = GYRO_SCALE.then(3);
const ACCEL_IN_RUN: Block = ACCEL_TURN_ON.then(3);
const ACCEL_SCALE: Block = ACCEL_IN_RUN.then(3);
/// How many states these are.
pub(super) const INERTIAL: usize = ACCEL_SCALE.end();

/// 1-sigma at the start of position, velocity, roll and pitch, and heading: next to nothing is known.
const START: [f64; 4] = [100.0, 10.0, DEG, 104.0 * DEG];

/// Variances at the start.
pub(super) fn initial(spec: &ImuSpec) -> Vec<f64> {
    let mut sigma = vec![0.0; INERTIAL];
    let [position, velocity, level, heading] = START;
    let (gyro, accel) = (&spec.gyro, &spec.accel);
    for (block, value) in [
        (POSITION, position),
        (VELOCITY, velocity),
        (ATTITUDE, level),
        (GYRO_TURN_ON, gyro.bias_std),
        (GYRO_IN_RUN, gyro.instability_std),
        (GYRO_SCALE, gyro.scale_std),
        (ACCEL_TURN_ON, accel.bias_std),
        (ACCEL_IN_RUN, accel.instability_std),
        (ACCEL_SCALE, accel.scale_std),
    ] {
        block.places().for_each(|place| sigma[place] = value);
    }
    sigma[ATTITUDE.at(2)] = heading;
    sigma.into_iter().map(|sigma| sigma * sigma).collect()
}

/// Transition and noise from `from` to `to`, s, along the track.
pub(super) fn carried_on(
    spec: &ImuSpec,
    track: &Track,
    [from, to]: [f64; 2],
) -> (DMatrix<f64>, DMatrix<f64>) {
    discrete(&dynamics(spec, track, [from, to]), &noise(spec), to - from)
}

fn noise(spec: &ImuSpec) -> DMatrix<f64> {
    density(spec, INERTIAL, [VELOCITY, ATTITUDE, GYRO_IN_RUN, ACCEL_IN_RUN])
}

/// dp/dt = v, dv/dt = f x phi - 2 omega_ie x v + C (b + s f), dphi/dt = -omega_ie x phi + C (b + s omega): Groves, 2nd ed., section 14.2.4,
/// without what the turn of the axes adds in a few kilometres.
fn dynamics(spec: &ImuSpec, track: &Track, [from, to]: [f64; 2]) -> DMatrix<f64> {
    let (before, after, ship) = (track.at(from), track.at(to), track.at((from + to) / 2.0));
    let c_nb = c_ne(&ship.point) * ship.c_eb;
    let gravity = Vector3::z() * normal_gravity(ship.point.latitude, ship.point.height);
    let force = (after.velocity_n().0 - before.velocity_n().0) / (to - from) - gravity;
    let earth = cross(&rate_n(ship.point.latitude));
    let scaled = |of: Vector3<f64>| c_nb * Matrix3::from_diagonal(&of);
    let mut f = DMatrix::zeros(INERTIAL, INERTIAL);
    let mut put = |row: Block, column: Block, of: &Matrix3<f64>| {
        f.fixed_view_mut::<3, 3>(row.at(0), column.at(0)).copy_from(of);
    };
    put(POSITION, VELOCITY, &Matrix3::identity());
    put(VELOCITY, VELOCITY, &(earth * -2.0));
    put(VELOCITY, ATTITUDE, &cross(&force));
    put(ATTITUDE, ATTITUDE, &-earth);
    for (row, turn_on, in_run, scale, of) in [
        (VELOCITY, ACCEL_TURN_ON, ACCEL_IN_RUN, ACCEL_SCALE, c_nb.tr_mul(&force)),
        (ATTITUDE, GYRO_TURN_ON, GYRO_IN_RUN, GYRO_SCALE, ship.omega_eb),
    ] {
        put(row, turn_on, &c_nb);
        put(row, in_run, &c_nb);
        put(row, scale, &scaled(of));
    }
    let decay = |time: f64| Matrix3::identity() * (-1.0 / time);
    put(GYRO_IN_RUN, GYRO_IN_RUN, &decay(spec.gyro.instability_time));
    put(ACCEL_IN_RUN, ACCEL_IN_RUN, &decay(spec.accel.instability_time));
    f
}
