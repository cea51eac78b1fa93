//! What is taken of a berth before anyone says more of it.

/// How far her mean place may be from the named berth, as share of her stated displacement.
pub(super) const OFFSET_SHARE: f64 = 0.15;
/// Displacement before anyone states it, 1-sigma of each component, m.
pub const UNSTATED: f64 = 0.7;
/// The same of a berth that is only known as the place of the start, m.
pub(super) const UNSURVEYED: f64 = 10.0;
