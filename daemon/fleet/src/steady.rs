//! UTC by which records grow too old: one that has not stepped for long.
//!
//! What receivers tell may step (a spoofer, a rollover of weeks, a receiver that begins with another date). A step that is healed
//! within the hour must not make anybody throw away what waits.

use insd_base::{Span, Time, UtcTime};

/// It must have gone with the monotonic clock for so long.
const STEADY: Span = Span::from_nanos(3_600_000_000_000);
/// More than this beside it is a step.
const STEP: i64 = 2_000_000_000;

/// Watches UTC beside the monotonic clock.
#[derive(Debug, Default)]
pub(crate) struct SteadyUtc {
    /// Monotonic time and UTC as they were told last, and since when they have gone together.
    last: Option<(Time, UtcTime, Time)>,
}

impl SteadyUtc {
    /// UTC was told at a time.
    pub(crate) fn hear(&mut self, now: Time, utc: UtcTime) {
        let since = match self.last {
            Some((then, before, since)) => {
                let apart = (utc.as_nanos().saturating_sub(before.as_nanos()))
                    .saturating_sub((now - then).as_nanos());
                if apart.abs() <= STEP { since } else { now }
            }
            None => now,
        };
        self.last = Some((now, utc, since));
    }

    /// The last one that was told, if it has been steady for long.
    pub(crate) fn utc(&self) -> Option<UtcTime> {
        self.last.filter(|(now, _, since)| *now - *since >= STEADY).map(|(_, utc, _)| utc)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const START: i64 = 1_800_000_000_000_000_000;

    fn at(seconds: i64, step: i64) -> (Time, UtcTime) {
        let nanos = seconds * 1_000_000_000;
        (Time::from_nanos(nanos), UtcTime::from_nanos(START + nanos + step * 1_000_000_000))
    }

    #[test]
    fn nothing_grows_old_by_a_clock_that_has_stepped_within_the_hour() {
        let mut steady = SteadyUtc::default();
        for second in 0..=3600 {
            assert_eq!(steady.utc(), None);
            let (now, utc) = at(second, 0);
            steady.hear(now, utc);
        }
        assert_eq!(steady.utc(), Some(at(3600, 0).1));
        // 1024 weeks ahead for ten minutes, and back
        let weeks = 1024 * 7 * 86_400;
        for second in 3601..10_000 {
            let step = if second < 4200 { weeks } else { 0 };
            let (now, utc) = at(second, step);
            steady.hear(now, utc);
            let is_steady = second >= 4200 + 3600;
            assert_eq!(steady.utc().is_some(), is_steady, "{second}");
        }
    }
}
