//! Time and date.

use super::Sid;

/// Where a time comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TimeSource {
    /// GPS.
    Gps,
    /// GLONASS.
    Glonass,
    /// A radio station.
    RadioStation,
    /// A local caesium clock.
    LocalCesium,
    /// A local rubidium clock.
    LocalRubidium,
    /// A local crystal clock.
    LocalCrystal,
}

/// 129033 Time and date.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeDate {
    /// Days since 1970-01-01.
    pub date: Option<u16>,
    /// UTC, seconds of the day.
    pub time: Option<f64>,
    /// Local time minus UTC, minutes.
    pub local_offset: Option<i16>,
}

/// 126992 System time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SystemTime {
    /// Links the messages of one epoch.
    pub sid: Sid,
    /// Where it comes from.
    pub source: Option<TimeSource>,
    /// Days since 1970-01-01.
    pub date: Option<u16>,
    /// UTC, seconds of the day.
    pub time: Option<f64>,
}
