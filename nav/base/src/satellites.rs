//! Satellites of navigation, what a receiver measures of each signal, and what they broadcast of themselves.

mod broadcast;
mod epoch;
mod ranges;
mod signal;

pub use broadcast::{
    BroadcastKind, BroadcastRecord, ClockPolynomial, GlonassRecord, IonosphereModel, KeplerOrbit,
    KeplerRecord,
};
pub use epoch::{SatelliteEpoch, SignalObservation};
pub use ranges::{ArcPhase, Measured, SatelliteRange, SatelliteRanges, Transmitter, time_keeper};
pub use signal::{Constellation, SPEED_OF_LIGHT, SatelliteId, SignalCode};
