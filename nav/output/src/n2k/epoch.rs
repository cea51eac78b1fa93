//! What is known at one instant.

use insd_base::{Ned, Solution, Time, UtcTime};
use insd_n2k::pgn::TimeSource;

/// What is known at one instant; what is not known is `None` and is sent as not available.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Epoch {
    /// The instant: time of validity of everything here. It decides which messages are due.
    pub time: Time,
    /// Where the ship is, how she moves and lies.
    pub solution: Option<Solution>,
    /// North-east element of the covariance of the solution's position, m^2. With it the ellipse of the
    /// horizontal error is known, without it only its extent to the north and to the east.
    pub covariance_north_east: Option<f64>,
    /// The instant in UTC.
    pub utc: Option<UtcTime>,
    /// What UTC is known from.
    pub time_source: Option<TimeSource>,
    /// Heave, m, up positive.
    pub heave: Option<f64>,
    /// Magnetic variation at the ship.
    pub variation: Option<Variation>,
    /// Height of the geoid above the ellipsoid at the ship, m.
    pub geoid: Option<f64>,
    /// Velocity of the water over ground, m/s: the current. Its down component is not used.
    pub current: Option<Ned>,
    /// What the receiver in use says of its fix.
    pub receiver: Option<Receiver>,
}

/// Magnetic variation and where it comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Variation {
    /// East positive, rad.
    pub value: f64,
    /// Year of the World Magnetic Model: 2025 for WMM 2025.
    pub model: u16,
    /// The day for which it was computed, days since 1970-01-01; `None` if not known.
    pub day: Option<u16>,
}

/// What a receiver says of its fix beside position and velocity.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Receiver {
    /// Satellites used.
    pub satellites: Option<u16>,
    /// Horizontal dilution of precision.
    pub hdop: Option<f64>,
    /// Vertical dilution of precision.
    pub vdop: Option<f64>,
    /// Position dilution of precision.
    pub pdop: Option<f64>,
    /// Time dilution of precision.
    pub tdop: Option<f64>,
}

impl Epoch {
    /// An instant of which nothing else is known.
    #[must_use]
    pub fn unknown(time: Time) -> Self {
        Epoch {
            time,
            solution: None,
            covariance_north_east: None,
            utc: None,
            time_source: None,
            heave: None,
            variation: None,
            geoid: None,
            current: None,
            receiver: None,
        }
    }
}
