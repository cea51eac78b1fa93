//! The clock of a receiver: an offset that drifts.
//!
//! c' = d + w_c, d' = w_d; over dt: Phi = [1 dt; 0 1], Q = [S_c dt + S_d dt^3 / 3, S_d dt^2 / 2; S_d dt^2 / 2, S_d dt] (Brown and Hwang, Introduction to
//! Random Signals and Applied Kalman Filtering, 4th ed., eqs. (9.3.2) to (9.3.4)). Nothing else depends on it, so that it is carried only when ranges are looked at.

use nalgebra::{Matrix2, SMatrix, Vector2};

use crate::config::RangeModel;
use crate::error_state::{Covariance, PHASE_CONSTANTS, PHASE_DRIFTS, RECEIVER_CLOCK};
use crate::nominal::Nominal;

/// Carries the clock over some seconds.
pub(crate) fn carry(nominal: &mut Nominal, p: &mut Covariance, model: &RangeModel, dt: f64) {
    let phi = Matrix2::new(1.0, dt, 0.0, 1.0);
    nominal.receiver_clock = phi * nominal.receiver_clock;
    RECEIVER_CLOCK.transform(p, &phi);
    let (offset, drift) = (model.clock_walk.powi(2), model.drift_walk.powi(2));
    let between = drift * dt * dt / 2.0;
    let q = Matrix2::new(offset * dt + drift * dt.powi(3) / 3.0, between, between, drift * dt);
    RECEIVER_CLOCK.add(p, &q);
}

/// Carries the constants of phases along their drifts over some seconds: k' = r.
pub(crate) fn carry_constants(nominal: &mut Nominal, p: &mut Covariance, dt: f64) {
    nominal.phase_constants += nominal.phase_drifts * dt;
    PHASE_DRIFTS.add_to(PHASE_CONSTANTS, p, &SMatrix::from_diagonal_element(dt));
}

/// Forgets the offset; `drift` tells whether the drift is forgotten as well.
pub(crate) fn renew(nominal: &mut Nominal, p: &mut Covariance, offset: f64, drift: Option<f64>) {
    const UNKNOWN_OFFSET: f64 = 1e3;
    const UNKNOWN_DRIFT: f64 = 300.0;
    match drift {
        Some(drift) => {
            nominal.receiver_clock = Vector2::new(offset, drift);
            let variances = Vector2::new(UNKNOWN_OFFSET, UNKNOWN_DRIFT).map(|std| std * std);
            RECEIVER_CLOCK.renew(p, &Matrix2::from_diagonal(&variances));
        }
        None => {
            nominal.receiver_clock.x = offset;
            p.renew_state(RECEIVER_CLOCK.key(), 0, UNKNOWN_OFFSET * UNKNOWN_OFFSET);
        }
    }
}
