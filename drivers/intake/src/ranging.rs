//! Docking aids as they are told of.

use insd_base::{Body, RangingTarget};

use crate::sensor::Pace;

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

/// A distance of one head.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeadDistance {
    /// Its number; of a local position reference 1 along its axis A and 2 along B.
    pub head: u32,
    /// Distance, m; `None` where there is none.
    pub distance: Option<f64>,
    /// 1-sigma as the device claims, m.
    pub std: Option<f64>,
    /// Time from the measurement to the message, s.
    pub age: f64,
}

/// One of them, and how often it speaks.
#[derive(Clone, Debug)]
pub(crate) struct DockingAid {
    pub(crate) spec: RangingSpec,
    pub(crate) pace: Pace,
}

impl DockingAid {
    pub(crate) fn new(spec: RangingSpec) -> Self {
        DockingAid { spec, pace: Pace::default() }
    }
}
