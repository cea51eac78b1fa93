//! Zero velocity with the sea as white noise: what a plain Kalman filter does at the berth. It is
//! here to be compared with.

use insd_base::{Span, Time};
use insd_nav::Filter;
use insd_nav::aids::reference_velocity;
use nalgebra::Vector2;

/// Holds a filter at zero velocity once a second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WhiteNoise {
    next: Time,
}

/// Spacing of the samples, s.
const SPACING: f64 = 1.0;
/// What the sea is taken for: white noise of this sigma of each component, m/s.
const SEA: f64 = 0.3;

impl WhiteNoise {
    /// From now on.
    #[must_use]
    pub fn new(filter: &Filter) -> Self {
        WhiteNoise { next: filter.time() }
    }

    /// Holds the filter if it is time to; returns the log-likelihood.
    pub fn hold(&mut self, filter: &mut Filter) -> f64 {
        if filter.time() < self.next {
            return 0.0;
        }
        self.next = filter.time() + Span::from_seconds(SPACING);
        let innovation = reference_velocity::innovation(&filter.view(), &Vector2::zeros(), SEA);
        filter.impose(&innovation).log_likelihood
    }
}
