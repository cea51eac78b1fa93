//! GNSS receivers: what one message says of one epoch, whatever its format.
//!
//! A receiver spreads an epoch over several messages (GGA and VTG; NAV-PVT and NAV-COV; PVTGeodetic
//! and its covariances). Each becomes a [`GnssPart`]; whoever puts an epoch together knows by
//! [`GnssPart::epoch`] which belong to each other.

pub mod gsof;
pub mod navigation;
pub mod novatel;
pub mod rtcm;
pub mod sbf;
pub mod ubx;

mod bits;
mod cartesian;
mod crc24q;
mod epoch;
mod kepler;
mod locks;
mod pulse;
mod state;
mod words;

pub use epoch::GnssEpoch;
pub use locks::Locks;
pub use pulse::{PulseOrder, PulseTime};
pub use words::NavigationWords;

use insd_base::{FixQuality, Geodetic, GpsTime, UtcTime};

use crate::nmea::{Position, TimeOfDay};

pub mod nmea;

/// The instant of an epoch as far as a message tells it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EpochTime {
    /// Date and time of day.
    Utc(UtcTime),
    /// Time of day without a date: GGA, GST.
    TimeOfDay(TimeOfDay),
    /// Week and time of week.
    Gps(GpsTime),
    /// Time of the GPS week, ns, without the week: NAV-DOP, NAV-COV.
    TimeOfWeek(i64),
}

/// What one message says of one epoch; whatever it does not say is `None`.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct GnssPart {
    /// Name of the message: `GGA`, `NAV-PVT`.
    pub kind: &'static str,
    /// When the epoch was; `None` if the message tells no time (VTG) and belongs to the epoch of the
    /// message before.
    pub epoch: Option<EpochTime>,
    /// Leap seconds (GPS - UTC) as the receiver says.
    pub leap_seconds: Option<i8>,
    /// Accuracy that the receiver claims for its time, s.
    pub time_std: Option<f64>,
    /// Position of the antenna, height above the ellipsoid; `None` if the message does not tell all
    /// three.
    pub position: Option<Geodetic>,
    /// Latitude and longitude of the antenna, of messages of NMEA 0183; also where the height above
    /// the ellipsoid is not known and [`GnssPart::position`] is `None`.
    pub horizontal: Option<Position>,
    /// 1-sigma of north, east, down position, m; a component may be unknown.
    pub position_std: [Option<f64>; 3],
    /// North, east, down velocity of the antenna, m/s; a component may be unknown.
    pub velocity: [Option<f64>; 3],
    /// 1-sigma of north, east, down velocity, m/s.
    pub velocity_std: [Option<f64>; 3],
    /// True heading of the receiver's own baseline or platform, rad.
    pub heading: Option<f64>,
    /// 1-sigma of the heading, rad.
    pub heading_std: Option<f64>,
    /// Horizontal dilution of precision.
    pub hdop: Option<f64>,
    /// Satellites used.
    pub satellites: Option<u16>,
    /// What the receiver says of its fix.
    pub quality: Option<FixQuality>,
    /// The message says that the epoch must not be used, whatever the others say (RMC or GLL with V).
    pub invalid: bool,
}

/// Last week that is taken, in the year 2171: what is beyond is no time, and nanoseconds since 1980
/// have no room for it.
const LAST_WEEK: u16 = 9999;

/// The instant of a full week and nanoseconds of the week, if it is a sane one.
fn gps_time(week: u16, time_of_week: i64) -> Option<GpsTime> {
    (week <= LAST_WEEK).then(|| GpsTime::from_week(week, time_of_week))
}

/// GPS - UTC by the table of this version, s.
fn leap_seconds(at: GpsTime) -> i8 {
    let leap = at.to_utc(Some(0)).since(at.to_utc(None));
    i8::try_from(leap.as_nanos() / 1_000_000_000).unwrap_or_default()
}
