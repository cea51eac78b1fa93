//! How far a GNSS receiver is trusted: which of its errors were seen, and when it is believed again.

use insd_base::Time;
use nalgebra::Vector3;

/// Memory of one receiver's agreement with the filter.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Trust {
    last_used: Option<Time>,
    suspect_until: Option<Time>,
    refused_since: Option<Time>,
    velocity: Persistence,
    position: Persistence,
}

/// A running mean of innovations, to find errors too small for a single epoch: the innovations of a
/// filter in agreement with its models are white, so that their mean must shrink.
///
/// Mean m <- m + w (z - m); under whiteness var(m) = w / (2 - w) var(z).
#[derive(Clone, Copy, Debug, PartialEq, Default)]
struct Persistence {
    mean: Vector3<f64>,
    samples: u32,
}

/// Samples that the running mean spans.
const SPAN: f64 = 20.0;
/// Sigmas of the running mean beyond which an error is taken as real.
const PERSISTENT: f64 = 6.0;

impl Persistence {
    fn learn(&mut self, whitened: &Vector3<f64>) {
        self.samples = self.samples.saturating_add(1);
        let bounded = whitened.map(|z| z.clamp(-5.0, 5.0));
        self.mean += (bounded - self.mean) / SPAN;
    }

    fn is_off(&self) -> bool {
        let weight = 1.0 / SPAN;
        let std = (weight / (2.0 - weight)).sqrt();
        f64::from(self.samples) >= SPAN && self.mean.xy().amax() > PERSISTENT * std
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

    /// Whether the receiver was in error a moment ago.
    #[must_use]
    pub fn is_suspect(&self, now: Time) -> bool {
        self.suspect_until.is_some_and(|until| now < until)
            || self.velocity.is_off()
            || self.position.is_off()
    }

    /// Notes a position that was used.
    pub fn used(&mut self, now: Time) {
        self.last_used = Some(now);
        self.refused_since = None;
    }

    /// Notes an error of the receiver; it is suspect for `hold` seconds from now.
    pub fn suspect(&mut self, now: Time, hold: f64) {
        self.suspect_until = Some(now + insd_base::Span::from_seconds(hold));
    }

    /// Notes a position that was refused while the velocity agreed, and returns for how long this
    /// has been so, s.
    pub fn refused(&mut self, now: Time) -> f64 {
        let since = *self.refused_since.get_or_insert(now);
        (now - since).as_seconds()
    }

    /// Learns from a velocity innovation in units of its sigma.
    pub fn learn_velocity(&mut self, whitened: &Vector3<f64>) {
        self.velocity.learn(whitened);
    }

    /// Learns from a position innovation in units of its sigma.
    pub fn learn_position(&mut self, whitened: &Vector3<f64>) {
        self.position.learn(whitened);
    }

    /// Forgets all suspicion.
    pub fn clear(&mut self) {
        *self = Trust { last_used: self.last_used, ..Trust::default() };
    }
}
