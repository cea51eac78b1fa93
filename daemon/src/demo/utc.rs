//! From voyage time to the calendar.

use insd_base::{Span, Time};
use insd_output::{CivilTime, Date, TimeOfDay};

/// The calendar of one voyage: UTC of its start.
#[derive(Clone, Copy, Debug)]
pub struct Calendar {
    start: jiff::Timestamp,
}

impl Calendar {
    /// The calendar of a voyage that starts at this RFC 3339 instant; `None` if it is none.
    #[must_use]
    pub fn new(start_utc: &str) -> Option<Self> {
        start_utc.parse().ok().map(|start| Calendar { start })
    }

    /// UTC of an instant; `None` outside the years 0 to 9999.
    #[must_use]
    pub fn utc(&self, time: Time) -> Option<CivilTime> {
        let since_start: Span = time - Time::START;
        let span = jiff::SignedDuration::from_nanos(since_start.as_nanos());
        let instant = self.start.checked_add(span).ok()?;
        let civil = jiff::tz::Offset::UTC.to_datetime(instant);
        Some(CivilTime {
            date: Date {
                year: civil.year().try_into().ok()?,
                month: civil.month().try_into().ok()?,
                day: civil.day().try_into().ok()?,
            },
            time: TimeOfDay {
                hour: civil.hour().try_into().ok()?,
                minute: civil.minute().try_into().ok()?,
                second: civil.second().try_into().ok()?,
                nanosecond: civil.subsec_nanosecond().try_into().ok()?,
            },
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_voyage_sails_across_a_leap_day_into_march() {
        let calendar = Calendar::new("2028-02-28T23:59:59.5Z").unwrap();
        let utc = calendar.utc(Time::from_seconds(0.75)).unwrap();
        assert_eq!(utc.date, Date { year: 2028, month: 2, day: 29 });
        assert_eq!(utc.time.nanosecond, 250_000_000);
        let next = calendar.utc(Time::from_seconds(86_400.75)).unwrap();
        assert_eq!(next.date, Date { year: 2028, month: 3, day: 1 });
    }

    #[test]
    fn a_start_that_is_no_instant_has_no_calendar() {
        assert!(Calendar::new("yesterday").is_none());
    }
}
