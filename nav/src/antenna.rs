//! Acceleration of the GNSS antenna from its predicted velocity a moment ago.

use insd_base::Time;
use nalgebra::Vector3;

/// The last two predicted velocities of the antenna, ECEF axes.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct AntennaMotion {
    earlier: Option<(Time, Vector3<f64>)>,
    latest: Option<(Time, Vector3<f64>)>,
}

/// Velocities closer together than this say little of the acceleration, s.
const LEAST: f64 = 0.045;

impl AntennaMotion {
    /// Notes a predicted velocity, m/s.
    pub fn note(&mut self, time: Time, velocity: &Vector3<f64>) {
        let fresh = self.latest.is_none_or(|(last, _)| (time - last).as_seconds() >= LEAST);
        if fresh {
            self.earlier = self.latest;
            self.latest = Some((time, *velocity));
        }
    }

    /// Mean acceleration up to now, m/s^2; zero before anything is known.
    #[must_use]
    pub fn acceleration(&self, now: Time, velocity: &Vector3<f64>) -> Vector3<f64> {
        [self.latest, self.earlier]
            .into_iter()
            .flatten()
            .map(|(time, before)| ((now - time).as_seconds(), before))
            .find(|(elapsed, _)| *elapsed >= LEAST)
            .map_or_else(Vector3::zeros, |(elapsed, before)| (velocity - before) / elapsed)
    }
}
