//! What the filter has found of the sensors, for those who look on.

use insd_base::{Body, Estimate, Estimates};
use nalgebra::SVector;

use super::Filter;
use crate::config::NavConfig;
use crate::error_state::{
    ACCEL_BIAS, ACCEL_DRIFT, Block, GNSS_DELAY, GNSS_LEVER, GYRO_BIAS, GYRO_DRIFT,
    LOG_MISALIGNMENT, LOG_SCALE,
};

impl Filter {
    /// The errors of the sensors; whether the ship is `moored` is for the caller to know. Some 100 ns.
    #[must_use]
    pub fn estimates(&self, moored: bool) -> Estimates {
        let (nominal, p) = (&self.state.nominal, &self.state.covariance);
        let estimate = |value: f64, sigma: f64| Estimate { value, sigma };
        let scale = self.unless_carried(LOG_SCALE, |config| config.log.scale_std).x;
        let misalignment =
            self.unless_carried(LOG_MISALIGNMENT, |config| config.log.misalignment_std);
        let redated = self.receiver.redated.unwrap_or_default();
        Estimates {
            gyro_bias: Body(nominal.gyro_error().bias),
            gyro_bias_sigma: Body(GYRO_BIAS.std_of_sum(GYRO_DRIFT, p)),
            accel_bias: Body(nominal.accel_error().bias),
            accel_bias_sigma: Body(ACCEL_BIAS.std_of_sum(ACCEL_DRIFT, p)),
            log_scale: estimate(nominal.log_scale, scale),
            log_pitch: estimate(nominal.log_misalignment.x, misalignment.x),
            log_heading: estimate(nominal.log_misalignment.y, misalignment.y),
            current: self.current(),
            gnss_lever_configured: self.config.lever_arms.gnss,
            gnss_lever: Body(self.antenna_lever()),
            gnss_lever_sigma: Body(GNSS_LEVER.stds(p)),
            gnss_delay: estimate(nominal.gnss_delay + redated, GNSS_DELAY.std(p)),
            log_lever: self
                .installation
                .log_lever_std
                .map(|sigma| (self.config.lever_arms.log, Body(sigma))),
            course_less_heading: None,
            is_not_at_sea: self.state.level.is_refuted(),
            goes_on_wheels: self.conduct.wheels.are_proven(),
            moored,
        }
    }

    /// 1-sigma of each component of a block, and as at the beginning where it is not carried yet.
    fn unless_carried<const W: usize>(
        &self,
        block: Block<W>,
        first: fn(&NavConfig) -> f64,
    ) -> SVector<f64, W> {
        if self.state.covariance.has(block) {
            block.stds(&self.state.covariance)
        } else {
            SVector::repeat(first(&self.config))
        }
    }
}
