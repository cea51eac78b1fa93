//! Date and time of day as they stand in sentences: UTC, Gregorian calendar.

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

impl TimeOfDay {
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

fn nanoseconds(fraction: &str) -> Option<u32> {
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
