//! Error models and mounting of the sensors: what a data sheet and an installer state.

use crate::frames::Body;

/// 1-sigma errors of three gyros, SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GyroTriad {
    /// Turn-on bias, rad/s, constant through a voyage.
    pub bias_std: f64,
    /// In-run bias, rad/s, first-order Gauss-Markov.
    pub instability_std: f64,
    /// Time constant of the in-run bias, s.
    pub instability_time: f64,
    /// Angle random walk, rad/sqrt(s).
    pub random_walk: f64,
    /// Scale-factor error, ratio.
    pub scale_std: f64,
}

/// 1-sigma errors of three accelerometers, SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AccelTriad {
    /// Turn-on bias, m/s^2, constant through a voyage.
    pub bias_std: f64,
    /// In-run bias, m/s^2, first-order Gauss-Markov.
    pub instability_std: f64,
    /// Time constant of the in-run bias, s.
    pub instability_time: f64,
    /// Velocity random walk, (m/s)/sqrt(s).
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
    pub gyro: GyroTriad,
    /// Accelerometers.
    pub accel: AccelTriad,
}

/// Where the sensors sit, from the IMU, body axes, m.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct LeverArms {
    /// GNSS antenna.
    pub gnss: Body,
    /// Velocity log.
    pub log: Body,
}
