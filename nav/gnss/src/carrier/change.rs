//! What a phase has changed by.

use insd_base::SatelliteId;

use crate::sight::Sight;

/// The change of a satellite's phase between two epochs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhaseChange {
    /// The satellite.
    pub satellite: SatelliteId,
    /// As it stood at the epoch before.
    pub before: Sight,
    /// As it stands.
    pub now: Sight,
    /// `range(now) - range(before) + c (change of the receiver's clock)` as the phase has it, m.
    pub change: f64,
    /// Its variance, m^2.
    pub variance: f64,
}
