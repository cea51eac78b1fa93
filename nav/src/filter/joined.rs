//! Two filters of one instant as one.

use super::Filter;
use crate::symmetry::turn_biases;

impl Filter {
    /// Joins another filter of the same instant, whose weight is `share`, 0..1: mean and covariance of the mixture
    /// (Bar-Shalom, Li and Kirubarajan, Estimation with Applications to Tracking and Navigation,
    /// eq. (1.4.16-10)), each covariance seen from the mean. Both must be settled. It counts as a correction.
    pub fn join(&mut self, other: &Filter, share: f64) {
        let apart = self.state.nominal.error_to(&other.state.nominal);
        let mut nominal = self.state.nominal;
        nominal.inject(&apart.scaled(share));
        let seen_from_there = |filter: &Filter| {
            let mut covariance = filter.state.covariance.clone();
            turn_biases(&mut covariance, &filter.state.nominal.c_eb(), &nominal.c_eb());
            covariance
        };
        let mut covariance = seen_from_there(self).scaled(1.0 - share);
        covariance.add(&seen_from_there(other).scaled(share));
        covariance.spread(&apart.scaled((share * (1.0 - share)).sqrt()));
        self.state.corrected += &self.state.nominal.error_to(&nominal);
        self.state.nominal = nominal;
        self.state.covariance = covariance;
    }
}
