//! The slow errors of GNSS, which are told in units of their sigmas, where a receiver is noisier than it says.

use super::Filter;
use crate::block::Block;
use crate::error_state::{GNSS_POSITION_ERROR, GNSS_VELOCITY_ERROR};
use crate::judge::Aid;

impl Filter {
    /// When a receiver is found to be noisier than it says, or not any more, its slow errors are what they were, in
    /// metres; and may be off by as much more as they are larger now.
    pub(super) fn note_noise(&mut self) {
        let before = self.slow_noise;
        self.slow_noise = self.noise_of_slow();
        for (i, block) in [GNSS_POSITION_ERROR, GNSS_VELOCITY_ERROR].into_iter().enumerate() {
            let factor = (before[i] / self.slow_noise[i]).sqrt();
            if factor != 1.0 {
                self.rescale_slow(block, factor);
            }
        }
    }

    /// By how much the variances of its position and of its velocity are larger than stated.
    pub(super) fn noise_of_slow(&self) -> [f64; 2] {
        [Aid::GnssPosition, Aid::GnssVelocity].map(|aid| self.noise_of(aid))
    }

    fn rescale_slow(&mut self, block: Block<3>, factor: f64) {
        let nominal = &mut self.nominal;
        let is_position = block == GNSS_POSITION_ERROR;
        let error = if is_position {
            &mut nominal.gnss_position_error
        } else {
            &mut nominal.gnss_velocity_error
        };
        *error *= factor;
        block.rescale(&mut self.covariance, factor);
        if let Some(bias) = &mut self.bias {
            block.columns_mut(bias.response_mut()).scale_mut(factor);
        }
        if let Some(judge) = self.judge_now() {
            judge.rescale(block, factor);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::NavConfig;
    use crate::error_state::POSITION;
    use crate::initial::sensor_covariance;
    use crate::{InitialState, Nominal};
    use insd_base::{Geodetic, ImuSpec, LeverArms, Time, Triad};
    use nalgebra::{Matrix3, Vector3};

    /// A filter whose receiver was so much noisier than it says until now, and which knows its slow error of two and a
    /// half metres, half of a variance of one.
    fn filter(noise: f64) -> Filter {
        let triad = Triad {
            bias_std: 1e-7,
            instability_std: 1e-8,
            instability_time: 100.0,
            random_walk: 1e-6,
            scale_std: 1e-5,
        };
        let imu = ImuSpec { rate: 100.0, gyro: triad, accel: triad };
        let config = NavConfig::new(imu, LeverArms::default());
        let place = Geodetic::from_degrees(35.0, 139.0, 20.0);
        let mut nominal = Nominal::at(&place, &Vector3::zeros(), &Matrix3::identity());
        nominal.gnss_position_error = Vector3::repeat(2.5 / noise.sqrt());
        let mut covariance = sensor_covariance(&config);
        let half = Matrix3::from_diagonal_element(0.5);
        GNSS_POSITION_ERROR.renew(&mut covariance, &half);
        POSITION.renew(&mut covariance, &half);
        let (time, rate) = (Time::from_seconds(9.0), Vector3::zeros());
        let mut filter = Filter::new(&config, &InitialState { time, nominal, covariance, rate });
        filter.slow_noise[0] = noise;
        filter.begin_navigation();
        filter
    }

    #[test]
    fn a_slow_error_is_what_it_was_when_its_receiver_is_found_noisier_or_not_any_more() {
        for noise in [4.0, 0.25] {
            let mut filter = filter(noise);
            filter.note_noise();
            let error = filter.nominal.gnss_position_error;
            assert!((error - Vector3::repeat(2.5)).norm() < 1e-12, "{noise}: {error}");
            assert_eq!(filter.slow_noise, [1.0; 2]);
        }
    }

    /// Found quieter, it is known in metres as it was; found noisier, it is off by what it may be more.
    #[test]
    fn what_is_known_of_a_slow_error_does_not_grow_with_its_sigma() {
        for (noise, variance) in [(4.0, 0.5 * 4.0), (0.25, 0.5 * 0.25 + 0.75)] {
            let mut filter = filter(noise);
            filter.note_noise();
            let known = GNSS_POSITION_ERROR.covariance(&filter.covariance);
            assert!((known - Matrix3::from_diagonal_element(variance)).norm() < 1e-12, "{known}");
        }
    }
}
