//! The reference method, of JP3375720B2: the sea is taken out of the velocity before the Kalman filter
//! sees it.
//!
//! Once a second the computed velocity enters the sliding window of the [`Prefilter`]; at a spacing
//! over which consecutive estimates have little of their window in common, the slow part that its
//! autoregressive model separates from the sea goes to the Kalman filter as what it is: the error of
//! the computed velocity, with the covariance of the fit. What the filter then corrects is corrected
//! in the window too, as if it had always been so.

use insd_base::{Span, Time, earth};
use insd_nav::aids::reference_velocity;
use insd_nav::error_state::{ACCEL_BIAS, ACCEL_DRIFT, ATTITUDE, GYRO_BIAS, GYRO_DRIFT, VELOCITY};
use insd_nav::{Filter, Outcome};
use nalgebra::{Vector2, Vector3};

use crate::disturbance::{Config, Model, Order, Prefilter, SlowVelocity};

/// Holds a filter at the berth by its prefiltered velocity.
#[derive(Clone, Debug)]
pub struct Prefiltered {
    prefilter: Prefilter,
    model: Option<Model>,
    start: Time,
    next_sample: Time,
    next_estimate: Time,
}

/// Spacing of samples, s.
const SAMPLING: Span = Span::from_nanos(1_000_000_000);
/// Length of the window: longer than the moorings' slowest swaying, over which a Schuler oscillation
/// is still a parabola.
const WINDOW: Span = Span::from_nanos(300_000_000_000);
/// Highest order that is tried.
const HIGHEST_ORDER: usize = 8;
/// Least spacing of estimates, s.
const SPACING: f64 = 20.0;
/// The spacing as share of the window so far.
const SHARE: f64 = 0.25;

impl Prefiltered {
    /// From now on.
    #[must_use]
    pub fn new(filter: &Filter) -> Self {
        let order = Order::Chosen { max: HIGHEST_ORDER };
        let now = filter.time();
        Prefiltered {
            prefilter: Prefilter::new(&Config { interval: SAMPLING, window: WINDOW, order }),
            model: None,
            start: now,
            next_sample: now,
            next_estimate: now + Span::from_seconds(2.0 * SPACING),
        }
    }

    /// The model of the sea that was found last.
    #[must_use]
    pub fn model(&self) -> Option<&Model> {
        self.model.as_ref()
    }

    /// Samples the filter and feeds it, if it is time to; returns the log-likelihood.
    pub fn hold(&mut self, filter: &mut Filter) -> f64 {
        let now = filter.time();
        if now < self.next_sample {
            return 0.0;
        }
        self.next_sample = self.next_sample + SAMPLING;
        self.follow(filter);
        let v_n = filter.view().v_n();
        self.prefilter.push(now, &v_n.xy());
        if now < self.next_estimate {
            return 0.0;
        }
        let filled = (now - self.start).as_seconds().min(WINDOW.as_seconds());
        self.next_estimate = now + Span::from_seconds((SHARE * filled).max(SPACING));
        let Ok(slow) = self.prefilter.estimate() else { return 0.0 };
        self.model = Some(slow.model.clone());
        let likelihood = feed(filter, &slow);
        self.follow(filter);
        likelihood
    }

    /// Corrects the window as the filter has corrected its estimate since the last time.
    ///
    /// dv(t) = dv + da (t - now) + dj (t - now)^2 / 2: an attitude corrected by phi would have felt
    /// the specific force f elsewhere, da = phi x f - C db_a, and a gyro corrected by db_g would have
    /// turned the attitude, dj = -(C db_g) x f; f is that of a ship that does not move, -g.
    fn follow(&mut self, filter: &mut Filter) {
        let error = filter.take_correction();
        let view = filter.view();
        let gravity = earth::normal_gravity(view.geodetic.latitude, view.geodetic.height);
        let force = view.c_ne.transpose() * Vector3::new(0.0, 0.0, -gravity);
        let gyro = GYRO_BIAS.of(&error) + GYRO_DRIFT.of(&error);
        let accel = ACCEL_BIAS.of(&error) + ACCEL_DRIFT.of(&error);
        let level = |v_e: Vector3<f64>| -> Vector2<f64> { (view.c_ne * v_e).xy() };
        let dv = level(VELOCITY.of(&error));
        let da = level(ATTITUDE.of(&error).cross(&force) - view.c_eb * accel);
        let dj = level(-(view.c_eb * gyro).cross(&force));
        self.prefilter.shift(&dv, &da, &dj);
    }
}

/// Tells the filter the error of its velocity.
fn feed(filter: &mut Filter, slow: &SlowVelocity) -> f64 {
    let view = filter.view();
    let without = view.v_n().xy() - slow.value;
    let mut innovation = reference_velocity::innovation(&view, &without, 0.0);
    innovation.r = slow.covariance;
    let judged = filter.impose(&innovation);
    if judged.outcome != Outcome::Accepted {
        innovation.r *= 100.0;
        filter.impose(&innovation);
    }
    judged.log_likelihood
}
