//! What leaves the intake.

use insd_base::{Received, Time};

use crate::event::IntakeEvent;
use crate::watched::Watched;

/// What leaves the intake.
#[derive(Clone, Debug, PartialEq)]
pub enum Intaken {
    /// A measurement, for the engine.
    Measured(Received),
    /// The temperature of the IMU in use, degrees Celsius, about once a second.
    Temperature(Time, f64),
    /// What a sensor says that is watched and not used.
    Watched(Watched),
    /// Something worth telling.
    Event(IntakeEvent),
}
