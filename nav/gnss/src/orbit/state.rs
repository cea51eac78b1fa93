//! What is known of a satellite at one instant.

use nalgebra::Vector3;

/// A satellite at one instant, ECEF axes of that instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SatelliteState {
    /// Position of its antenna, m.
    pub position: Vector3<f64>,
    /// Velocity relative to the turning Earth, m/s.
    pub velocity: Vector3<f64>,
    /// Clock ahead of its system's time, s, its relativistic part included and group delays not.
    pub clock: f64,
    /// Drift of the clock, s/s.
    pub clock_drift: f64,
}
