//! An epoch in SI values, from which the writers of a receiver simulator make their messages.

use insd_base::{FixQuality, Geodetic, GpsTime};

/// All that a receiver knows of one epoch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GnssEpoch {
    /// When.
    pub time: GpsTime,
    /// GPS - UTC, s.
    pub leap_seconds: i8,
    /// 1-sigma of the receiver's time, s.
    pub time_std: f64,
    /// Position of the antenna, height above the ellipsoid.
    pub position: Geodetic,
    /// 1-sigma of north, east, down position, m.
    pub position_std: [f64; 3],
    /// Height of the geoid above the ellipsoid, m.
    pub undulation: f64,
    /// North, east, down velocity of the antenna, m/s.
    pub velocity: [f64; 3],
    /// 1-sigma of north, east, down velocity, m/s.
    pub velocity_std: [f64; 3],
    /// Satellites used.
    pub satellites: u8,
    /// Position dilution of precision.
    pub pdop: f64,
    /// Horizontal dilution of precision.
    pub hdop: f64,
    /// What the receiver says of its fix.
    pub quality: FixQuality,
}

impl GnssEpoch {
    /// Speed over ground, m/s.
    #[must_use]
    pub fn ground_speed(&self) -> f64 {
        self.velocity[0].hypot(self.velocity[1])
    }

    /// Course over ground, rad, 0 to 2 pi.
    #[must_use]
    pub fn course(&self) -> f64 {
        insd_base::units::wrap_two_pi(self.velocity[1].atan2(self.velocity[0]))
    }

    /// Root mean square of the horizontal distance error, m.
    #[must_use]
    pub fn horizontal_std(&self) -> f64 {
        self.position_std[0].hypot(self.position_std[1])
    }
}
