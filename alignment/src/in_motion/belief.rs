//! How sure the eight states are: their covariance, and that with the errors of the sensors, which
//! are *considered* but not estimated (Schmidt-Kalman filter: Schmidt, Application of State-Space
//! Methods to Navigation Problems, Advances in Control Systems 3 (1966)).
//!
//! A constant bias taken as white noise would be averaged away and the sigma would lie. Considered
//! errors keep their prior variance for ever, and every estimate remembers how it depends on them.
//! At the handover these memories become the correlations of the full filter.

use insd_nav::NavConfig;
use nalgebra::{Cholesky, DMatrix, Matrix2, SMatrix, SVector, Vector2};

/// Number of estimated errors.
pub const STATES: usize = 8;
/// Number of considered errors.
pub const CONSIDERED: usize = 18;

/// Where each estimated error stands; pairs are north, east.
pub mod state {
    /// Position, m.
    pub const POSITION: usize = 0;
    /// Velocity over the Earth, m/s.
    pub const VELOCITY: usize = POSITION + 2;
    /// Tilt, rotation about true north and east, rad.
    pub const TILT: usize = VELOCITY + 2;
    /// s = sin(dpsi).
    pub const SINE: usize = TILT + 2;
    /// c = 1 - cos(dpsi).
    pub const VERSINE: usize = SINE + 1;
}

/// Where each considered error stands. Horizontal errors of the hull are given as they would lie
/// along north and east if the *assumed* heading were zero: R(dpsi) times the error in body axes.
/// Their effect in true axes then does not depend on the unknown dpsi.
pub mod considered {
    /// Gyro bias, horizontal pair, rad/s.
    pub const GYRO: usize = 0;
    /// Gyro bias, down axis of the body, rad/s.
    pub const GYRO_DOWN: usize = GYRO + 2;
    /// Gyro scale factor, down axis of the body, ratio.
    pub const GYRO_SCALE_DOWN: usize = GYRO_DOWN + 1;
    /// Accelerometer bias, horizontal pair, m/s^2.
    pub const ACCEL: usize = GYRO_SCALE_DOWN + 1;
    /// Lever arm of the antenna, horizontal pair, m.
    pub const LEVER: usize = ACCEL + 2;
    /// Delay of GNSS epochs, s.
    pub const DELAY: usize = LEVER + 2;
    /// Delay of the GNSS velocity behind the position, s.
    pub const VELOCITY_DELAY: usize = DELAY + 1;
    /// Slow GNSS position error, north and east, sigmas.
    pub const SLOW_POSITION: usize = VELOCITY_DELAY + 1;
    /// Slow GNSS velocity error, north and east, sigmas.
    pub const SLOW_VELOCITY: usize = SLOW_POSITION + 2;
    /// Log scale factor, ratio.
    pub const LOG_SCALE: usize = SLOW_VELOCITY + 2;
    /// Log misalignment about the down axis, rad.
    pub const LOG_TURN: usize = LOG_SCALE + 1;
    /// Water current, north and east, m/s.
    pub const CURRENT: usize = LOG_TURN + 1;
}

use considered as k;

const _: () = assert!(state::VERSINE + 1 == STATES && k::CURRENT + 2 == CONSIDERED);

/// Errors, true minus estimated.
pub type Errors = SVector<f64, STATES>;
/// Their covariance.
pub type Covariance = SMatrix<f64, STATES, STATES>;
/// Covariance of estimated (rows) with considered errors (columns).
pub type Cross = SMatrix<f64, STATES, CONSIDERED>;
/// One value for each considered error.
pub type PerConsidered = SVector<f64, CONSIDERED>;

/// Specific force that a scale factor leaks through a list of 3 deg, m/s^2 per ratio.
const LEAK: f64 = 9.8 * 0.05;

/// Covariances of the eight states.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Belief {
    /// Of the eight.
    pub own: Covariance,
    /// Of the eight with the considered errors.
    pub cross: Cross,
    /// Prior variances of the considered errors, which are independent of each other.
    pub prior: PerConsidered,
}

/// What a stretch of time does to the errors: x <- F x + G (considered) + noise(Q), considered errors
/// decaying by `decay`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transition {
    /// F.
    pub f: Covariance,
    /// G.
    pub g: Cross,
    /// Q.
    pub q: Covariance,
    /// Share of each considered error that is left.
    pub decay: PerConsidered,
}

/// Measured minus predicted: z = H x + H_c (considered) + noise(R).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Innovation<const M: usize> {
    /// z.
    pub z: SVector<f64, M>,
    /// H.
    pub h: SMatrix<f64, M, STATES>,
    /// H_c.
    pub hc: SMatrix<f64, M, CONSIDERED>,
    /// R.
    pub r: SMatrix<f64, M, M>,
    /// Variance of the noise in what H takes for the motion of the hull, in the units of z.
    pub blur: f64,
}

/// An innovation weighed against a belief.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weighed<const M: usize> {
    /// What a unit of each component moves the eight by.
    pub gain: SMatrix<f64, STATES, M>,
    /// Covariance of the innovation.
    pub s: SMatrix<f64, M, M>,
    /// Normalised innovation squared.
    pub nis: f64,
    /// Half the logarithm of det S.
    pub log_root_determinant: f64,
}

impl Belief {
    /// Nothing known of the eight; the considered errors as the configuration has them.
    #[must_use]
    pub fn new(config: &NavConfig) -> Self {
        let square = |v: f64| v * v;
        let (gyro, accel) = (&config.imu.gyro, &config.imu.accel);
        let gyro_variance = square(gyro.bias_std) + square(gyro.instability_std);
        let accel_variance =
            square(accel.bias_std) + square(accel.instability_std) + square(accel.scale_std * LEAK);
        let mut prior = PerConsidered::zeros();
        let mut put = |at: usize, width: usize, variance: f64| {
            prior.rows_mut(at, width).fill(variance);
        };
        put(k::GYRO, 3, gyro_variance);
        put(k::GYRO_SCALE_DOWN, 1, square(gyro.scale_std));
        put(k::ACCEL, 2, accel_variance);
        put(k::LEVER, 2, square(config.gnss_lever_std()));
        put(k::DELAY, 1, square(config.gnss.delay_std));
        put(k::VELOCITY_DELAY, 1, square(config.gnss.velocity_delay_std));
        put(k::SLOW_POSITION, 4, 1.0);
        put(k::LOG_SCALE, 1, square(config.log.scale_std));
        put(k::LOG_TURN, 1, square(config.log.misalignment_std));
        put(k::CURRENT, 2, square(config.log.current_std));
        Belief { own: Covariance::zeros(), cross: Cross::zeros(), prior }
    }

    /// What all errors have to do with each other beyond what is known of the considered ones by themselves.
    #[must_use]
    pub fn joint(&self) -> DMatrix<f64> {
        let mut joint = DMatrix::zeros(STATES + CONSIDERED, STATES + CONSIDERED);
        joint.fixed_view_mut::<STATES, STATES>(0, 0).copy_from(&self.own);
        joint.fixed_view_mut::<STATES, CONSIDERED>(0, STATES).copy_from(&self.cross);
        joint.fixed_view_mut::<CONSIDERED, STATES>(STATES, 0).copy_from(&self.cross.transpose());
        joint
    }

    /// Sets the variance of a pair and forgets its correlations.
    pub fn renew_pair(&mut self, at: usize, variance: f64) {
        for i in at..at + 2 {
            self.own.row_mut(i).fill(0.0);
            self.own.column_mut(i).fill(0.0);
            self.cross.row_mut(i).fill(0.0);
            self.own[(i, i)] = variance;
        }
    }

    /// Takes the error of a pair as that of a considered pair times a matrix, and noise of a variance.
    pub fn tie_pair(&mut self, at: usize, considered: usize, by: &Matrix2<f64>, variance: f64) {
        let prior = self.prior[considered];
        let with_others = by * self.cross.fixed_columns::<2>(considered).transpose();
        self.renew_pair(at, 0.0);
        let own = by * by.transpose() * prior + Matrix2::from_diagonal_element(variance);
        self.own.fixed_rows_mut::<2>(at).copy_from(&with_others);
        self.own.fixed_columns_mut::<2>(at).copy_from(&with_others.transpose());
        self.own.fixed_view_mut::<2, 2>(at, at).copy_from(&own);
        self.cross.fixed_view_mut::<2, 2>(at, considered).copy_from(&(by * prior));
    }

    /// Forgets how the estimate depends on a considered pair, which is about to be another one.
    pub fn forget_considered_pair(&mut self, at: usize) {
        self.cross.columns_mut(at, 2).fill(0.0);
    }

    /// Another sensor has another considered pair, of this variance.
    pub fn renew_considered_pair(&mut self, at: usize, variance: f64) {
        self.forget_considered_pair(at);
        self.prior.rows_mut(at, 2).fill(variance);
    }

    /// Carries the belief over a stretch of time.
    pub fn propagate(&mut self, transition: &Transition) {
        let Transition { f, g, q, decay } = transition;
        let g_prior = scaled(g, &self.prior);
        let carried = f * self.cross;
        let mixed = carried * g.transpose();
        self.own =
            f * self.own * f.transpose() + mixed + mixed.transpose() + g_prior * g.transpose() + q;
        self.cross = scaled(&(carried + g_prior), decay);
        self.own = (self.own + self.own.transpose()) * 0.5;
    }

    /// The belief in other coordinates, x' = T x.
    pub fn transform(&mut self, t: &Covariance) {
        self.own = t * self.own * t.transpose();
        self.cross = t * self.cross;
    }

    /// Turns a considered pair with the axes it is given in.
    pub fn turn_considered_pair(&mut self, at: usize, rotation: &Matrix2<f64>) {
        let turned = self.cross.fixed_columns::<2>(at) * rotation.transpose();
        self.cross.fixed_columns_mut::<2>(at).copy_from(&turned);
    }

    /// Weighs an innovation; `None` if it is not finite or its covariance not positive definite.
    #[must_use]
    pub fn weigh<const M: usize>(&self, innovation: &Innovation<M>) -> Option<Weighed<M>> {
        let Innovation { z, h, hc, r, .. } = innovation;
        if !z.iter().all(|v| v.is_finite()) {
            return None;
        }
        let to_state = self.own * h.transpose() + self.cross * hc.transpose();
        let to_considered = h * self.cross + scaled(hc, &self.prior);
        let s = h * to_state + to_considered * hc.transpose() + r;
        let s = (s + s.transpose()) * 0.5;
        let factor = Cholesky::new(s)?;
        let gain = factor.solve(&to_state.transpose()).transpose();
        let nis = z.dot(&factor.solve(z));
        let log_root_determinant = factor.l_dirty().diagonal().iter().map(|d| d.ln()).sum();
        Some(Weighed { gain, s, nis, log_root_determinant })
    }

    /// Updates the belief and returns the estimated errors.
    #[must_use]
    pub fn absorb<const M: usize>(
        &mut self,
        innovation: &Innovation<M>,
        weighed: &Weighed<M>,
    ) -> Errors {
        let Innovation { z, h, hc, .. } = innovation;
        let gain = &weighed.gain;
        let seen = h * self.cross + scaled(hc, &self.prior);
        self.own -= gain * weighed.s * gain.transpose();
        self.own = (self.own + self.own.transpose()) * 0.5;
        self.cross -= gain * seen;
        gain * z
    }

    /// Covariance of (1-c, s), as the regression has it.
    #[must_use]
    pub fn direction_covariance(&self) -> Matrix2<f64> {
        let p = &self.own;
        let across = -p[(state::SINE, state::VERSINE)];
        let (sine, versine) = (p[(state::SINE, state::SINE)], p[(state::VERSINE, state::VERSINE)]);
        Matrix2::new(versine, across, across, sine)
    }

    /// Variances of north and east of a pair.
    #[must_use]
    pub fn pair(&self, at: usize) -> Vector2<f64> {
        Vector2::new(self.own[(at, at)].max(0.0), self.own[(at + 1, at + 1)].max(0.0))
    }
}

impl<const M: usize> Weighed<M> {
    /// Expected 1-sigma of each component.
    #[must_use]
    pub fn sigma(&self) -> SVector<f64, M> {
        self.s.diagonal().map(|v| v.max(0.0).sqrt())
    }
}

/// Columns multiplied by the components of a vector.
fn scaled<const M: usize>(
    m: &SMatrix<f64, M, CONSIDERED>,
    by: &PerConsidered,
) -> SMatrix<f64, M, CONSIDERED> {
    SMatrix::from_fn(|row, column| m[(row, column)] * by[column])
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::{ImuSpec, LeverArms, Triad};

    /// Both together, and how it is after a pair was tied to the lever arm.
    #[test]
    fn a_pair_that_is_tied_to_a_considered_one_leaves_a_covariance() {
        let triad = Triad {
            bias_std: 1e-7,
            instability_std: 1e-8,
            instability_time: 100.0,
            random_walk: 1e-6,
            scale_std: 1e-5,
        };
        let imu = ImuSpec { rate: 100.0, gyro: triad, accel: triad };
        let mut belief = Belief::new(&NavConfig::new(imu, LeverArms::default()));
        let lever = considered::LEVER;
        belief.renew_pair(state::VELOCITY, 0.01);
        belief.cross[(state::VELOCITY, lever)] = 1.5;
        belief.cross[(state::VELOCITY + 1, lever + 1)] = -1.5;
        let by = Matrix2::new(0.6, -0.8, 0.8, 0.6);
        belief.tie_pair(state::POSITION, lever, &by, 0.25);
        let prior = belief.prior[lever];
        assert!((belief.own[(state::POSITION, state::POSITION)] - prior - 0.25).abs() < 1e-9);
        let (p, v) = (state::POSITION, state::VELOCITY);
        assert!((belief.own[(p, v)] - 0.6 * 1.5).abs() < 1e-12);
        assert_eq!(belief.own, belief.own.transpose());
        // what is left of the position, its tie taken away, is the noise alone
        let tied = by * belief.cross.fixed_view::<2, 2>(p, lever).transpose();
        let left = belief.own.fixed_view::<2, 2>(p, p) - tied;
        assert!((left - Matrix2::from_diagonal_element(0.25)).amax() < 1e-6, "{left}");
    }
}
