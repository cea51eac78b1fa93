//! What the atmosphere adds to a range: ionosphere by the broadcast models, troposphere by a standard one.

mod klobuchar;
mod nequick;
mod troposphere;

pub use klobuchar::klobuchar;
pub use nequick::NeQuickG;
pub use troposphere::{Mapping, Troposphere};

/// Where a satellite stands as seen from an antenna, rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LookAngles {
    /// Clockwise from north.
    pub azimuth: f64,
    /// Above the horizon.
    pub elevation: f64,
}
