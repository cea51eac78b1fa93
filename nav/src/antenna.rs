//! Acceleration of the GNSS antenna from its predicted velocity a moment ago.

use insd_base::Time;
use nalgebra::Vector3;

/// Predicted velocities that are kept.
const KEPT: usize = 8;
/// Velocities closer together than this are not kept both, s.
const LEAST: f64 = 0.045;
/// The acceleration is a mean over so long, s: over less, the noise of small gyros that a long lever arm makes large is
/// mistaken for motion, and a receiver that is late for one that is not.
const SPAN: f64 = 0.3;

/// The last predicted velocities of the antenna, ECEF axes, the newest first.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct AntennaMotion {
    velocities: [Option<(Time, Vector3<f64>)>; KEPT],
}

impl AntennaMotion {
    /// Notes a predicted velocity, m/s.
    pub fn note(&mut self, time: Time, velocity: &Vector3<f64>) {
        let fresh = self.velocities[0].is_none_or(|(last, _)| (time - last).as_seconds() >= LEAST);
        if fresh {
            self.velocities.rotate_right(1);
            self.velocities[0] = Some((time, *velocity));
        }
    }

    /// Mean acceleration up to now, m/s^2; zero before anything is known.
    #[must_use]
    pub fn acceleration(&self, now: Time, velocity: &Vector3<f64>) -> Vector3<f64> {
        let ago = |own: &(Time, Vector3<f64>)| (now - own.0).as_seconds();
        let known = || self.velocities.iter().flatten().filter(|own| ago(own) >= LEAST);
        let before = known().find(|own| ago(own) >= SPAN).or_else(|| known().next_back());
        before.map_or_else(Vector3::zeros, |own| (velocity - own.1) / ago(own))
    }
}
