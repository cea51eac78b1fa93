//! The initial state: what alignment hands to navigation, and without which no filter can be built.

use insd_base::{ImuSpec, Time};
use nalgebra::Vector3;

use crate::config::{NavConfig, WORSE};
use crate::declaration::Carried;
use crate::error_state::carried;
use crate::error_state::{
    ACCEL_BIAS, ACCEL_DRIFT, ACCEL_SCALE, Covariance, GYRO_BIAS, GYRO_DRIFT, GYRO_SCALE,
};
use crate::method::Method;
use crate::nominal::Nominal;

/// An estimate with its covariance at one instant.
#[derive(Clone, Debug, PartialEq)]
pub struct InitialState {
    /// Instant.
    pub time: Time,
    /// Estimate.
    pub nominal: Nominal,
    /// Covariance of its errors.
    pub covariance: Covariance,
    /// Angular rate measured at the instant, body axes, rad/s: for lever arms.
    pub rate: Vector3<f64>,
    /// How she is held if she lies at her berth.
    pub berth: Option<Method>,
    /// When whoever found it last used GNSS: the filter that goes on from it is aided still.
    pub gnss_used: Option<Time>,
}

impl InitialState {
    /// Of a ship under way, of whom no more is known.
    #[must_use]
    pub fn new(time: Time, nominal: Nominal, covariance: Covariance, rate: Vector3<f64>) -> Self {
        InitialState { time, nominal, covariance, rate, berth: None, gnss_used: None }
    }

    /// The same of a ship that lies at her berth, held by a method, or does not.
    #[must_use]
    pub fn at_berth(self, berth: Option<Method>) -> Self {
        InitialState { berth, ..self }
    }
}

/// Admits that in-run biases and scale factors of an IMU are a step worse than its error model says, and that nothing was
/// learnt of its turn-on biases.
pub fn take_for_worse(p: &mut Covariance, imu: &ImuSpec) {
    let more = WORSE * WORSE - 1.0;
    let (gyro, accel) = (&imu.gyro, &imu.accel);
    for (block, std) in [(GYRO_BIAS, gyro.bias_std), (ACCEL_BIAS, accel.bias_std)] {
        block.inflate(p, std * std);
    }
    for (block, std) in [
        (GYRO_DRIFT, gyro.instability_std),
        (GYRO_SCALE, gyro.scale_std),
        (ACCEL_DRIFT, accel.instability_std),
        (ACCEL_SCALE, accel.scale_std),
    ] {
        block.inflate(p, more * std * std);
    }
}

/// Covariance of all errors that are always carried before any measurement, from their error models; position,
/// velocity and attitude are left at zero for the caller.
#[must_use]
pub fn sensor_covariance(config: &NavConfig) -> Covariance {
    let mut p = Covariance::none();
    carried(Carried::Always).for_each(|declared| declared.join(&mut p, config));
    p
}
