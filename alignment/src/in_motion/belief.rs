//! How sure the eight states are: their covariance, and that with the errors of the sensors, which
//! are *considered* but not estimated (Schmidt-Kalman filter: Schmidt, Application of State-Space
//! Methods to Navigation Problems, Advances in Control Systems 3 (1966)).
//!
//! A constant bias taken as white noise would be averaged away and the sigma would lie. Considered
//! errors keep their prior variance for ever, and every estimate remembers how it depends on them.
//! At the handover these memories become the correlations of the full filter.

use insd_estimation::{Block, Decay, Feed, Innovation, Jacobian, Transition, Weighed};
use insd_nav::NavConfig;
use nalgebra::{DMatrix, Matrix2, SMatrix, SVector, Vector2, Vector3};

/// Number of estimated errors.
pub const STATES: usize = 8;
/// Number of considered errors.
pub const CONSIDERED: usize = 18;
/// Those of gyros and accelerometers, which come first.
pub const INERTIAL: usize = 6;

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

/// The estimated errors as the kernel knows them.
pub const OWN: Block<STATES> = Block::new(0);
/// The considered errors.
pub const OF_SENSORS: Block<CONSIDERED> = Block::new(1);

/// Errors, true minus estimated.
pub type OwnErrors = SVector<f64, STATES>;
/// Their covariance.
pub type OwnCovariance = SMatrix<f64, STATES, STATES>;
/// Covariance of estimated (rows) with considered errors (columns).
pub type Cross = SMatrix<f64, STATES, CONSIDERED>;
/// One value for each considered error.
pub type PerConsidered = SVector<f64, CONSIDERED>;

/// Specific force that a scale factor leaks through a list of 3 deg, m/s^2 per ratio.
const LEAK: f64 = 9.8 * 0.05;

/// Covariances of the eight states.
#[derive(Clone, Debug, PartialEq)]
pub struct Belief {
    /// Of both kinds of errors.
    all: insd_estimation::Covariance,
    /// Prior variances of the considered errors, which are independent of each other.
    pub prior: PerConsidered,
}

/// What a stretch of time does to the errors: x <- F x + G (considered) + noise(Q), considered errors
/// decaying by `decay`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretched {
    /// F.
    pub f: OwnCovariance,
    /// G, of the considered errors of gyros and accelerometers: the first six.
    pub g: SMatrix<f64, STATES, INERTIAL>,
    /// Q.
    pub q: OwnCovariance,
    /// Share of each considered error that is left.
    pub decay: PerConsidered,
}

/// An innovation of what depends on the estimated errors by `h`, on the considered ones by `hc`.
#[must_use]
pub fn innovation<const M: usize>(
    z: &SVector<f64, M>,
    h: &SMatrix<f64, M, STATES>,
    hc: &SMatrix<f64, M, CONSIDERED>,
    r: &SMatrix<f64, M, M>,
) -> Innovation {
    Innovation::new(z, Jacobian::none(M).with(OWN, h).with(OF_SENSORS, hc), r)
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
        let mut all = insd_estimation::Covariance::none();
        all.join(OWN, &OwnCovariance::zeros());
        all.join(OF_SENSORS, &SMatrix::from_diagonal(&prior));
        Belief { all, prior }
    }

    /// Of the eight.
    #[must_use]
    pub fn own(&self) -> OwnCovariance {
        OWN.covariance(&self.all)
    }

    /// Of the eight with the considered errors.
    #[must_use]
    pub fn cross(&self) -> Cross {
        OWN.covariance_with(OF_SENSORS, &self.all)
    }

    /// What all errors have to do with each other beyond what is known of the considered ones by themselves.
    #[must_use]
    pub fn joint(&self) -> DMatrix<f64> {
        let mut joint = self.all.matrix().clone();
        joint.fixed_view_mut::<CONSIDERED, CONSIDERED>(STATES, STATES).fill(0.0);
        joint
    }

    /// Changes the covariance of an estimated error, at least to a variance.
    pub fn allow(&mut self, state: usize, variance: f64) {
        let own = &mut self.all.matrix_mut()[(state, state)];
        *own = own.max(variance);
    }

    /// Sets the variance of a pair and forgets its correlations.
    pub fn renew_pair(&mut self, at: usize, variance: f64) {
        self.forget(at);
        self.all.matrix_mut().fixed_view_mut::<2, 2>(at, at).fill_diagonal(variance);
    }

    /// Sets how a pair hangs together with a considered one.
    pub fn correlate_pair(&mut self, at: usize, considered: usize, with: &Matrix2<f64>) {
        let (own, p) = (STATES + considered, self.all.matrix_mut());
        p.fixed_view_mut::<2, 2>(at, own).copy_from(with);
        p.fixed_view_mut::<2, 2>(own, at).copy_from(&with.transpose());
    }

    /// Takes the error of a pair as that of a considered pair times a matrix, and noise of a variance.
    pub fn tie_pair(&mut self, at: usize, considered: usize, by: &Matrix2<f64>, variance: f64) {
        self.forget(at);
        let p = self.all.matrix_mut();
        let rows = by * p.fixed_rows::<2>(STATES + considered);
        p.fixed_rows_mut::<2>(at).copy_from(&rows);
        let columns = p.fixed_columns::<2>(STATES + considered) * by.transpose();
        p.fixed_columns_mut::<2>(at).copy_from(&columns);
        (at..at + 2).for_each(|i| p[(i, i)] += variance);
    }

    /// Forgets how the estimate depends on a considered pair, which is about to be another one.
    pub fn forget_considered_pair(&mut self, at: usize) {
        self.forget(STATES + at);
        let variance = self.prior.fixed_rows::<2>(at).into_owned();
        let p = self.all.matrix_mut();
        (0..2).for_each(|i| p[(STATES + at + i, STATES + at + i)] = variance[i]);
    }

    /// Another sensor has another considered pair, of this variance.
    pub fn renew_considered_pair(&mut self, at: usize, variance: f64) {
        self.prior.rows_mut(at, 2).fill(variance);
        self.forget_considered_pair(at);
    }

    /// Of a pair, by its index among all errors, nothing is known.
    fn forget(&mut self, at: usize) {
        let p = self.all.matrix_mut();
        p.fixed_rows_mut::<2>(at).fill(0.0);
        p.fixed_columns_mut::<2>(at).fill(0.0);
    }

    /// Carries the belief over a stretch of time.
    pub fn propagate(&mut self, stretched: &Stretched) {
        let by = |first: usize| stretched.g.fixed_columns::<3>(first).into_owned();
        let from = |first: usize| [(STATES + first, Vector3::repeat(1.0))];
        let (gyro, accel) = (from(0), from(3));
        let feeds = [Feed { by: by(0), from: &gyro }, Feed { by: by(3), from: &accel }];
        let decay = |at: usize| Decay {
            start: STATES + at,
            width: 1,
            left: stretched.decay[at],
            steady: self.prior[at],
        };
        let mut decays = [Decay::NONE; CONSIDERED];
        let mut count = 0;
        for at in (0..CONSIDERED).filter(|at| stretched.decay[*at] < 1.0) {
            decays[count] = decay(at);
            count += 1;
        }
        let transition = Transition { head: stretched.f, feeds: &feeds, decays: &decays[..count] };
        transition.propagate(&mut self.all);
        OWN.add(&mut self.all, &stretched.q);
    }

    /// The belief in other coordinates, x' = T x.
    pub fn transform(&mut self, t: &OwnCovariance) {
        OWN.transform(&mut self.all, t);
    }

    /// Turns a considered pair with the axes it is given in.
    pub fn turn_considered_pair(&mut self, at: usize, rotation: &Matrix2<f64>) {
        let (start, p) = (STATES + at, self.all.matrix_mut());
        let columns = p.fixed_view::<STATES, 2>(0, start) * rotation.transpose();
        p.fixed_view_mut::<STATES, 2>(0, start).copy_from(&columns);
        p.fixed_view_mut::<2, STATES>(start, 0).copy_from(&columns.transpose());
    }

    /// Weighs an innovation; `None` if it is not finite or its covariance not positive definite.
    #[must_use]
    pub fn weigh(&self, innovation: &Innovation) -> Option<Weighed> {
        innovation.weigh(&self.all)
    }

    /// Updates the belief and returns the estimated errors.
    #[must_use]
    pub fn absorb(&mut self, weighed: &Weighed) -> OwnErrors {
        weighed.update_considering(&mut self.all, &[OF_SENSORS.key()]).of(OWN)
    }

    /// Covariance of (1-c, s), as the regression has it.
    #[must_use]
    pub fn direction_covariance(&self) -> Matrix2<f64> {
        let p = self.own();
        let across = -p[(state::SINE, state::VERSINE)];
        let (sine, versine) = (p[(state::SINE, state::SINE)], p[(state::VERSINE, state::VERSINE)]);
        Matrix2::new(versine, across, across, sine)
    }

    /// Variances of north and east of a pair.
    #[must_use]
    pub fn pair(&self, at: usize) -> Vector2<f64> {
        let p = self.all.matrix();
        Vector2::new(p[(at, at)].max(0.0), p[(at + 1, at + 1)].max(0.0))
    }
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
        belief.correlate_pair(state::VELOCITY, lever, &Matrix2::new(1.5, 0.0, 0.0, -1.5));
        let by = Matrix2::new(0.6, -0.8, 0.8, 0.6);
        belief.tie_pair(state::POSITION, lever, &by, 0.25);
        let prior = belief.prior[lever];
        let (own, cross) = (belief.own(), belief.cross());
        assert!((own[(state::POSITION, state::POSITION)] - prior - 0.25).abs() < 1e-9);
        let (p, v) = (state::POSITION, state::VELOCITY);
        assert!((own[(p, v)] - 0.6 * 1.5).abs() < 1e-12);
        assert_eq!(own, own.transpose());
        // what is left of the position, its tie taken away, is the noise alone
        let tied = by * cross.fixed_view::<2, 2>(p, lever).transpose();
        let left = own.fixed_view::<2, 2>(p, p) - tied;
        assert!((left - Matrix2::from_diagonal_element(0.25)).amax() < 1e-6, "{left}");
    }
}
