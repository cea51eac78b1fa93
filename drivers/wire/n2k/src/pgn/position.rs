//! Position, course and speed, sent often.

use super::{North, Sid};

/// 129025 Position, rapid update.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PositionRapid {
    /// Geodetic latitude, rad, north positive.
    pub latitude: Option<f64>,
    /// Longitude, rad, east positive.
    pub longitude: Option<f64>,
}

/// 129026 Course and speed over ground, rapid update.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CourseSpeed {
    /// Links the messages of one epoch.
    pub sid: Sid,
    /// Which north the course counts from.
    pub reference: Option<North>,
    /// Course over ground, rad, 0 to 2 pi.
    pub course: Option<f64>,
    /// Speed over ground, m/s.
    pub speed: Option<f64>,
}
