//! Time as integer nanoseconds, so that equal instants compare equal and replays repeat exactly.

use std::ops::{Add, Sub};

use serde::{Deserialize, Serialize};

/// An instant on the time line of one voyage: nanoseconds since the voyage's `start_utc`.
///
/// It never steps: leap seconds and clock corrections are dealt with where time enters.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Default, Serialize, Deserialize,
)]
pub struct Time(i64);

/// A length of time, nanoseconds, signed.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Default, Serialize, Deserialize,
)]
pub struct Span(i64);

const NANOS: f64 = 1e9;

impl Time {
    /// The start of the voyage.
    pub const START: Time = Time(0);

    /// Instant from whole nanoseconds since the start of the voyage.
    #[must_use]
    pub const fn from_nanos(nanos: i64) -> Self {
        Time(nanos)
    }

    /// Instant from seconds since the start of the voyage, rounded to the nearest nanosecond.
    /// Values outside +-292 years saturate and NaN becomes the start: check finiteness first.
    #[must_use]
    pub fn from_seconds(seconds: f64) -> Self {
        Time((seconds * NANOS).round() as i64)
    }

    /// Whole nanoseconds since the start of the voyage.
    #[must_use]
    pub const fn as_nanos(self) -> i64 {
        self.0
    }

    /// Seconds since the start of the voyage.
    #[must_use]
    pub fn as_seconds(self) -> f64 {
        self.0 as f64 / NANOS
    }
}

impl Span {
    /// No time at all.
    pub const ZERO: Span = Span(0);

    /// Length from whole nanoseconds.
    #[must_use]
    pub const fn from_nanos(nanos: i64) -> Self {
        Span(nanos)
    }

    /// Length from seconds, rounded to the nearest nanosecond.
    #[must_use]
    pub fn from_seconds(seconds: f64) -> Self {
        Span((seconds * NANOS).round() as i64)
    }

    /// Whole nanoseconds.
    #[must_use]
    pub const fn as_nanos(self) -> i64 {
        self.0
    }

    /// Seconds.
    #[must_use]
    pub fn as_seconds(self) -> f64 {
        self.0 as f64 / NANOS
    }
}

impl Sub for Time {
    type Output = Span;
    fn sub(self, earlier: Time) -> Span {
        Span(self.0.saturating_sub(earlier.0))
    }
}

impl Add<Span> for Time {
    type Output = Time;
    fn add(self, span: Span) -> Time {
        Time(self.0.saturating_add(span.0))
    }
}

impl Sub<Span> for Time {
    type Output = Time;
    fn sub(self, span: Span) -> Time {
        Time(self.0.saturating_sub(span.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimal_seconds_survive_the_round_trip() {
        for hundredths in [1_i64, 7, 59, 720_000, 1_234_567] {
            let time = Time::from_seconds(hundredths as f64 / 100.0);
            assert_eq!(time.as_nanos(), hundredths * 10_000_000);
        }
    }

    #[test]
    fn differences_of_instants_are_exact() {
        let a = Time::from_seconds(7200.01);
        let b = Time::from_seconds(7200.0);
        assert_eq!((a - b).as_nanos(), 10_000_000);
        assert_eq!(b + (a - b), a);
    }
}
