//! What is told of berths before she sails.

use super::hull::Hull;
use super::quay::Quay;

/// Berths, the hull that goes alongside, and when to be warned.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct DockingConfig {
    /// The berths, in the order of the configuration.
    pub berths: Vec<Quay>,
    /// The hull; without one nothing is told.
    pub hull: Option<Hull>,
    /// 1-sigma of the angular rate about each axis, rad/s: what the gyros leave of noise and bias.
    pub rate_sigma: f64,
    /// When to be warned.
    pub limits: DockingLimits,
    /// The berth that is chosen at the start.
    pub chosen: Option<String>,
}

/// When to be warned; `None` never.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct DockingLimits {
    /// Speed of the first contact, m/s.
    pub contact_speed: Option<f64>,
    /// Distance of a part that still comes nearer, m.
    pub distance: Option<f64>,
    /// Protection level of a distance beyond which all is doubtful, m.
    pub level: Option<f64>,
}
