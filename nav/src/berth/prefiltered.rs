//! The reference method, of JP3375720B2: the sea is taken out of the velocity before the Kalman filter
//! sees it.
//!
//! Once a second the computed velocity enters the sliding window of the [`Prefilter`]; at a spacing
//! over which consecutive estimates have little of their window in common, the slow part that its
//! autoregressive model separates from the sea goes to the Kalman filter as what it is: the error of
//! the computed velocity, with the covariance of the fit. What the filter then corrects is corrected
//! in the window too, as if it had always been so.
//!
//! Until the window holds two periods of the slowest swaying there is nothing to separate: the filter
//! is held by a zero velocity that is doubted ([`WhiteNoise`]), so that it stays near enough to be
//! linear. The first windows are short and take part of the swaying for drift; their covariance is
//! raised to what such windows were found to be worth ([`crate::disturbance`], table).

use crate::Filter;
use crate::aids::reference_velocity;
use crate::error_state::{ATTITUDE, Errors};
use crate::method::Method;
use insd_base::{SeaQuantity, Span, Time};
use nalgebra::Vector2;

use super::hindsight::Hindsight;
use super::sight::SeaSight;
use super::white_noise::{self, WhiteNoise};
use crate::disturbance::{Model, Prefilter, PrefilterConfig, SlowVelocity};

/// Holds a filter at the berth by its prefiltered velocity.
#[derive(Clone, Debug)]
pub struct Prefiltered {
    prefilter: Prefilter,
    config: PrefilterConfig,
    model: Option<Model>,
    beginning: WhiteNoise,
    start: Time,
    next_sample: Time,
    next_estimate: Time,
}

/// Share of the window that the first estimate is taken from: two periods of swaying of the five that fit into it.
const FIRST: f64 = 0.5;
/// The spacing of estimates as share of the window, over which their errors are independent.
const SHARE: f64 = 0.25;
/// Factor on the variance of the zero velocity before the first estimate: the sea repeats, and the
/// first window sees the same samples again.
const DOUBT: f64 = 4.0;
/// Derivatives of the correction of the velocity that are carried into the window: over 300 s the
/// next is below a thousandth of the first.
const DERIVATIVES: usize = 6;

impl Prefiltered {
    /// From now on.
    #[must_use]
    pub fn new(filter: &Filter) -> Self {
        let (now, config) = (filter.time(), *filter.prefilter());
        Prefiltered {
            prefilter: Prefilter::new(&config),
            config,
            model: None,
            beginning: WhiteNoise::doubted(filter, DOUBT),
            start: now,
            next_sample: now,
            next_estimate: now + Span::from_seconds(FIRST * config.window.as_seconds()),
        }
    }

    /// The model of the sea that was found last.
    #[must_use]
    pub fn model(&self) -> Option<&Model> {
        self.model.as_ref()
    }

    /// The sea as it was found last, and what of it was seen.
    pub(super) fn sight(&self) -> Option<SeaSight> {
        Some(SeaSight {
            method: Some(Method::AsPublished),
            model: self.model()?.clone(),
            quantity: SeaQuantity::Velocity,
            samples: self.prefilter.newest_run(),
            fit: None,
        })
    }

    /// The window.
    #[must_use]
    pub fn window(&self) -> &Prefilter {
        &self.prefilter
    }

    /// Samples the filter and feeds it, if it is time to; returns the log-likelihood.
    pub fn hold(&mut self, filter: &mut Filter) -> f64 {
        let now = filter.time();
        if now < self.next_sample {
            return 0.0;
        }
        self.next_sample = self.next_sample + self.config.interval;
        self.sample(filter);
        if self.model.is_none() && now < self.next_estimate {
            return self.beginning.hold(filter);
        }
        if now < self.next_estimate {
            return 0.0;
        }
        // a window that cannot be read may be readable with the next sample
        let Ok(slow) = self.prefilter.estimate() else { return 0.0 };
        let window = self.config.window.as_seconds();
        let filled = (now - self.start).as_seconds().min(window);
        self.next_estimate = now + Span::from_seconds(SHARE * filled);
        self.model = Some(slow.model.clone());
        feed(filter, &slow, (window / filled).powi(2))
    }

    /// Corrects the window as the filter has corrected its estimate since the newest sample, and adds
    /// the next.
    fn sample(&mut self, filter: &mut Filter) {
        let error = filter.take_correction();
        self.prefilter.shift(&derivatives(filter, &error));
        self.prefilter.push(filter.time(), &filter.view().v_n().xy());
    }
}

/// Tells the filter the error of its velocity, its variance times `doubt`.
///
/// What is left of the velocity is that of the waves, in the axes of the computed heading: with k the
/// unit vector down
///
/// z = -slow = dv - dphi_D k x v_waves + w,
///
/// which no turn about the ship changes (as in [`crate::aids::berth`]).
fn feed(filter: &mut Filter, slow: &SlowVelocity, doubt: f64) -> f64 {
    filter.settle();
    let view = filter.view();
    let waves = view.v_n().xy() - slow.value;
    let mut innovation = reference_velocity::innovation(&view, &waves, 0.0);
    let across = Vector2::new(waves.y, -waves.x);
    innovation.h.set(ATTITUDE, &(across * view.c_ne.row(2)));
    innovation.r.copy_from(&(slow.covariance * doubt));
    white_noise::impose(filter, &innovation).log_likelihood
}

/// How the velocity of the past would have been other, had an error been corrected always and not only now: the
/// derivatives by time of the error of the velocity, north and east. The Earth's turn in them is what a heading is found
/// by: left out, each correction of the heading would leave a parabola in the window to be found again.
fn derivatives(filter: &Filter, error: &Errors) -> [Vector2<f64>; DERIVATIVES] {
    Hindsight::of(filter).derivatives(error)
}

#[cfg(test)]
pub(super) mod tests;
