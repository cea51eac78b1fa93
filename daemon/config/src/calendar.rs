//! From voyage time to the calendar.

use insd_base::{Time, UtcTime};
use insd_output::CivilTime;

/// An instant as people and files write it; empty where no calendar reaches.
#[must_use]
pub fn rfc3339(utc: UtcTime) -> String {
    let instant = jiff::Timestamp::from_nanosecond(i128::from(utc.as_nanos()));
    instant.map(|instant| format!("{instant:.0}")).unwrap_or_default()
}

/// The same with milliseconds.
#[must_use]
pub fn rfc3339_millis(utc: UtcTime) -> String {
    let instant = jiff::Timestamp::from_nanosecond(i128::from(utc.as_nanos()));
    instant.map(|instant| format!("{instant:.3}")).unwrap_or_default()
}

/// The calendar of one voyage: UTC of its start.
#[derive(Clone, Copy, Debug)]
pub struct VoyageCalendar {
    start: UtcTime,
}

impl VoyageCalendar {
    /// The calendar of a voyage that starts at this RFC 3339 instant; `None` if it is none, or outside
    /// the years that [`UtcTime`] holds.
    #[must_use]
    pub fn new(start_utc: &str) -> Option<Self> {
        let start: jiff::Timestamp = start_utc.parse().ok()?;
        let nanos = i64::try_from(start.as_nanosecond()).ok()?;
        Some(VoyageCalendar { start: UtcTime::from_nanos(nanos) })
    }

    /// UTC of an instant.
    #[must_use]
    pub fn utc(&self, time: Time) -> UtcTime {
        self.start.plus(time - Time::START)
    }

    /// The same as date and time of day.
    #[must_use]
    pub fn civil(&self, time: Time) -> Option<CivilTime> {
        CivilTime::from_utc(self.utc(time))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_output::Date;

    #[test]
    fn a_voyage_sails_across_a_leap_day_into_march() {
        let calendar = VoyageCalendar::new("2028-02-28T23:59:59.5Z").unwrap();
        let utc = calendar.civil(Time::from_seconds(0.75)).unwrap();
        assert_eq!(utc.date, Date { year: 2028, month: 2, day: 29 });
        assert_eq!(utc.time.nanosecond, 250_000_000);
        let next = calendar.civil(Time::from_seconds(86_400.75)).unwrap();
        assert_eq!(next.date, Date { year: 2028, month: 3, day: 1 });
    }

    #[test]
    fn a_start_that_is_no_instant_has_no_calendar() {
        assert!(VoyageCalendar::new("yesterday").is_none());
    }
}
