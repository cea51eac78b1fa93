//! What the engine tells.

use insd_base::{AidInnovation, AlignmentStatus, Event, SatelliteInnovation, Solution};

/// What leaves the engine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Output {
    /// The state of the ship at an output epoch.
    Solution(Solution),
    /// An innovation of a measurement.
    Innovation(AidInnovation),
    /// An innovation of one satellite.
    Satellite(SatelliteInnovation),
    /// What the alignment knows of itself: when its phase changes and every ten seconds until the ship
    /// is aligned.
    Alignment(AlignmentStatus),
    /// Something worth telling.
    Event(Event),
}
