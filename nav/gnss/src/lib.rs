//! Satellites of navigation: where they are, what lies between, and what follows for a receiver.
//!
//! Pure, and without a filter: an epoch of a receiver and what satellites broadcast go in; ranges as they should be, positions, velocities and
//! displacements with their covariances come out. ECEF axes, metres, seconds, radians; e points from the antenna to the satellite.

pub mod atmosphere;
mod ephemerides;
pub mod orbit;

pub use ephemerides::{Ephemerides, Refusal};
pub use orbit::SatelliteState;
