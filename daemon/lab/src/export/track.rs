//! A solution that is to be written, and how its numbers are.

use insd_base::{Geodetic, Time, geoid};
use insd_config::VoyageCalendar;
use insd_drivers::recording::NavRow;

use super::imu::ImuTrack;

/// Decimal places of latitude and longitude, deg, as in `nav.csv`.
const DEGREE_PLACES: i32 = 10;
/// Decimal places of heights and sigmas, m, as in `nav.csv`.
const METRE_PLACES: i32 = 5;

/// A solution that is to be written.
pub struct SolutionTrack<'a> {
    /// What it is called.
    pub name: &'a str,
    /// Its rows in order of time.
    pub rows: &'a [NavRow],
    /// UTC of its times, where it is known.
    pub calendar: Option<VoyageCalendar>,
    /// What the IMU measured, if that is to be told, too.
    pub imu: Option<&'a ImuTrack>,
}

/// A format that tells every instant in UTC, of a solution of which it is not known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("times are told in UTC in this format, which is not known here: give --start-utc")]
pub struct NoUtc;

impl SolutionTrack<'_> {
    /// RFC 3339, to the nanosecond if need be.
    pub(super) fn utc(&self, time: Time) -> Option<String> {
        let nanos = self.calendar?.utc(time).as_nanos();
        jiff::Timestamp::from_nanosecond(nanos.into()).ok().map(|utc| utc.to_string())
    }
}

/// A number with so many decimal places.
pub(super) fn rounded(value: f64, places: i32) -> f64 {
    let scale = 10_f64.powi(places);
    (value * scale).round() / scale
}

/// Latitude and longitude, deg.
pub(super) fn degrees(place: &Geodetic) -> [f64; 2] {
    [place.latitude, place.longitude].map(|angle| rounded(angle.to_degrees(), DEGREE_PLACES))
}

pub(super) fn metres(value: f64) -> f64 {
    rounded(value, METRE_PLACES)
}

/// Height over mean sea level, and that of mean sea level over the ellipsoid, m: their sum is the height as `nav.csv` has it.
pub(super) fn over_sea(place: &Geodetic) -> [f64; 2] {
    let sea = metres(geoid::undulation(place).unwrap_or_default());
    [metres(place.height) - sea, sea]
}

/// A text within XML.
pub(super) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
