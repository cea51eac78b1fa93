//! Docking aids as they are told of.

use insd_base::{Body, RangingTarget};

/// A docking aid: one head, one anchor, and what it measures to.
#[derive(Clone, Debug, PartialEq)]
pub struct RangingSpec {
    /// Name of the sensor that tells its distances.
    pub sensor: String,
    /// Its number there.
    pub head: u32,
    /// Number of what it measures to: of the same line or point for all that do.
    pub mark: u16,
    /// What it measures to.
    pub target: RangingTarget,
    /// The point of the ship, from the IMU.
    pub lever: Body,
    /// 1-sigma of a reading that states none, m.
    pub std: f64,
}
