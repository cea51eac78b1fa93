//! Where a satellite is and what its clock shows, from what it broadcasts.

mod glonass;
mod kepler;

use insd_base::{BroadcastRecord, GpsTime};
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

impl SatelliteState {
    /// The satellite at an instant, by one of its records, however old; [`crate::Ephemerides`] judges that.
    #[must_use]
    pub fn at(record: &BroadcastRecord, time: GpsTime) -> Self {
        match record {
            BroadcastRecord::Kepler(record) => kepler::state(record, time),
            BroadcastRecord::Glonass(record) => glonass::state(record, time),
        }
    }
}

/// Offset of the clock alone, s: what finds the time of transmission, to the nanosecond, without the orbit.
#[must_use]
pub fn clock_alone(record: &BroadcastRecord, time: GpsTime) -> f64 {
    match record {
        BroadcastRecord::Kepler(record) => kepler::clock(record, time),
        BroadcastRecord::Glonass(record) => glonass::clock(record, time),
    }
}
