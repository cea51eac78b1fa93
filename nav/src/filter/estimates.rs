//! What the filter has found of the sensors, for those who look on.

use insd_base::{Body, Estimate, Estimates};
use nalgebra::Vector3;

use super::Filter;
use crate::error_state::{
    ACCEL_BIAS, ACCEL_DRIFT, GNSS_DELAY, GNSS_LEVER, GYRO_BIAS, GYRO_DRIFT, LOG_MISALIGNMENT,
    LOG_SCALE,
};

impl Filter {
    /// The errors of the sensors; whether the ship is `moored` is for the caller to know. Some 100 ns.
    #[must_use]
    pub fn estimates(&self, moored: bool) -> Estimates {
        let (nominal, misalignment) = (&self.nominal, LOG_MISALIGNMENT.start());
        let estimate = |value: f64, state: usize| Estimate { value, sigma: self.std(state) };
        let (lever, redated) = (GNSS_LEVER.start(), self.redated.unwrap_or_default());
        Estimates {
            gyro_bias: Body(nominal.gyro_error().bias),
            gyro_bias_sigma: Body(self.std_of_sum(GYRO_BIAS.start(), GYRO_DRIFT.start())),
            accel_bias: Body(nominal.accel_error().bias),
            accel_bias_sigma: Body(self.std_of_sum(ACCEL_BIAS.start(), ACCEL_DRIFT.start())),
            log_scale: estimate(nominal.log_scale, LOG_SCALE.start()),
            log_pitch: estimate(nominal.log_misalignment.x, misalignment),
            log_heading: estimate(nominal.log_misalignment.y, misalignment + 1),
            current: self.current(),
            gnss_lever_configured: self.config.lever_arms.gnss,
            gnss_lever: Body(self.antenna_lever()),
            gnss_lever_sigma: Body(Vector3::from_fn(|i, _| self.std(lever + i))),
            gnss_delay: estimate(nominal.gnss_delay + redated, GNSS_DELAY.start()),
            log_lever: self.log_lever_std.map(|sigma| (self.config.lever_arms.log, Body(sigma))),
            course_less_heading: None,
            goes_on_wheels: self.wheels.are_proven(),
            moored,
        }
    }

    fn std(&self, state: usize) -> f64 {
        self.covariance[(state, state)].max(0.0).sqrt()
    }

    /// 1-sigma of the sum of two blocks of three.
    fn std_of_sum(&self, first: usize, second: usize) -> Vector3<f64> {
        let p = &self.covariance;
        Vector3::from_fn(|i, _| {
            let (a, b) = (first + i, second + i);
            (p[(a, a)] + p[(b, b)] + 2.0 * p[(a, b)]).max(0.0).sqrt()
        })
    }
}
