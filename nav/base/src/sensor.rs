//! Error models and mounting of the sensors: what a data sheet and an installer state.

use crate::frames::Body;

/// 1-sigma errors of three sensors of a kind, in the unit of what they measure: rad/s for gyros, m/s^2
/// for accelerometers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triad {
    /// Turn-on bias, constant through a voyage.
    pub bias_std: f64,
    /// In-run bias, first-order Gauss-Markov.
    pub instability_std: f64,
    /// Time constant of the in-run bias, s.
    pub instability_time: f64,
    /// Random walk of the integral: rad/sqrt(s) or (m/s)/sqrt(s).
    pub random_walk: f64,
    /// Scale-factor error, ratio.
    pub scale_std: f64,
}

/// An inertial measurement unit: rate and error model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImuSpec {
    /// Nominal sampling rate, Hz.
    pub rate: f64,
    /// Gyros.
    pub gyro: Triad,
    /// Accelerometers.
    pub accel: Triad,
}

/// Where the sensors sit, from the IMU, body axes, m.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct LeverArms {
    /// GNSS antenna.
    pub gnss: Body,
    /// Velocity log.
    pub log: Body,
}
