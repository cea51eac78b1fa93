//! What a device takes UTC for, with the ways in which devices are wrong.

use insd_base::{GpsTime, Span, Time, UtcTime};
use insd_wire::nmea::{CivilTime, Date, TimeOfDay};

const SECOND: i64 = 1_000_000_000;
const WEEK: i64 = 604_800 * SECOND;
/// Stands for an instant outside the years of a civil time, which a voyage has none of.
const EPOCH: CivilTime = CivilTime {
    date: Date { year: 1970, month: 1, day: 1 },
    time: TimeOfDay { hour: 0, minute: 0, second: 0, nanosecond: 0 },
};

/// UTC of a voyage as a device tells it.
#[derive(Clone, Debug, PartialEq)]
pub struct Calendar {
    /// UTC of the start of the voyage.
    pub start: UtcTime,
    /// Weeks by which dates and week numbers are too early.
    pub weeks_back: i64,
    /// End of a leap second that no table knows: its last second is 23:59:60.
    pub leap: Option<UtcTime>,
    /// From an instant of the voyage on the time is off by so many seconds.
    pub step: Option<(Time, f64)>,
}

impl Calendar {
    /// A device that is right, of a voyage that starts at this instant.
    #[must_use]
    pub fn from(start: UtcTime) -> Self {
        Calendar { start, weeks_back: 0, leap: None, step: None }
    }

    /// A device that is right, from this instant on: `2026-01-01T00:00:00Z`; `None` if it is none.
    #[must_use]
    pub fn new(start_utc: &str) -> Option<Self> {
        let parts = start_utc.split(|c: char| !c.is_ascii_digit()).filter(|part| !part.is_empty());
        let numbers: Vec<i32> = parts.map_while(|part| part.parse().ok()).collect();
        let [year, month, day, hour, minute, second, ..] = numbers[..] else { return None };
        let byte = |number: i32| u8::try_from(number).ok();
        let date = (year, byte(month)?, byte(day)?);
        let time = (byte(hour)?, byte(minute)?, byte(second)?);
        Some(Self::from(UtcTime::from_civil(date, time, 0)?))
    }

    /// GPS time by the device's account, its week as it should be.
    #[must_use]
    pub fn gps(&self, time: Time) -> GpsTime {
        let stepped = self.step.filter(|(from, _)| time >= *from).map_or(0.0, |(_, by)| by);
        let since = (time - Time::START).as_nanos() + Span::from_seconds(stepped).as_nanos();
        GpsTime::from_nanos(self.start.to_gps().as_nanos() + since)
    }

    /// GPS time with the device's week.
    #[must_use]
    pub fn told_gps(&self, time: Time) -> GpsTime {
        GpsTime::from_nanos(self.gps(time).as_nanos() - self.weeks_back * WEEK)
    }

    /// Date and time of day by the device's account.
    #[must_use]
    pub fn civil(&self, time: Time) -> CivilTime {
        let gps = self.gps(time);
        let into_leap = self.leap.map(|end| gps.as_nanos() - end.to_gps().as_nanos());
        let leaping = into_leap.is_some_and(|into| (0..SECOND).contains(&into));
        let leapt = if into_leap.is_some_and(|into| into >= 0) { SECOND } else { 0 };
        let utc = gps.to_utc(None).as_nanos() - leapt - self.weeks_back * WEEK;
        let mut civil = CivilTime::from_utc(UtcTime::from_nanos(utc)).unwrap_or(EPOCH);
        if leaping {
            civil.time.second = 60;
        }
        civil
    }
}
