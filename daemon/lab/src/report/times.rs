//! Instants of the ship's time line in UTC, also those before UTC was known.

use insd_base::{Span, Time, UtcTime};
use insd_output::CivilTime;

/// Knots at most.
const LIMIT: usize = 256;

/// What UTC it was at some instants. Between them the ship's own clock tells.
#[derive(Clone, Debug)]
pub(crate) struct Times {
    start: Time,
    end: Time,
    spacing: Span,
    knots: Vec<(Time, UtcTime)>,
    last: Option<(Time, UtcTime)>,
}

impl Times {
    /// A time line that begins here.
    pub(crate) fn new(start: Time) -> Self {
        let spacing = Span::from_nanos(1_000_000_000);
        Times { start, end: start, spacing, knots: Vec::new(), last: None }
    }

    /// It was this UTC, or nobody knew.
    pub(crate) fn note(&mut self, now: Time, utc: Option<UtcTime>) {
        self.end = self.end.max(now);
        let Some(utc) = utc else { return };
        self.last = Some((now, utc));
        if self.knots.last().is_some_and(|(last, _)| now - *last < self.spacing) {
            return;
        }
        self.knots.push((now, utc));
        if self.knots.len() > LIMIT {
            let mut index = 0_usize;
            self.knots.retain(|_| {
                index += 1;
                index % 2 == 1
            });
            self.spacing = Span::from_nanos(self.spacing.as_nanos() * 2);
        }
    }

    /// The first instant.
    pub(crate) fn start(&self) -> Time {
        self.start
    }

    /// The last.
    pub(crate) fn end(&self) -> Time {
        self.end
    }

    /// UTC of an instant; before it was known, by the ship's own clock from what was known first.
    pub(crate) fn utc(&self, time: Time) -> Option<UtcTime> {
        let near = self.knots.partition_point(|(knot, _)| *knot <= time);
        let last = self.last.filter(|(last, _)| *last <= time);
        let knot = last.or_else(|| self.knots.get(near.saturating_sub(1)).copied());
        knot.map(|(knot, utc)| utc.plus(time - knot))
    }

    /// Whether UTC ever became known.
    pub(crate) fn has_utc(&self) -> bool {
        self.last.is_some()
    }

    /// `12:34:56`, with the date if the recording has several, or `+0:12:34` since its beginning.
    pub(crate) fn clock(&self, time: Time) -> String {
        match self.civil(time) {
            Some(civil) if self.is_long() => format!("{} {}", date(&civil), hours(&civil)),
            Some(civil) => hours(&civil),
            None => self.since(time),
        }
    }

    /// `2026-01-02 12:34:56 UTC`, or `+0:12:34` since the beginning.
    pub(crate) fn full(&self, time: Time) -> String {
        self.civil(time).map_or_else(
            || self.since(time),
            |civil| format!("{} {} UTC", date(&civil), hours(&civil)),
        )
    }

    /// The date of an instant.
    pub(crate) fn date(&self, time: Time) -> Option<String> {
        self.civil(time).map(|civil| date(&civil))
    }

    /// What the times of tables are.
    pub(crate) fn heading(&self) -> &'static str {
        if self.has_utc() { "UTC" } else { "since start" }
    }

    fn since(&self, time: Time) -> String {
        format!("+{}", length((time - self.start).as_seconds()))
    }

    fn civil(&self, time: Time) -> Option<CivilTime> {
        // to the nearest second
        self.utc(time).and_then(|utc| CivilTime::from_utc(utc.plus(Span::from_nanos(500_000_000))))
    }

    fn is_long(&self) -> bool {
        let day = |time| self.civil(time).map(|civil| civil.date);
        day(self.start) != day(self.end)
    }
}

fn date(civil: &CivilTime) -> String {
    let date = &civil.date;
    format!("{:04}-{:02}-{:02}", date.year, date.month, date.day)
}

fn hours(civil: &CivilTime) -> String {
    let time = &civil.time;
    format!("{:02}:{:02}:{:02}", time.hour, time.minute, time.second)
}

/// A length of time, s, as `h:mm:ss`.
pub(crate) fn length(seconds: f64) -> String {
    let whole = seconds.round().max(0.0) as u64;
    format!("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(seconds: f64) -> Time {
        Time::from_seconds(seconds)
    }

    fn noon() -> UtcTime {
        UtcTime::from_civil((2026, 2, 28), (12, 0, 0), 0).unwrap()
    }

    #[test]
    fn what_was_before_utc_was_known_has_its_utc_too() {
        let mut times = Times::new(at(100.0));
        times.note(at(110.0), None);
        assert_eq!((times.clock(at(110.0)).as_str(), times.heading()), ("+0:00:10", "since start"));
        times.note(at(130.0), Some(noon()));
        assert_eq!(times.clock(at(100.0)), "11:59:30");
        assert_eq!(times.full(at(130.4)), "2026-02-28 12:00:00 UTC");
    }

    #[test]
    fn a_week_takes_no_more_room_than_an_hour_and_a_clock_that_drifts_is_followed() {
        let mut times = Times::new(at(0.0));
        for second in 0..7 * 86_400 {
            let drift = Span::from_nanos(i64::from(second) * 10_000);
            let utc = noon().plus(Span::from_seconds(f64::from(second))).plus(drift);
            times.note(at(f64::from(second)), Some(utc));
        }
        assert!(times.knots.len() <= LIMIT);
        assert_eq!(times.clock(at(6.0 * 86_400.0)), "2026-03-06 12:00:05");
        assert_eq!(times.clock(times.end()), "2026-03-07 12:00:05");
    }

    #[test]
    fn lengths_are_hours_minutes_and_seconds() {
        assert_eq!((length(3725.4).as_str(), length(-1.0).as_str()), ("1:02:05", "0:00:00"));
    }
}
