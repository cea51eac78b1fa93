//! The time of a pulse: what a receiver says of the edge on its pulse-per-second line.

use super::EpochTime;

/// Which pulse a message speaks of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PulseOrder {
    /// The first pulse after the message: UBX TIM-TP.
    Next,
    /// The last pulse before the message: SBF xPPSOffset.
    Last,
}

/// The instant of one pulse.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PulseTime {
    /// Name of the message: `TIM-TP`.
    pub kind: &'static str,
    /// When its edge is.
    pub instant: EpochTime,
    /// Which pulse it is.
    pub order: PulseOrder,
}
