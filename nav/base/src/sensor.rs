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

/// By how much biases change with the temperature, 1-sigma, in units of the turn-on bias: over [`TEN_KELVIN`], and by the bend of that.
/// Wide on purpose: few data sheets name it.
const THERMAL_SLOPE: f64 = 2.0;
const THERMAL_BEND: f64 = 1.0;
const TEN_KELVIN: f64 = 10.0;

impl Triad {
    /// By what the bias changes with the temperature, 1-sigma, unit per K.
    #[must_use]
    pub fn thermal_slope_std(&self) -> f64 {
        THERMAL_SLOPE * self.bias_std / TEN_KELVIN
    }

    /// By what that change bends, 1-sigma, unit per K^2.
    #[must_use]
    pub fn thermal_bend_std(&self) -> f64 {
        THERMAL_BEND * self.bias_std / (TEN_KELVIN * TEN_KELVIN)
    }

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
