//! Propagation of the error covariance over a stretch of strapdown steps.
//!
//! x' = F x + w with, in ECEF axes (Groves, 2nd ed., section 14.2.3; signs for phi defined by
//! C_true = (I + [phi x]) C_estimated):
//!
//! dr' = dv,
//! dv' = G dr - 2 omega_ie x dv - f_e x phi - C_eb (b_a + d_a + diag(f_b) s_a),
//! phi' = - omega_ie x phi - C_eb (b_g + d_g + diag(omega_b) s_g),
//!
//! G the gravity gradient. Every other state is constant, a random walk or Gauss-Markov. Only the
//! nine strapdown rows of the transition matrix differ from a diagonal, and all three errors of a
//! triad enter through the same 9 x 3 matrix, which is what makes a step cheap.

use insd_base::attitude::skew;
use insd_base::earth;
use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

use crate::aids::reference_heading;
use crate::config::NavConfig;
use crate::error_state::{
    ACCEL_BIAS, ACCEL_DRIFT, ACCEL_SCALE, ATTITUDE, CURRENT, Covariance, GNSS_POSITION_ERROR,
    GNSS_VELOCITY_ERROR, GYRO_BIAS, GYRO_DRIFT, GYRO_SCALE, HEADING_ERROR, POSITION, SEA_LEVEL,
    STATES, STRAPDOWN_STATES, VELOCITY,
};
use crate::increments::Increment;
use crate::strapdown::Step;

type Transition = SMatrix<f64, STRAPDOWN_STATES, STRAPDOWN_STATES>;
type Input = SMatrix<f64, STRAPDOWN_STATES, 3>;
type Columns<const R: usize> = SMatrix<f64, R, STRAPDOWN_STATES>;

/// Sums over the strapdown steps since the covariance was last propagated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// Length, s.
    pub duration: f64,
    /// Integral of C_eb, s.
    pub c_eb: Matrix3<f64>,
    /// Integral of specific force in ECEF axes, m/s.
    pub force: Vector3<f64>,
    /// Integral of the body's angular rate, body axes, rad.
    pub rotation: Vector3<f64>,
    /// Integral of specific force, body axes, m/s.
    pub velocity: Vector3<f64>,
    /// Integral of the excess noise density of the rate, body axes, rad^2.
    pub rate_noise: Vector3<f64>,
    /// Integral of the excess noise density of the force, body axes, (m/s)^2.
    pub force_noise: Vector3<f64>,
    /// Length of the gap that a part of it was made up over, s; zero where none was.
    pub bridged: f64,
}

impl Stretch {
    /// Nothing yet.
    #[must_use]
    pub fn new() -> Self {
        Stretch {
            duration: 0.0,
            c_eb: Matrix3::zeros(),
            force: Vector3::zeros(),
            rotation: Vector3::zeros(),
            velocity: Vector3::zeros(),
            rate_noise: Vector3::zeros(),
            force_noise: Vector3::zeros(),
            bridged: 0.0,
        }
    }

    /// Adds a step.
    pub fn add(&mut self, step: &Step) {
        self.duration += step.duration;
        self.c_eb += step.c_eb * step.duration;
        self.force += step.c_eb * step.velocity;
        self.rotation += step.rotation;
        self.velocity += step.velocity;
    }

    /// Adds the noise of an increment beyond the stated random walks. A gap adds the same however
    /// often measurements and outputs cut it.
    pub fn add_noise(&mut self, increment: &Increment) {
        let duration = increment.duration();
        self.rate_noise += increment.rate_noise * duration;
        self.force_noise += increment.force_noise * duration;
        self.bridged = self.bridged.max(increment.bridged.unwrap_or(0.0));
    }
}

impl Default for Stretch {
    fn default() -> Self {
        Self::new()
    }
}

/// What the error models depend on at the moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Regime {
    /// GNSS positions come from fixed carrier ambiguities.
    pub rtk: bool,
}

/// The nine strapdown rows of the transition matrix over a stretch.
#[derive(Clone, Copy, Debug)]
pub struct StrapdownRows {
    /// Position, velocity and attitude into themselves.
    pub transition: Transition,
    /// Gyro errors, rad/s, into them.
    pub gyro: Input,
    /// Accelerometer errors, m/s^2, into them.
    pub accel: Input,
}

/// Transition of the strapdown errors over a stretch, second order in its length where velocity
/// feeds position and attitude feeds velocity.
#[must_use]
pub fn strapdown_rows(stretch: &Stretch, gradient: &Matrix3<f64>) -> StrapdownRows {
    let dt = stretch.duration;
    let turn = skew(&earth::rate_e()) * dt;
    let velocity_from_attitude = -skew(&stretch.force);
    let velocity_from_gyro = velocity_from_attitude * stretch.c_eb * -0.5;
    let mut transition = Transition::identity();
    let mut put = |row: usize, column: usize, m: &Matrix3<f64>| {
        transition.fixed_view_mut::<3, 3>(row, column).copy_from(m);
    };
    put(POSITION.start(), VELOCITY.start(), &(Matrix3::identity() * dt));
    put(POSITION.start(), ATTITUDE.start(), &(velocity_from_attitude * (0.5 * dt)));
    put(VELOCITY.start(), POSITION.start(), &(gradient * dt));
    put(VELOCITY.start(), VELOCITY.start(), &(Matrix3::identity() - turn * 2.0));
    put(VELOCITY.start(), ATTITUDE.start(), &velocity_from_attitude);
    put(ATTITUDE.start(), ATTITUDE.start(), &(Matrix3::identity() - turn));
    let mut gyro = Input::zeros();
    gyro.fixed_rows_mut::<3>(VELOCITY.start()).copy_from(&velocity_from_gyro);
    gyro.fixed_rows_mut::<3>(ATTITUDE.start()).copy_from(&-stretch.c_eb);
    let mut accel = Input::zeros();
    accel.fixed_rows_mut::<3>(POSITION.start()).copy_from(&(stretch.c_eb * (-0.5 * dt)));
    accel.fixed_rows_mut::<3>(VELOCITY.start()).copy_from(&-stretch.c_eb);
    StrapdownRows { transition, gyro, accel }
}

/// Propagates the covariance over a stretch: P <- Phi P Phi^T + Q.
pub fn propagate(
    p: &mut Covariance,
    stretch: &Stretch,
    gradient: &Matrix3<f64>,
    config: &NavConfig,
    regime: &Regime,
) {
    if stretch.duration <= 0.0 {
        return;
    }
    let rows = strapdown_rows(stretch, gradient);
    let columns = strapdown_columns(p, stretch, &rows);
    let corner = strapdown_corner(&columns, stretch, &rows);
    p.fixed_columns_mut::<STRAPDOWN_STATES>(0).copy_from(&columns);
    p.fixed_rows_mut::<STRAPDOWN_STATES>(0).copy_from(&columns.transpose());
    p.fixed_view_mut::<STRAPDOWN_STATES, STRAPDOWN_STATES>(0, 0).copy_from(&corner);
    relax_markov(p, stretch.duration, config, regime);
    add_noise(p, stretch, config);
}

/// Carries an effect on the errors, a row for each cause, over a stretch: U^T <- U^T Phi^T.
pub fn carry<const R: usize>(
    response: &mut SMatrix<f64, R, STATES>,
    stretch: &Stretch,
    gradient: &Matrix3<f64>,
    config: &NavConfig,
    regime: &Regime,
) {
    if stretch.duration <= 0.0 {
        return;
    }
    let columns = strapdown_columns(response, stretch, &strapdown_rows(stretch, gradient));
    response.fixed_columns_mut::<STRAPDOWN_STATES>(0).copy_from(&columns);
    for (start, end, _, time) in markov(config, regime) {
        response.columns_mut(start, end - start).scale_mut(markov_decay(stretch.duration, time));
    }
}

/// P Phi^T in the columns of the strapdown states, P the covariance or any rows beside it.
fn strapdown_columns<const R: usize>(
    p: &SMatrix<f64, R, STATES>,
    stretch: &Stretch,
    rows: &StrapdownRows,
) -> Columns<R> {
    let dt = stretch.duration;
    let own = p.fixed_columns::<STRAPDOWN_STATES>(0);
    let triad = |bias: usize, drift: usize, scale: usize, mean: Vector3<f64>| {
        let mut sum = p.fixed_columns::<3>(bias) + p.fixed_columns::<3>(drift);
        for axis in 0..3 {
            sum.column_mut(axis).axpy(mean[axis], &p.column(scale + axis), 1.0);
        }
        sum
    };
    let gyro =
        triad(GYRO_BIAS.start(), GYRO_DRIFT.start(), GYRO_SCALE.start(), stretch.rotation / dt);
    let accel =
        triad(ACCEL_BIAS.start(), ACCEL_DRIFT.start(), ACCEL_SCALE.start(), stretch.velocity / dt);
    own * rows.transition.transpose()
        + gyro * rows.gyro.transpose()
        + accel * rows.accel.transpose()
}

/// Phi (P Phi^T) in the rows and columns of the strapdown states, made symmetric.
fn strapdown_corner(
    columns: &Columns<STATES>,
    stretch: &Stretch,
    rows: &StrapdownRows,
) -> Transition {
    let dt = stretch.duration;
    let triad = |bias: usize, drift: usize, scale: usize, mean: Vector3<f64>| {
        let scaled = Matrix3::from_diagonal(&mean) * columns.fixed_rows::<3>(scale);
        columns.fixed_rows::<3>(bias) + columns.fixed_rows::<3>(drift) + scaled
    };
    let gyro =
        triad(GYRO_BIAS.start(), GYRO_DRIFT.start(), GYRO_SCALE.start(), stretch.rotation / dt);
    let accel =
        triad(ACCEL_BIAS.start(), ACCEL_DRIFT.start(), ACCEL_SCALE.start(), stretch.velocity / dt);
    let corner = rows.transition * columns.fixed_rows::<STRAPDOWN_STATES>(0)
        + rows.gyro * gyro
        + rows.accel * accel;
    (corner + corner.transpose()) * 0.5
}

/// Gauss-Markov states with their steady sigma and time constant.
fn markov(config: &NavConfig, regime: &Regime) -> [(usize, usize, f64, f64); 6] {
    let (gyro, accel) = (&config.imu.gyro, &config.imu.accel);
    [
        (GYRO_DRIFT.start(), GYRO_DRIFT.end(), gyro.instability_std, gyro.instability_time),
        (ACCEL_DRIFT.start(), ACCEL_DRIFT.end(), accel.instability_std, accel.instability_time),
        (
            GNSS_POSITION_ERROR.start(),
            GNSS_POSITION_ERROR.end(),
            1.0,
            config.gnss.position_time_for(regime.rtk),
        ),
        (GNSS_VELOCITY_ERROR.start(), GNSS_VELOCITY_ERROR.end(), 1.0, config.gnss.velocity_time),
        (CURRENT.start(), CURRENT.end(), config.log.current_std, config.log.current_time),
        (HEADING_ERROR.start(), HEADING_ERROR.end(), 1.0, reference_heading::TIME),
    ]
}

/// Share of a Gauss-Markov value that is left after `dt`.
#[must_use]
pub fn markov_decay(dt: f64, time_constant: f64) -> f64 {
    (-dt / time_constant).exp()
}

fn relax_markov(p: &mut Covariance, dt: f64, config: &NavConfig, regime: &Regime) {
    let mut decay = SVector::<f64, STATES>::repeat(1.0);
    let processes = markov(config, regime);
    for (start, end, _, time) in processes {
        let left = markov_decay(dt, time);
        decay.rows_mut(start, end - start).fill(left);
    }
    for (start, end, _, _) in processes {
        for i in start..end {
            let left = decay[i];
            p.column_mut(i).scale_mut(left);
            p.row_mut(i).scale_mut(left);
        }
    }
    for (start, end, std, _) in processes {
        for i in start..end {
            p[(i, i)] += std * std * (1.0 - decay[i] * decay[i]);
        }
    }
}

fn add_noise(p: &mut Covariance, stretch: &Stretch, config: &NavConfig) {
    let dt = stretch.duration;
    let angle = config.imu.gyro.random_walk.powi(2) * dt;
    let velocity = config.imu.accel.random_walk.powi(2) * dt;
    ATTITUDE.inflate(p, angle);
    VELOCITY.inflate(p, velocity);
    let c_eb = stretch.c_eb / dt;
    let in_ecef = |noise: &Vector3<f64>| c_eb * Matrix3::from_diagonal(noise) * c_eb.transpose();
    if stretch.rate_noise.amax() > 0.0 {
        ATTITUDE.add(p, &in_ecef(&stretch.rate_noise));
    }
    if stretch.force_noise.amax() > 0.0 {
        let velocity = in_ecef(&stretch.force_noise);
        VELOCITY.add(p, &velocity);
        if stretch.bridged > 0.0 {
            add_way(p, &velocity, dt);
        }
    }
    SEA_LEVEL.inflate(p, config.sea.level_walk.powi(2) * dt);
}

/// What an unknown change of the velocity, of a covariance that grew evenly over `dt` seconds, does to
/// the position meanwhile: V dt^2 / 3, and V dt / 2 with the velocity (Gelb, Applied Optimal Estimation,
/// example 3.7-1). In the short steps between samples it is nothing.
fn add_way(p: &mut Covariance, velocity: &Matrix3<f64>, dt: f64) {
    POSITION.add(p, &(velocity * (dt * dt / 3.0)));
    let cross = velocity * (0.5 * dt);
    let (r, v) = (POSITION.start(), VELOCITY.start());
    let mut block = p.fixed_view_mut::<3, 3>(r, v);
    block += cross;
    let mut block = p.fixed_view_mut::<3, 3>(v, r);
    block += cross.transpose();
}

#[cfg(test)]
mod tests;
