//! Where a satellite is and what its clock shows, from what it broadcasts.

mod glonass;
mod kepler;
mod state;

use insd_base::{BroadcastRecord, GpsTime};

pub use state::SatelliteState;

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
