//! Time and date.

use insd_base::{Span, UtcTime};

use super::bits::Number;
use super::kinds::{Count, DATE, SID, TIME};
use super::table::{codes, group};
use super::{Sid, millis};

codes! {
    /// Where a time comes from.
    TimeSource as TIME_SOURCE, 4 bits;
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

/// Offset of the local time.
const OFFSET: Count<i16> = Count::of(Number::signed(16, 1.0).unit("min"));

group! {
    /// 129033 Time and date.
    129_033 TimeDate: Copy, priority 3, every millis(1000), least 2;
    /// Days since 1970-01-01.
    0 date: Option<u16> = DATE;
    /// UTC, seconds of the day.
    16 time: Option<f64> = TIME;
    /// Local time minus UTC, minutes. Neither source of the layout tells the sign: not verified.
    48 local_offset: Option<i16> = OFFSET;
}

group! {
    /// 126992 System time.
    126_992 SystemTime: Copy, priority 3, every millis(1000), least 4;
    /// Links the messages of one epoch.
    0 sid: Sid = SID;
    /// Where it comes from.
    8 source: Option<TimeSource> = TIME_SOURCE, reserved 4;
    /// Days since 1970-01-01.
    16 date: Option<u16> = DATE;
    /// UTC, seconds of the day.
    32 time: Option<f64> = TIME;
}

const DAY: i64 = 86_400;
const NANOS: f64 = 1e9;
/// Nanoseconds in the step of a time of the day.
const STEP: i64 = 100_000;
/// The last day that a date can tell.
const LAST_DAY: i64 = 65_532;

/// The instant of a date, days since 1970-01-01, and a time, seconds of the day; second 86400, a leap
/// second, is the first of the next day. `None` if either is unknown or out of the range of the wire.
#[must_use]
pub fn utc(date: Option<u16>, time: Option<f64>) -> Option<UtcTime> {
    let days = date.map(i64::from).filter(|days| *days <= LAST_DAY)?;
    let seconds = time.filter(|seconds| (0.0..86_401.0).contains(seconds))?;
    let midnight = UtcTime::from_nanos(days * DAY * NANOS as i64);
    Some(midnight.plus(Span::from_seconds(seconds)))
}

/// The days since 1970-01-01 and the seconds of the day of an instant, to the nearest 0.1 ms, which is
/// the step of the wire: so the seconds stay below 86400. `None` for instants that no date can tell:
/// before 1970, and after 2149.
#[must_use]
pub fn days_and_seconds(utc: UtcTime) -> Option<(u16, f64)> {
    let steps = (utc.as_nanos().checked_add(STEP / 2)?).div_euclid(STEP);
    let of_a_day = DAY * (NANOS as i64 / STEP);
    let days = steps.div_euclid(of_a_day);
    let date = u16::try_from(days).ok().filter(|_| days <= LAST_DAY)?;
    Some((date, steps.rem_euclid(of_a_day) as f64 * STEP as f64 / NANOS))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_instant_survives_as_days_and_seconds() {
        for date in [(1970, 1, 1), (2026, 11, 21), (2149, 6, 3)] {
            let instant = UtcTime::from_civil(date, (23, 59, 59), 999_900_000).unwrap();
            let (days, seconds) = days_and_seconds(instant).unwrap();
            assert_eq!(seconds, 86_399.999_9);
            assert_eq!(utc(Some(days), Some(seconds)), Some(instant));
        }
    }

    #[test]
    fn seconds_of_a_day_never_round_up_to_a_day() {
        let instant = UtcTime::from_civil((2026, 11, 21), (23, 59, 59), 999_960_000).unwrap();
        let (days, seconds) = days_and_seconds(instant).unwrap();
        assert_eq!(seconds, 0.0);
        assert_eq!(utc(Some(days), Some(0.0)), UtcTime::from_civil((2026, 11, 22), (0, 0, 0), 0));
    }

    #[test]
    fn instants_outside_of_the_calendar_of_the_wire_are_refused() {
        assert_eq!(days_and_seconds(UtcTime::from_nanos(-100_000)), None);
        assert_eq!(days_and_seconds(UtcTime::from_nanos(i64::MAX)), None);
        assert!(utc(Some(65_532), Some(86_400.5)).is_some());
        assert_eq!(utc(Some(65_533), Some(0.0)), None);
        assert_eq!(utc(Some(0), Some(86_401.0)), None);
        assert_eq!(utc(Some(0), Some(f64::NAN)), None);
        assert_eq!(utc(None, Some(0.0)), None);
        assert_eq!(utc(Some(0), None), None);
    }
}
