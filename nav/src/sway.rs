//! The slow swaying of a moored ship: she surges and sways on her moorings with periods of one to
//! three minutes.
//!
//! Each horizontal component is the sum of two damped oscillators driven by white noise, which
//! together cover the band as one of them would not:
//!
//! x'' + 2 zeta omega x' + omega^2 x = w,   E[w w] = 4 zeta omega^3 std^2 delta,
//!
//! with stationary covariance diag(std^2, omega^2 std^2) (Gelb, Applied Optimal Estimation, table
//! 2.3-1, second-order Gauss-Markov; in the sea: Fossen, Handbook of Marine Craft Hydrodynamics and
//! Motion Control, section 8.2.6). They are the shaping filter of the disturbance: over minutes it is
//! as bounded as the moorings are, which is what tells swaying from an error of the navigator.

use std::f64::consts::TAU;

use nalgebra::{Matrix2, Matrix4, Vector4};
use serde::{Deserialize, Serialize};

use crate::error_state::{Covariance, SWAY, SWAY_VELOCITY};
use crate::nominal::Nominal;

/// One damped oscillator, the same to the north and to the east.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Oscillator {
    /// Displacement, 1-sigma of each component, m.
    pub std: f64,
    /// Natural period, s.
    pub period: f64,
    /// Damping ratio, 0..1.
    pub damping: f64,
}

/// The oscillators of the swaying.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sway(pub [Oscillator; 2]);

impl Oscillator {
    fn omega(&self) -> f64 {
        TAU / self.period
    }

    /// Stationary covariance of displacement and velocity.
    fn stationary(&self) -> Matrix2<f64> {
        let variance = self.std * self.std;
        Matrix2::new(variance, 0.0, 0.0, variance * self.omega().powi(2))
    }

    /// Transition of (displacement, velocity) over `dt` seconds.
    #[must_use]
    pub fn transition(&self, dt: f64) -> Matrix2<f64> {
        let omega = self.omega();
        let decay = self.damping * omega;
        let damped = omega * (1.0 - self.damping * self.damping).max(1e-6).sqrt();
        let (sin, cos) = (damped * dt).sin_cos();
        let s = sin / damped;
        Matrix2::new(cos + decay * s, s, -omega * omega * s, cos - decay * s) * (-decay * dt).exp()
    }
}

impl Sway {
    /// Displacement of both together, 1-sigma of each component, m.
    #[must_use]
    pub fn std(&self) -> f64 {
        self.0[0].std.hypot(self.0[1].std)
    }

    /// Forgets what is known of the swaying: zero with the stationary covariance.
    pub fn begin(&self, nominal: &mut Nominal, p: &mut Covariance) {
        nominal.sway = Vector4::zeros();
        nominal.sway_velocity = Vector4::zeros();
        let diagonal = |k: usize| {
            Matrix4::from_diagonal(&Vector4::from_fn(|i, _| self.0[i / 2].stationary()[(k, k)]))
        };
        SWAY.renew(p, &diagonal(0));
        SWAY_VELOCITY.renew(p, &diagonal(1));
    }

    /// Carries the covariance over `dt` seconds; the noise is what keeps the process stationary.
    pub(crate) fn propagate(&self, p: &mut Covariance, dt: f64) {
        let places = p.layout().start(SWAY.key()).zip(p.layout().start(SWAY_VELOCITY.key()));
        let Some((sway, velocity)) = places else { return };
        for (oscillator, first) in self.0.iter().zip([0, 2]) {
            let phi = oscillator.transition(dt);
            let stationary = oscillator.stationary();
            let noise = stationary - phi * stationary * phi.transpose();
            for component in [first, first + 1] {
                p.carry_pair((sway + component, velocity + component), &phi, &noise);
            }
        }
    }

    /// Carries the expected swaying over `dt` seconds.
    pub(crate) fn relax(&self, nominal: &mut Nominal, dt: f64) {
        for i in 0..4 {
            let phi = self.0[i / 2].transition(dt);
            let (x, v) = (nominal.sway[i], nominal.sway_velocity[i]);
            nominal.sway[i] = phi[(0, 0)] * x + phi[(0, 1)] * v;
            nominal.sway_velocity[i] = phi[(1, 0)] * x + phi[(1, 1)] * v;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const SLOW: Oscillator = Oscillator { std: 0.4, period: 120.0, damping: 0.06 };
    const FAST: Oscillator = Oscillator { std: 0.2, period: 68.0, damping: 0.06 };

    #[test]
    fn two_short_steps_are_one_long_step() {
        let twice = SLOW.transition(1.5) * SLOW.transition(2.5);
        assert_relative_eq!(twice, SLOW.transition(4.0), epsilon = 1e-12);
    }

    #[test]
    fn the_process_stays_as_wide_as_it_is() {
        let mut p = Covariance::none();
        let mut nominal = Nominal::at(
            &insd_base::Geodetic::from_degrees(0.0, 0.0, 0.0),
            &nalgebra::Vector3::zeros(),
            &nalgebra::Matrix3::identity(),
        );
        let sway = Sway([FAST, SLOW]);
        sway.begin(&mut nominal, &mut p);
        let start = p.clone();
        for _ in 0..100 {
            sway.propagate(&mut p, 0.1);
        }
        assert!((p.matrix() - start.matrix()).amax() < 1e-12);
        let expected = Vector4::new(0.04, 0.04, 0.16, 0.16);
        assert_relative_eq!(SWAY.covariance(&p).diagonal(), expected, epsilon = 1e-12);
    }

    #[test]
    fn without_damping_the_swaying_returns_after_a_period() {
        let undamped = Oscillator { damping: 0.0, ..SLOW };
        assert_relative_eq!(undamped.transition(120.0), Matrix2::identity(), epsilon = 1e-6);
    }
}
