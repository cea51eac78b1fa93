//! Time scales at the border: UTC and GPS time. Inside, everything runs on [`crate::Time`].

use serde::{Deserialize, Serialize};

use crate::time::Span;

/// An instant in UTC: nanoseconds since 1970-01-01T00:00:00Z, leap seconds not counted (POSIX).
///
/// During a positive leap second the count of the second before repeats.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct UtcTime(i64);

/// An instant in GPS time: nanoseconds since 1980-01-06T00:00:00 GPS, which knows no leap seconds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct GpsTime(i64);

const SECOND: i64 = 1_000_000_000;

/// Seconds from the POSIX epoch to the GPS epoch.
const GPS_EPOCH: i64 = 315_964_800;

/// Seconds of a GPS week.
const WEEK: i64 = 604_800;

/// UTC seconds since 1970 at which GPS - UTC became 1, 2, ... 18 s (IERS Bulletin C; none announced
/// after 2017-01-01 up to the end of 2026).
const LEAPS: [i64; 18] = [
    362_793_600,
    394_329_600,
    425_865_600,
    489_024_000,
    567_993_600,
    631_152_000,
    662_688_000,
    709_948_800,
    741_484_800,
    773_020_800,
    820_454_400,
    867_715_200,
    915_148_800,
    1_136_073_600,
    1_230_768_000,
    1_341_100_800,
    1_435_708_800,
    1_483_228_800,
];

impl UtcTime {
    /// Instant from nanoseconds since 1970.
    #[must_use]
    pub const fn from_nanos(nanos: i64) -> Self {
        UtcTime(nanos)
    }

    /// Nanoseconds since 1970.
    #[must_use]
    pub const fn as_nanos(self) -> i64 {
        self.0
    }

    /// The instant of a date and time of day; second 60 is the first of the next minute. `None` if a
    /// part is out of its range, or the instant outside 1677 to 2262.
    #[must_use]
    pub fn from_civil(date: (i32, u8, u8), clock: (u8, u8, u8), nanosecond: u32) -> Option<Self> {
        let (hour, minute, second) = clock;
        let valid = hour < 24 && minute < 60 && second <= 60 && nanosecond < 1_000_000_000;
        let days = days_since_1970(date).filter(|_| valid)?;
        let of_day = i64::from(hour) * 3600 + i64::from(minute) * 60 + i64::from(second);
        let nanos = (days * 86_400 + of_day).checked_mul(SECOND)?;
        nanos.checked_add(i64::from(nanosecond)).map(UtcTime)
    }

    /// Year, month and day; then nanoseconds of the day.
    #[must_use]
    pub fn to_civil(self) -> ((i32, u8, u8), i64) {
        let day = 86_400 * SECOND;
        (date_of(self.0.div_euclid(day)), self.0.rem_euclid(day))
    }

    /// The same instant in GPS time, by the table of leap seconds of this version.
    #[must_use]
    pub fn to_gps(self) -> GpsTime {
        let leaps = LEAPS.partition_point(|leap| leap * SECOND <= self.0) as i64;
        GpsTime(self.0.saturating_sub((GPS_EPOCH - leaps) * SECOND))
    }

    /// This instant later by a span.
    #[must_use]
    pub fn plus(self, span: Span) -> Self {
        UtcTime(self.0.saturating_add(span.as_nanos()))
    }

    /// The span since an earlier instant, leap seconds not counted.
    #[must_use]
    pub fn since(self, earlier: UtcTime) -> Span {
        Span::from_nanos(self.0.saturating_sub(earlier.0))
    }
}

impl GpsTime {
    /// Instant from nanoseconds since the GPS epoch.
    #[must_use]
    pub const fn from_nanos(nanos: i64) -> Self {
        GpsTime(nanos)
    }

    /// Nanoseconds since the GPS epoch.
    #[must_use]
    pub const fn as_nanos(self) -> i64 {
        self.0
    }

    /// Instant from a full week number and nanoseconds of the week; weeks after 2272 saturate.
    #[must_use]
    pub fn from_week(week: u16, tow_nanos: i64) -> Self {
        GpsTime((i64::from(week) * WEEK).saturating_mul(SECOND).saturating_add(tow_nanos))
    }

    /// Full week number and nanoseconds of the week.
    #[must_use]
    pub fn to_week(self) -> (i64, i64) {
        (self.0.div_euclid(WEEK * SECOND), self.0.rem_euclid(WEEK * SECOND))
    }

    /// This instant later by a span.
    #[must_use]
    pub fn plus(self, span: Span) -> Self {
        GpsTime(self.0.saturating_add(span.as_nanos()))
    }

    /// The span since an earlier instant.
    #[must_use]
    pub fn since(self, earlier: GpsTime) -> Span {
        Span::from_nanos(self.0.saturating_sub(earlier.0))
    }

    /// The instant with this time of week that is nearest to `self`.
    #[must_use]
    pub fn nearest_with_tow(self, tow_nanos: i64) -> Self {
        self.nearest(tow_nanos, WEEK * SECOND)
    }

    /// The instant nearest to `near` that differs from `self` by whole cycles of 1024 weeks: what a
    /// receiver with a ten-bit week number means.
    #[must_use]
    pub fn nearest_rollover(self, near: GpsTime) -> Self {
        near.nearest(self.0, 1024 * WEEK * SECOND)
    }

    fn nearest(self, nanos: i64, cycle: i64) -> Self {
        // apart, as their difference may be more than 64 bits hold
        let ahead = (nanos.rem_euclid(cycle) - self.0.rem_euclid(cycle)).rem_euclid(cycle);
        GpsTime(self.0.saturating_add(if ahead > cycle / 2 { ahead - cycle } else { ahead }))
    }

    /// The same instant in UTC, with GPS - UTC as the receiver says, or by the table of this version.
    #[must_use]
    pub fn to_utc(self, leap_seconds: Option<i8>) -> UtcTime {
        let posix = self.0.saturating_add(GPS_EPOCH * SECOND);
        let table = || {
            let passed = LEAPS.iter().zip(1..);
            let mut counted = 0;
            for (leap, count) in passed {
                if posix >= (leap + count) * SECOND {
                    counted = count;
                }
            }
            counted
        };
        UtcTime(posix.saturating_sub(leap_seconds.map_or_else(table, i64::from) * SECOND))
    }
}

/// Days since 1970-01-01 of a date of the Gregorian calendar, by counting from 1 March, after which
/// the leap day is the last of the year.
fn days_since_1970((year, month, day): (i32, u8, u8)) -> Option<i64> {
    if !(1..=12).contains(&month) || !(1..=31).contains(&day) {
        return None;
    }
    let shifted = i64::from(year) - i64::from(month <= 2);
    let (era, of_era) = (shifted.div_euclid(400), shifted.rem_euclid(400));
    let march_based = (i64::from(month) + 9) % 12;
    let day_of_year = (153 * march_based + 2) / 5 + i64::from(day) - 1;
    let days = era * 146_097 + of_era * 365 + of_era / 4 - of_era / 100 + day_of_year - 719_468;
    (date_of(days) == (year, month, day)).then_some(days)
}

fn date_of(days: i64) -> (i32, u8, u8) {
    let from_march = days + 719_468;
    let (era, of_era) = (from_march.div_euclid(146_097), from_march.rem_euclid(146_097));
    let year_of_era = (of_era - of_era / 1460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let march_based = (5 * of_year + 2) / 153;
    let day = of_year - (153 * march_based + 2) / 5 + 1;
    let month = if march_based < 10 { march_based + 3 } else { march_based - 9 };
    let year = year_of_era + era * 400 + i64::from(month <= 2);
    (year as i32, month as u8, day as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_dates_have_their_known_counts() {
        let at = |date, clock| UtcTime::from_civil(date, clock, 0).unwrap().as_nanos() / SECOND;
        assert_eq!(at((1970, 1, 1), (0, 0, 0)), 0);
        assert_eq!(at((1980, 1, 6), (0, 0, 0)), GPS_EPOCH);
        assert_eq!(at((2024, 2, 29), (12, 0, 0)), 1_709_208_000);
        assert_eq!(at((2016, 12, 31), (23, 59, 60)), 1_483_228_800);
        for wrong in [(2023, 2, 29), (2024, 4, 31), (2024, 13, 1), (2024, 0, 1), (2024, 1, 0)] {
            assert_eq!(UtcTime::from_civil(wrong, (0, 0, 0), 0), None);
        }
    }

    #[test]
    fn every_day_of_five_centuries_comes_back() {
        for days in -100_000..100_000 {
            let (date, _) = UtcTime::from_nanos(days * 86_400 * SECOND).to_civil();
            assert_eq!(days_since_1970(date), Some(days));
        }
    }

    #[test]
    fn leap_seconds_are_counted_where_they_fell() {
        for (leap, count) in LEAPS.into_iter().zip(1..) {
            for (from_leap, expected) in [(-1, count - 1), (0, count)] {
                let utc = UtcTime::from_nanos((leap + from_leap) * SECOND);
                let gps = utc.to_gps();
                assert_eq!(gps.as_nanos() / SECOND, leap + from_leap - GPS_EPOCH + expected);
                assert_eq!(gps.to_utc(None), utc);
            }
        }
    }

    #[test]
    fn a_receiver_with_a_ten_bit_week_is_put_into_the_right_cycle() {
        let near = GpsTime::from_week(2445, 0);
        let told = GpsTime::from_week(2446 - 2048, 5 * SECOND);
        assert_eq!(told.nearest_rollover(near), GpsTime::from_week(2446, 5 * SECOND));
        let far = GpsTime::from_nanos(i64::MIN).nearest_rollover(near);
        let cycle = i128::from(1024 * WEEK * SECOND);
        assert_eq!((i128::from(far.as_nanos()) - i128::from(i64::MIN)) % cycle, 0);
        let late = near.nearest_with_tow(604_799 * SECOND);
        assert_eq!(late, GpsTime::from_week(2444, 604_799 * SECOND));
    }
}
