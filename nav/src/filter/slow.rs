//! Slow errors, which are told in units of their sigmas, where a receiver or a compass is noisier than it says.

use super::Filter;
use crate::error_state::{Block, GNSS_POSITION_ERROR, GNSS_VELOCITY_ERROR, HEADING_ERROR};
use crate::judge::Aid;

impl Filter {
    /// When somebody is found to be noisier than he says, or not any more, his slow errors are what they were, in
    /// metres or radians; and may be off by as much more as they are larger now.
    pub(super) fn note_noise(&mut self) {
        let [position, velocity] = self.noise_of_slow();
        let now = [position, velocity, self.noise_of(Aid::Heading)];
        let [of_position, of_velocity] =
            std::mem::replace(&mut self.receiver.slow_noise, [position, velocity]);
        let of_heading = std::mem::replace(&mut self.compass_noise, now[2]);
        let before = [of_position, of_velocity, of_heading];
        let [position, velocity, heading] = [0, 1, 2].map(|i: usize| (before[i] / now[i]).sqrt());
        self.state.nominal.gnss_position_error *= position;
        self.state.nominal.gnss_velocity_error *= velocity;
        self.state.nominal.heading_error *= heading;
        self.rescale_slow(GNSS_POSITION_ERROR, position);
        self.rescale_slow(GNSS_VELOCITY_ERROR, velocity);
        self.rescale_slow(HEADING_ERROR, heading);
    }

    /// By how much the variances of position and velocity of the receiver are larger than stated.
    pub(super) fn noise_of_slow(&self) -> [f64; 2] {
        [Aid::GnssPosition, Aid::GnssVelocity].map(|aid| self.noise_of(aid))
    }

    fn rescale_slow<const W: usize>(&mut self, block: Block<W>, factor: f64) {
        if factor == 1.0 {
            return;
        }
        block.rescale(&mut self.state.covariance, factor);
        if let Some(bias) = &mut self.installation.bias {
            bias.rescale(block, factor);
        }
        if let Some(judge) = self.judge_now() {
            judge.rescale(block, factor);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::filter::checkpoint::tests;
    use nalgebra::{Matrix3, Vector3};

    /// A filter whose receiver and compass were so much noisier than they say until now, and which knows the receiver's slow
    /// error of two and a half metres, half of a variance of one, and that of the compass.
    fn filter(noise: f64) -> Filter {
        let (_, mut filter) = tests::filter();
        filter.state.nominal.gnss_position_error = Vector3::repeat(2.5 / noise.sqrt());
        let half = Matrix3::from_diagonal_element(0.5);
        GNSS_POSITION_ERROR.renew(&mut filter.state.covariance, &half);
        filter.state.nominal.heading_error = 2.5 / noise.sqrt();
        (filter.receiver.slow_noise[0], filter.compass_noise) = (noise, noise);
        filter
    }

    #[test]
    fn a_slow_error_is_what_it_was_when_its_receiver_is_found_noisier_or_not_any_more() {
        for noise in [4.0, 0.25] {
            let mut filter = filter(noise);
            filter.note_noise();
            let error = filter.state.nominal.gnss_position_error;
            assert!((error - Vector3::repeat(2.5)).norm() < 1e-12, "{noise}: {error}");
            assert!((filter.state.nominal.heading_error - 2.5).abs() < 1e-12);
            assert_eq!((filter.receiver.slow_noise, filter.compass_noise), ([1.0; 2], 1.0));
        }
    }

    /// Found quieter, it is known in metres as it was; found noisier, it is off by what it may be more.
    #[test]
    fn what_is_known_of_a_slow_error_does_not_grow_with_its_sigma() {
        for (noise, variance) in [(4.0, 0.5 * 4.0), (0.25, 0.5 * 0.25 + 0.75)] {
            let mut filter = filter(noise);
            filter.note_noise();
            let known = GNSS_POSITION_ERROR.covariance(&filter.state.covariance);
            assert!((known - Matrix3::from_diagonal_element(variance)).norm() < 1e-12, "{known}");
        }
    }
}
