//! What a receiver, or an integrated system, says of its fix.

use super::Sid;

/// What a fix is made from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GnssSystem {
    /// GPS.
    Gps,
    /// GLONASS.
    Glonass,
    /// GPS and GLONASS.
    GpsGlonass,
    /// GPS with SBAS.
    GpsSbas,
    /// GPS with SBAS, and GLONASS.
    GpsSbasGlonass,
    /// Chayka.
    Chayka,
    /// An integrated navigation system.
    Integrated,
    /// A surveyed place.
    Surveyed,
    /// Galileo.
    Galileo,
    /// Another number, as it stands.
    Other(u8),
}

/// How a fix was made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FixMethod {
    /// There is none.
    NoFix,
    /// GNSS alone.
    Gnss,
    /// With corrections.
    Differential,
    /// Precise (military) GNSS.
    Precise,
    /// RTK, ambiguities fixed.
    RtkFixed,
    /// RTK, ambiguities not fixed.
    RtkFloat,
    /// Dead reckoning.
    DeadReckoning,
    /// Typed in.
    Manual,
    /// A simulator.
    Simulated,
    /// Another number, as it stands.
    Other(u8),
}

/// What a receiver's own watch says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Integrity {
    /// Nobody watches.
    NoChecking,
    /// Safe.
    Safe,
    /// Caution.
    Caution,
    /// Unsafe.
    Unsafe,
}

/// A reference station of a differential fix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// Kind, as the system of the fix.
    pub system: Option<GnssSystem>,
    /// Number of the station.
    pub id: Option<u16>,
    /// Age of its corrections, s.
    pub age: Option<f64>,
}

/// 129029 GNSS position data.
#[derive(Clone, Debug, PartialEq)]
pub struct GnssPosition {
    /// Links the messages of one epoch.
    pub sid: Sid,
    /// Days since 1970-01-01.
    pub date: Option<u16>,
    /// UTC, seconds of the day.
    pub time: Option<f64>,
    /// Geodetic latitude, rad, north positive.
    pub latitude: Option<f64>,
    /// Longitude, rad, east positive.
    pub longitude: Option<f64>,
    /// Altitude, m: the standard says above the ellipsoid of WGS-84; see the notes of the reader.
    pub altitude: Option<f64>,
    /// What the fix is made from.
    pub system: Option<GnssSystem>,
    /// How.
    pub method: Option<FixMethod>,
    /// What the receiver's own watch says.
    pub integrity: Option<Integrity>,
    /// Satellites used.
    pub satellites: Option<u8>,
    /// Horizontal dilution of precision.
    pub hdop: Option<f64>,
    /// Position dilution of precision.
    pub pdop: Option<f64>,
    /// Height of the geoid above the ellipsoid, m.
    pub geoid: Option<f64>,
    /// Reference stations.
    pub stations: Vec<Station>,
}

/// The number of dimensions of a fix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FixMode {
    /// Clock only.
    OneD,
    /// Horizontal.
    TwoD,
    /// With height.
    ThreeD,
    /// Chosen by the receiver.
    Auto,
    /// Another number, as it stands.
    Other(u8),
}

/// 129539 GNSS dilutions of precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dops {
    /// Links the messages of one epoch.
    pub sid: Sid,
    /// What was asked for.
    pub desired: Option<FixMode>,
    /// What there is.
    pub actual: Option<FixMode>,
    /// Horizontal.
    pub hdop: Option<f64>,
    /// Vertical.
    pub vdop: Option<f64>,
    /// Of time.
    pub tdop: Option<f64>,
}

/// 129542 GNSS pseudorange noise statistics.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PseudorangeNoise {
    /// Links the messages of one epoch.
    pub sid: Sid,
    /// Root mean square of the residuals of ranges, m.
    pub range_rms: Option<f64>,
    /// 1-sigma along the major axis of the ellipse of position errors, m.
    pub major: Option<f64>,
    /// 1-sigma along its minor axis, m.
    pub minor: Option<f64>,
    /// Direction of its major axis from true north, rad.
    pub orientation: Option<f64>,
    /// 1-sigma of the latitude, m.
    pub latitude_std: Option<f64>,
    /// 1-sigma of the longitude, m.
    pub longitude_std: Option<f64>,
    /// 1-sigma of the altitude, m.
    pub altitude_std: Option<f64>,
}
