//! How far a GNSS receiver is trusted: which of its errors were seen, how honest its sigmas are, and
//! when it is believed again.

use insd_base::{Span, Time};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// Memory of one receiver's agreement with the filter.
#[derive(Clone, Copy, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct Trust {
    last_used: Option<Time>,
    suspect_until: Option<Time>,
    refused_since: Option<Time>,
    /// Agreement of its velocities.
    pub velocity: Agreement,
    /// Agreement of its positions.
    pub position: Agreement,
}

/// Running statistics of the innovations of one quantity.
///
/// In a filter that agrees with its models innovations are white with the expected covariance. Their
/// running mean then shrinks: m <- m + w (z - m), var(m) = w / (2 - w) var(z); an error too small for
/// a single epoch shows in it. Their running mean square shows a receiver whose sigmas are too small.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Agreement {
    mean: Vector3<f64>,
    mean_square: f64,
    samples: u32,
}

impl Default for Agreement {
    fn default() -> Self {
        Agreement { mean: Vector3::zeros(), mean_square: 1.0, samples: 0 }
    }
}

/// Samples that the running means span.
const SPAN: f64 = 20.0;
/// Sigmas of the running mean beyond which an error is taken as real.
const PERSISTENT: f64 = 6.0;
/// The same while the innovations are correlated.
const CORRELATED: f64 = 2.5;
/// Mean square (one is expected) up to which the stated sigmas are taken as they are.
const HONEST: f64 = 1.6;
/// Mean square of one epoch beyond which it is a fault and not noise.
pub const FAULT: f64 = 30.0;

impl Agreement {
    /// Learns from an innovation in units of its expected sigma, component by component, and its
    /// normalised square divided by the number of components. A fault teaches nothing about noise.
    pub fn learn(&mut self, whitened: &Vector3<f64>, mean_square: f64) {
        if mean_square > FAULT {
            return;
        }
        self.samples = self.samples.saturating_add(1);
        self.mean += (whitened - self.mean) / SPAN;
        self.mean_square += (mean_square - self.mean_square) / SPAN;
    }

    /// Factor on the variance of the receiver's white noise that makes its sigmas honest.
    #[must_use]
    pub fn variance_factor(&self) -> f64 {
        (self.mean_square / HONEST).max(1.0)
    }

    /// Whether a horizontal component is off on the mean. While the receiver is refused, nothing of
    /// its innovations is absorbed and they are no longer white: then only a mean of several whole
    /// sigmas counts.
    #[must_use]
    pub fn is_off(&self, refused: bool) -> bool {
        let weight = 1.0 / SPAN;
        let white = PERSISTENT * (weight / (2.0 - weight)).sqrt();
        let limit = if refused { CORRELATED } else { white };
        f64::from(self.samples) >= SPAN && self.mean.xy().amax() > limit
    }

    fn forget_mean(&mut self) {
        self.mean = Vector3::zeros();
        self.samples = 0;
    }
}

impl Trust {
    /// Time since a position was last used, s; zero before any.
    #[must_use]
    pub fn since_used(&self, now: Time) -> f64 {
        self.last_used.map_or(0.0, |last| (now - last).as_seconds())
    }

    /// When a position was last used.
    #[must_use]
    pub fn last_used(&self) -> Option<Time> {
        self.last_used
    }

    /// Whether the receiver is to be refused: found in fault a moment ago, or off on the mean. The
    /// verdict holds for `hold` seconds and as long as the error goes on.
    pub fn is_refused(&mut self, now: Time, hold: f64) -> bool {
        let refused = self.suspect_until.is_some_and(|until| now < until);
        if self.velocity.is_off(refused) || self.position.is_off(refused) {
            self.suspect(now, hold);
        } else if !refused && self.suspect_until.take().is_some() {
            self.velocity.forget_mean();
            self.position.forget_mean();
        }
        self.suspect_until.is_some()
    }

    /// The same on a time line that is later by a span.
    #[must_use]
    pub fn shifted(self, by: Span) -> Self {
        let later = |time: Option<Time>| time.map(|time| time + by);
        Trust {
            last_used: later(self.last_used),
            suspect_until: later(self.suspect_until),
            refused_since: later(self.refused_since),
            ..self
        }
    }

    /// Whether the receiver is found in fault now.
    #[must_use]
    pub fn is_suspect(&self, now: Time) -> bool {
        self.suspect_until.is_some_and(|until| now < until)
    }

    /// Notes a position that was used.
    pub fn used(&mut self, now: Time) {
        self.last_used = Some(now);
        self.refused_since = None;
    }

    /// Notes a fault of the receiver; it is suspect for `hold` seconds from now.
    pub fn suspect(&mut self, now: Time, hold: f64) {
        let until = now + Span::from_seconds(hold);
        self.suspect_until = self.suspect_until.max(Some(until));
    }

    /// Notes a position that was refused and returns for how long none was used, s.
    pub fn refused(&mut self, now: Time) -> f64 {
        let since = *self.refused_since.get_or_insert(now);
        (now - since).as_seconds()
    }

    /// From now on is counted for how long none was used.
    pub fn count_anew(&mut self) {
        self.refused_since = None;
    }

    /// Forgets all suspicion.
    pub fn clear(&mut self) {
        *self = Trust { last_used: self.last_used, ..Trust::default() };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_persistent_error_is_found_and_white_noise_is_not() {
        let mut honest = Agreement::default();
        let mut biased = Agreement::default();
        for i in 0..200_u32 {
            let noise = Vector3::repeat(if i % 2 == 0 { 1.0 } else { -1.0 });
            honest.learn(&noise, 1.0);
            biased.learn(&noise.add_scalar(1.5), 3.0);
        }
        assert!(!honest.is_off(false));
        assert!(biased.is_off(false) && !biased.is_off(true));
        assert!((honest.variance_factor() - 1.0).abs() < 1e-12);
        assert!(biased.variance_factor() > 1.5);
    }
}
