//! Date and time of day as they stand in sentences: UTC, Gregorian calendar.

use insd_base::UtcTime;

use super::decimal::parse_digits;

/// A time of day, UTC. Second 60 is a leap second.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct TimeOfDay {
    /// 0 to 23.
    pub hour: u8,
    /// 0 to 59.
    pub minute: u8,
    /// 0 to 60.
    pub second: u8,
    /// Nanoseconds of the second.
    pub nanosecond: u32,
}

/// A date, UTC.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Date {
    /// Year, 0 to 9999.
    pub year: u16,
    /// Month, 1 to 12.
    pub month: u8,
    /// Day of the month, 1 to 31.
    pub day: u8,
}

/// Date and time of day, UTC.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct CivilTime {
    /// The date.
    pub date: Date,
    /// The time of day.
    pub time: TimeOfDay,
}

impl CivilTime {
    /// The instant; second 60 is the first of the next minute. `None` if the calendar lacks the day.
    #[must_use]
    pub fn to_utc(self) -> Option<UtcTime> {
        let Date { year, month, day } = self.date;
        let TimeOfDay { hour, minute, second, nanosecond } = self.time;
        UtcTime::from_civil((year.into(), month, day), (hour, minute, second), nanosecond)
    }

    /// Date and time of day of an instant of the years 0 to 9999.
    #[must_use]
    pub fn from_utc(utc: UtcTime) -> Option<Self> {
        let ((year, month, day), nanos) = utc.to_civil();
        let date =
            Date { year: u16::try_from(year).ok().filter(|year| *year <= 9999)?, month, day };
        Some(CivilTime { date, time: TimeOfDay::from_nanos(nanos)? })
    }
}

impl TimeOfDay {
    /// Nanoseconds since midnight; the leap second counts like the first second of the next day.
    #[must_use]
    pub fn as_nanos(self) -> i64 {
        let minutes = i64::from(self.hour) * 60 + i64::from(self.minute);
        (minutes * 60 + i64::from(self.second)) * 1_000_000_000 + i64::from(self.nanosecond)
    }

    /// The time so many nanoseconds after midnight; `None` outside the day.
    #[must_use]
    pub fn from_nanos(nanos: i64) -> Option<Self> {
        let second = 1_000_000_000;
        let part = |value: i64| u8::try_from(value).ok();
        Some(TimeOfDay {
            hour: part(nanos.div_euclid(3600 * second)).filter(|hour| *hour < 24)?,
            minute: part(nanos.div_euclid(60 * second) % 60)?,
            second: part(nanos.div_euclid(second) % 60)?,
            nanosecond: u32::try_from(nanos.rem_euclid(second)).ok()?,
        })
    }

    /// Digits `hhmmss` for the writer.
    pub(crate) fn groups(self) -> [(u32, u8); 3] {
        [(self.hour.into(), 2), (self.minute.into(), 2), (self.second.into(), 2)]
    }

    /// Whether every part is within its range.
    pub(crate) fn is_valid(self) -> bool {
        let clock = self.hour < 24 && self.minute < 60 && self.second <= 60;
        clock && self.nanosecond < 1_000_000_000
    }

    /// Reads `hhmmss[.fraction]`; digits of the fraction beyond nanoseconds are ignored.
    pub(crate) fn parse(text: &str) -> Option<Self> {
        let (clock, fraction) = text.split_once('.').unwrap_or((text, "0"));
        let fraction = if fraction.is_empty() { "0" } else { fraction };
        let part = |from: usize| clock.get(from..from + 2).and_then(parse_digits);
        let time = TimeOfDay {
            hour: u8::try_from(part(0)?).ok()?,
            minute: u8::try_from(part(2)?).ok()?,
            second: u8::try_from(part(4)?).ok()?,
            nanosecond: nanoseconds(fraction)?,
        };
        (clock.len() == 6 && time.is_valid()).then_some(time)
    }
}

impl Date {
    /// A date of numbers as read, not yet checked for its month's length.
    pub(crate) fn from_parts(year: u32, month: u32, day: u32) -> Option<Self> {
        Some(Date {
            year: u16::try_from(year).ok()?,
            month: u8::try_from(month).ok()?,
            day: u8::try_from(day).ok()?,
        })
    }

    /// Digits of day, month and year for the writer.
    pub(crate) fn groups(self) -> [(u32, u8); 3] {
        [(self.day.into(), 2), (self.month.into(), 2), (self.year.into(), 4)]
    }

    /// Digits of day, month and year of the century for the writer.
    pub(crate) fn short_groups(self) -> [(u32, u8); 3] {
        [(self.day.into(), 2), (self.month.into(), 2), (u32::from(self.year % 100), 2)]
    }

    /// Whether the calendar has this day.
    #[must_use]
    pub fn is_valid(self) -> bool {
        let leap = self.year.is_multiple_of(4)
            && (!self.year.is_multiple_of(100) || self.year.is_multiple_of(400));
        let length = match self.month {
            2 => 28 + u8::from(leap),
            4 | 6 | 9 | 11 => 30,
            1..=12 => 31,
            _ => 0,
        };
        (1..=length).contains(&self.day) && self.year <= 9999
    }
}

pub(crate) fn nanoseconds(fraction: &str) -> Option<u32> {
    let mut digits = fraction.bytes();
    let mut nanos = 0;
    for _ in 0..9 {
        let digit = digits.next().unwrap_or(b'0');
        nanos = nanos * 10 + (digit as char).to_digit(10)?;
    }
    digits.all(|digit| digit.is_ascii_digit()).then_some(nanos)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_of_day_are_read_with_and_without_fraction() {
        let time = TimeOfDay { hour: 12, minute: 38, second: 16, nanosecond: 800_000_000 };
        assert_eq!(TimeOfDay::parse("123816.80"), Some(time));
        assert_eq!(TimeOfDay::parse("123816"), Some(TimeOfDay { nanosecond: 0, ..time }));
        for text in ["", "12381", "1238166", "243816", "126016", "123861", "1238-1", "123816.x"] {
            assert_eq!(TimeOfDay::parse(text), None, "{text}");
        }
    }
}
