//! Heave: how far a point of the ship is above its mean height, as the waves move it.

use crate::time::Time;

/// How far a heave can be relied on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum HeaveQuality {
    /// The filter has not settled: after the start, or after a gap in the IMU data.
    Unsettled,
    /// Usable, but beyond the accuracy of a survey: its own sigma is large against the sea.
    Reduced,
    /// As good as it gets.
    Settled,
}

/// Heave of one monitoring point at an instant.
///
/// Its mean over many waves is zero: tide, draught, a lasting list and trim are not in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heave {
    /// Time of validity.
    pub time: Time,
    /// Heave, m, **up** positive.
    pub heave: f64,
    /// Its rate of change, m/s, up positive.
    pub rate: f64,
    /// Second derivative of the heave, m/s^2, up positive.
    pub acceleration: f64,
    /// 1-sigma of the heave, m.
    pub sigma: f64,
    /// How far it can be relied on.
    pub quality: HeaveQuality,
    /// The heave of some minutes ago, with what has come since taken into account.
    pub delayed: Option<DelayedHeave>,
}

/// Heave with a fixed delay and without phase error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DelayedHeave {
    /// Time of validity.
    pub time: Time,
    /// Heave, m, **up** positive.
    pub heave: f64,
    /// 1-sigma, m.
    pub sigma: f64,
    /// How far it can be relied on.
    pub quality: HeaveQuality,
}

impl Heave {
    /// The heave at an instant close by, carried on by its rate and acceleration. The delayed heave
    /// stays what it is.
    #[must_use]
    pub fn at(&self, time: Time) -> Self {
        let dt = (time - self.time).as_seconds();
        Heave {
            time,
            heave: self.heave + dt * (self.rate + 0.5 * dt * self.acceleration),
            rate: self.rate + dt * self.acceleration,
            ..*self
        }
    }
}
