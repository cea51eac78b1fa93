//! Error models and mounting of the sensors: what a data sheet and an installer state.

use crate::frames::Body;
use crate::units::{DEG_PER_HOUR, DEG_PER_SQRT_HOUR, MICRO_G, MPS_PER_SQRT_HOUR, PPM};

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

impl Triad {
    /// Gyros by their data sheet: turn-on bias and in-run bias, deg/h; its time constant, s; angle random
    /// walk, deg/sqrt(h); scale factor, ppm.
    #[must_use]
    pub fn of_gyros([bias, instability, time, walk, scale]: [f64; 5]) -> Self {
        Triad {
            bias_std: bias * DEG_PER_HOUR,
            instability_std: instability * DEG_PER_HOUR,
            instability_time: time,
            random_walk: walk * DEG_PER_SQRT_HOUR,
            scale_std: scale * PPM,
        }
    }

    /// Accelerometers by their data sheet: turn-on bias and in-run bias, micro-g; its time constant, s;
    /// velocity random walk, (m/s)/sqrt(h); scale factor, ppm.
    #[must_use]
    pub fn of_accelerometers([bias, instability, time, walk, scale]: [f64; 5]) -> Self {
        Triad {
            bias_std: bias * MICRO_G,
            instability_std: instability * MICRO_G,
            instability_time: time,
            random_walk: walk * MPS_PER_SQRT_HOUR,
            scale_std: scale * PPM,
        }
    }
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
