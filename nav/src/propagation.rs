//! Propagation of the error covariance over a stretch of strapdown steps.
//!
//! x' = F x + w with, in ECEF axes (Groves, 2nd ed., section 14.2.3; signs for phi defined by
//! C_true = (I + [phi x]) C_estimated):
//!
//! dr' = dv,
//! dv' = G dr - 2 omega_ie x dv - f_e x phi - C_eb (b_a + d_a + diag(f_b) s_a + h_a w + k_a w^2),
//! phi' = - omega_ie x phi - C_eb (b_g + d_g + diag(omega_b) s_g + h_g w + k_g w^2),
//!
//! G the gravity gradient, w by how much the IMU is warmer than where h and k were begun. Every other state is constant, a random walk or Gauss-Markov. Only the
//! nine strapdown rows of the transition matrix differ from a diagonal, and all three errors of a
//! triad enter through the same 9 x 3 matrix, which is what makes a step cheap.

use insd_base::attitude::skew;
use insd_base::earth;
use insd_estimation::{Decay, Feed, Layout, Place, Transition};
use nalgebra::{Matrix3, SMatrix, Vector3};

use crate::config::NavConfig;
use crate::declaration::{Process, Regime};
use crate::error_state::{
    ACCEL_BIAS, ACCEL_DRIFT, ACCEL_SCALE, ACCEL_THERMAL, ACCEL_THERMAL_BEND, ATTITUDE, Block,
    Covariance, DECLARATIONS, Effects, Errors, GYRO_BIAS, GYRO_DRIFT, GYRO_SCALE, GYRO_THERMAL,
    GYRO_THERMAL_BEND, POSITION, STRAPDOWN_STATES, VELOCITY, declaration,
};
use crate::increments::Increment;
use crate::nominal::Nominal;
use crate::strapdown::Step;

/// Errors of a triad that every ship carries, and all: bias, drift, scale factor, and what the temperature does by itself and by its square.
const TRIAD_ALWAYS: usize = 3;
const TRIAD: usize = 5;
const GYRO_ERRORS: [Block<3>; TRIAD] =
    [GYRO_BIAS, GYRO_DRIFT, GYRO_SCALE, GYRO_THERMAL, GYRO_THERMAL_BEND];
const ACCEL_ERRORS: [Block<3>; TRIAD] =
    [ACCEL_BIAS, ACCEL_DRIFT, ACCEL_SCALE, ACCEL_THERMAL, ACCEL_THERMAL_BEND];

type Head = SMatrix<f64, STRAPDOWN_STATES, STRAPDOWN_STATES>;
type Input = SMatrix<f64, STRAPDOWN_STATES, 3>;

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

/// Where the strapdown errors stand: at the head, in this order.
const POSITION_AT: usize = 0;
const VELOCITY_AT: usize = POSITION_AT + 3;
const ATTITUDE_AT: usize = VELOCITY_AT + 3;

/// The nine strapdown rows of the transition matrix over a stretch.
#[derive(Clone, Copy, Debug)]
pub struct StrapdownRows {
    /// Position, velocity and attitude into themselves.
    pub transition: Head,
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
    let mut transition = Head::identity();
    let mut put = |row: usize, column: usize, m: &Matrix3<f64>| {
        transition.fixed_view_mut::<3, 3>(row, column).copy_from(m);
    };
    put(POSITION_AT, VELOCITY_AT, &(Matrix3::identity() * dt));
    put(POSITION_AT, ATTITUDE_AT, &(velocity_from_attitude * (0.5 * dt)));
    put(VELOCITY_AT, POSITION_AT, &(gradient * dt));
    put(VELOCITY_AT, VELOCITY_AT, &(Matrix3::identity() - turn * 2.0));
    put(VELOCITY_AT, ATTITUDE_AT, &velocity_from_attitude);
    put(ATTITUDE_AT, ATTITUDE_AT, &(Matrix3::identity() - turn));
    let mut gyro = Input::zeros();
    gyro.fixed_rows_mut::<3>(VELOCITY_AT).copy_from(&velocity_from_gyro);
    gyro.fixed_rows_mut::<3>(ATTITUDE_AT).copy_from(&-stretch.c_eb);
    let mut accel = Input::zeros();
    accel.fixed_rows_mut::<3>(POSITION_AT).copy_from(&(stretch.c_eb * (-0.5 * dt)));
    accel.fixed_rows_mut::<3>(VELOCITY_AT).copy_from(&-stretch.c_eb);
    StrapdownRows { transition, gyro, accel }
}

/// A stretch of the voyage, and what the errors of an estimate go through in it.
#[derive(Clone, Copy, Debug)]
pub struct Passage<'a> {
    /// The stretch.
    pub stretch: &'a Stretch,
    /// Gradient of gravity, ECEF axes, 1/s^2.
    pub gradient: &'a Matrix3<f64>,
    /// The error models.
    pub config: &'a NavConfig,
    /// What they depend on at the moment.
    pub regime: Regime,
}

/// A passage worked out for states that stand in an order: whatever has these states goes along.
#[derive(Clone, Copy, Debug)]
pub struct Passing<'a> {
    transition: Transition<'a, STRAPDOWN_STATES>,
    layout: &'a Layout,
    passage: &'a Passage<'a>,
}

impl Passage<'_> {
    /// Propagates a covariance: P <- Phi P Phi^T + Q.
    pub fn propagate(&self, p: &mut Covariance) {
        self.over(&p.layout().clone(), |passing| passing.covariance(p));
    }

    /// Works the transition out for states that stand so, and hands it to who goes along. Nobody goes nowhere.
    pub fn over(&self, layout: &Layout, along: impl FnOnce(&Passing<'_>)) {
        let dt = self.stretch.duration;
        if dt <= 0.0 {
            return;
        }
        let rows = strapdown_rows(self.stretch, self.gradient);
        let warmer = self.regime.warmer;
        let triad = |blocks: [Block<3>; TRIAD], integral: Vector3<f64>| {
            let [bias, heat, bend] = [1.0, warmer, warmer * warmer].map(Vector3::repeat);
            let scales = [bias, bias, integral / dt, heat, bend];
            let start = |i: usize| layout.start(blocks[i].key()).unwrap_or(layout.states());
            std::array::from_fn::<_, TRIAD, _>(|i| (start(i), scales[i]))
        };
        let gyro = triad(GYRO_ERRORS, self.stretch.rotation);
        let accel = triad(ACCEL_ERRORS, self.stretch.velocity);
        let carried = if layout.start(GYRO_THERMAL.key()).is_some() { TRIAD } else { TRIAD_ALWAYS };
        let feeds = [
            Feed { by: rows.gyro, from: &gyro[..carried] },
            Feed { by: rows.accel, from: &accel[..carried] },
        ];
        let mut decays = [Decay::NONE; DECLARATIONS.len()];
        let mut count = 0;
        for (place, std, time) in markov(layout, self.config, &self.regime) {
            let (start, width) = (place.start, place.width);
            decays[count] = Decay { start, width, left: markov_decay(dt, time), steady: std * std };
            count += 1;
        }
        let transition =
            Transition { head: rows.transition, feeds: &feeds, decays: &decays[..count] };
        along(&Passing { transition, layout, passage: self });
    }
}

impl Passing<'_> {
    /// A covariance of these states: P <- Phi P Phi^T + Q.
    pub fn covariance(&self, p: &mut Covariance) {
        let Passage { stretch, config, regime, .. } = self.passage;
        self.transition.propagate(p);
        add_noise(p, stretch, config, regime);
    }

    /// The effects of causes on the errors of these states: U^T <- U^T Phi^T.
    pub fn effects(&self, effects: &mut Effects) {
        effects.conform(self.layout);
        self.transition.carry(effects);
    }

    /// Errors of these states: x <- Phi x.
    pub fn errors(&self, errors: &mut Errors) {
        errors.conform(self.layout);
        self.transition.carry_errors(errors);
    }
}

/// Gauss-Markov states that are there, with their steady sigma and time constant.
fn markov<'a>(
    layout: &'a Layout,
    config: &'a NavConfig,
    regime: &'a Regime,
) -> impl Iterator<Item = (Place, f64, f64)> + 'a {
    let process = |place: &Place| match (declaration(place.key)?.process)(config, regime) {
        Process::Markov { std, time } => Some((*place, std, time)),
        _ => None,
    };
    layout.places().iter().filter_map(process)
}

/// Share of a Gauss-Markov value that is left after `dt`.
#[must_use]
pub fn markov_decay(dt: f64, time_constant: f64) -> f64 {
    (-dt / time_constant).exp()
}

/// The expected values of Gauss-Markov states that are carried decay as the states do.
pub fn relax(
    nominal: &mut Nominal,
    dt: f64,
    (layout, config): (&Layout, &NavConfig),
    regime: &Regime,
) {
    for declared in layout.places().iter().filter_map(|place| declaration(place.key)) {
        if let Process::Markov { time, .. } = (declared.process)(config, regime) {
            let left = markov_decay(dt, time);
            declared.value(nominal).iter_mut().for_each(|value| *value *= left);
        }
    }
}

fn add_noise(p: &mut Covariance, stretch: &Stretch, config: &NavConfig, regime: &Regime) {
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
    for declared in &DECLARATIONS {
        if let Process::Walk(density) = (declared.process)(config, regime) {
            p.inflate(declared.key, density * density * dt);
        }
    }
}

/// What an unknown change of the velocity, of a covariance that grew evenly over `dt` seconds, does to
/// the position meanwhile: V dt^2 / 3, and V dt / 2 with the velocity (Gelb, Applied Optimal Estimation,
/// example 3.7-1). In the short steps between samples it is nothing.
fn add_way(p: &mut Covariance, velocity: &Matrix3<f64>, dt: f64) {
    POSITION.add(p, &(velocity * (dt * dt / 3.0)));
    POSITION.add_between(VELOCITY, p, &(velocity * (0.5 * dt)));
}

#[cfg(test)]
mod tests;
