//! The initial state: what alignment hands to navigation, and without which no filter can be built.

use insd_base::{ImuSpec, Time};
use nalgebra::{Matrix1, Matrix2, Matrix3, Vector3};

use crate::config::{NavConfig, WORSE};
use crate::error_state::{
    ACCEL_BIAS, ACCEL_DRIFT, ACCEL_SCALE, CURRENT, Covariance, GNSS_DELAY, GNSS_LEVER,
    GNSS_POSITION_ERROR, GNSS_VELOCITY_DELAY, GNSS_VELOCITY_ERROR, GYRO_BIAS, GYRO_DRIFT,
    GYRO_SCALE, HEADING_ERROR, LOG_MISALIGNMENT, LOG_SCALE, SEA_LEVEL,
};
use crate::nominal::Nominal;

/// An estimate with its covariance at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InitialState {
    /// Instant.
    pub time: Time,
    /// Estimate.
    pub nominal: Nominal,
    /// Covariance of its errors.
    pub covariance: Covariance,
    /// Angular rate measured at the instant, body axes, rad/s: for lever arms.
    pub rate: Vector3<f64>,
}

/// 1-sigma of the mean height before anything is known of it, m.
const SEA_LEVEL_UNKNOWN: f64 = 30.0;

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

/// Covariance of all sensor errors before any measurement, from their error models; position,
/// velocity and attitude are left at zero for the caller.
#[must_use]
pub fn sensor_covariance(config: &NavConfig) -> Covariance {
    let mut p = Covariance::zeros();
    let three = |std: f64| Matrix3::from_diagonal_element(std * std);
    let (gyro, accel) = (&config.imu.gyro, &config.imu.accel);
    GYRO_BIAS.renew(&mut p, &three(gyro.bias_std));
    GYRO_DRIFT.renew(&mut p, &three(gyro.instability_std));
    GYRO_SCALE.renew(&mut p, &three(gyro.scale_std));
    ACCEL_BIAS.renew(&mut p, &three(accel.bias_std));
    ACCEL_DRIFT.renew(&mut p, &three(accel.instability_std));
    ACCEL_SCALE.renew(&mut p, &three(accel.scale_std));
    GNSS_POSITION_ERROR.renew(&mut p, &three(1.0));
    GNSS_VELOCITY_ERROR.renew(&mut p, &three(1.0));
    let delay = Matrix1::new(config.gnss.velocity_delay_std.powi(2));
    GNSS_VELOCITY_DELAY.renew(&mut p, &delay);
    GNSS_DELAY.renew(&mut p, &Matrix1::new(config.gnss.delay_std.powi(2)));
    GNSS_LEVER.renew(&mut p, &three(config.gnss_lever_std()));
    let log = &config.log;
    CURRENT.renew(&mut p, &Matrix2::from_diagonal_element(log.current_std.powi(2)));
    LOG_SCALE.renew(&mut p, &Matrix1::new(log.scale_std.powi(2)));
    let misalignment = Matrix2::from_diagonal_element(log.misalignment_std.powi(2));
    LOG_MISALIGNMENT.renew(&mut p, &misalignment);
    SEA_LEVEL.renew(&mut p, &Matrix1::new(SEA_LEVEL_UNKNOWN.powi(2)));
    HEADING_ERROR.renew(&mut p, &Matrix1::identity());
    p
}
