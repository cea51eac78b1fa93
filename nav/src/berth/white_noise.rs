//! Zero velocity with the sea as white noise: what a plain Kalman filter does at the berth. It is
//! here to be compared with, and [`super::Prefiltered`] begins with it.
//!
//! z = -v + w once a second; the variance of w is learnt from what the filter did not foresee, in
//! the way of R. K. Mehra, IEEE Trans. Automatic Control 15 (1970): E[z z^T] = H P H^T + R.
//!
//! White the sea is not. Its displacement is bounded, so that over minutes the velocity averages out
//! much faster than white noise would, and the filter knows more than it claims. And it lies along the
//! axes of the computed heading, wherever north is: held along true north and east it seems to show
//! the heading ([`crate::aids::berth`] has the remedy), so that with gyros of the tactical grade the
//! filter ends up sure of a heading that nothing told it.

use crate::aids::reference_velocity;
use crate::error_state::Innovation;
use crate::filter::Judged;
use crate::{Filter, Outcome};
use insd_base::{Span, Time};
use nalgebra::Vector2;

/// Holds a filter at zero velocity once a second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WhiteNoise {
    variance: f64,
    /// That of another, where it is what counts.
    lent: Option<f64>,
    doubt: f64,
    next: Time,
}

/// Spacing of the samples, s.
const SPACING: f64 = 1.0;
/// Velocity by the sea before it has been seen, 1-sigma of each component, m/s.
const UNSEEN: f64 = 0.3;
/// Time over which it is learnt, s.
const LEARNING: f64 = 120.0;
/// Least velocity by the sea that is believed, 1-sigma, m/s.
const LEAST: f64 = 0.005;
/// Variance, (m/s)^2, at which a velocity that does not fit tells nothing any more.
const NOTHING: f64 = 1e6;

impl WhiteNoise {
    /// From now on.
    #[must_use]
    pub fn new(filter: &Filter) -> Self {
        Self::doubted(filter, 1.0)
    }

    /// The same with the variance of the noise taken so many times larger than it is seen.
    #[must_use]
    pub fn doubted(filter: &Filter, doubt: f64) -> Self {
        WhiteNoise { variance: UNSEEN * UNSEEN, lent: None, doubt, next: filter.time() }
    }

    /// Velocity by the sea, 1-sigma of each component, m/s.
    #[must_use]
    pub fn std(&self) -> f64 {
        self.lent.unwrap_or(self.variance).sqrt().max(LEAST)
    }

    /// Variance of the velocity by the sea as it was learnt, (m/s)^2.
    #[must_use]
    pub fn learnt(&self) -> f64 {
        self.variance
    }

    /// From now on the sea is what another has learnt; nothing for what she learns herself.
    pub fn lend(&mut self, variance: Option<f64>) {
        self.lent = variance;
    }

    /// Holds the filter if it is time to; returns the log-likelihood.
    pub fn hold(&mut self, filter: &mut Filter) -> f64 {
        if filter.time() < self.next {
            return 0.0;
        }
        self.next = filter.time() + Span::from_seconds(SPACING);
        filter.settle();
        let std = self.std() * self.doubt.sqrt();
        let innovation = reference_velocity::innovation(&filter.view(), &Vector2::zeros(), std);
        let judged = impose(filter, &innovation);
        self.learn(&innovation, &judged);
        judged.log_likelihood
    }

    fn learn(&mut self, innovation: &Innovation, judged: &Judged) {
        let r = self.std().powi(2);
        for axis in 0..2 {
            let expected = judged.innovation[axis].1.powi(2) - innovation.r[(axis, axis)];
            if expected.is_finite() {
                let seen = (innovation.z[axis].powi(2) - expected).clamp(0.0, 9.0 * r);
                let clearness = (r / (r + expected)).powi(2);
                self.variance += 0.5 * SPACING / LEARNING * clearness * (seen - self.variance);
            }
        }
    }
}

/// Imposes an innovation; one that does not fit counts for less, until it fits. Returns the first
/// judgement.
pub(crate) fn impose(filter: &mut Filter, innovation: &Innovation) -> Judged {
    let judged = filter.impose(innovation);
    let mut doubtful = innovation.clone();
    let mut outcome = judged.outcome;
    while outcome != Outcome::Accepted && doubtful.r[(0, 0)] < NOTHING {
        doubtful.r *= 4.0;
        outcome = filter.impose(&doubtful).outcome;
    }
    judged
}
