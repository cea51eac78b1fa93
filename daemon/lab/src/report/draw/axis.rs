//! The axis of time.

use std::fmt::Write as _;

use insd_base::{Span, Time};

use super::WIDTH;
use crate::report::collect::lane::Run;
use crate::report::times::Times;

/// Spacings of marks, s.
const STEPS: [i64; 21] = [
    1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 10_800, 21_600, 43_200, 86_400,
    172_800, 604_800, 2_592_000,
];
/// Marks at most.
const MARKS: i64 = 10;
const SECOND: i64 = 1_000_000_000;
const DAY: i64 = 86_400;
/// Room at the right, px.
const RIGHT: f64 = 28.0;

/// Time from left to right.
#[derive(Clone, Debug)]
pub(crate) struct TimeAxis {
    from: Time,
    to: Time,
    pub(crate) left: f64,
    marks: Vec<(f64, String)>,
}

impl TimeAxis {
    /// The whole recording, with so much room at the left.
    pub(crate) fn new(times: &Times, left: f64) -> Self {
        let (from, to) = (times.start(), times.end());
        let to = to.max(from + Span::from_nanos(SECOND));
        let mut axis = TimeAxis { from, to, left, marks: Vec::new() };
        axis.marks = axis.make_marks(times);
        axis
    }

    /// The right end, px.
    pub(crate) fn right(&self) -> f64 {
        WIDTH - RIGHT
    }

    /// Where an instant is, px.
    pub(crate) fn x(&self, time: Time) -> f64 {
        let share = (time - self.from).as_seconds() / (self.to - self.from).as_seconds();
        self.left + share.clamp(0.0, 1.0) * (self.right() - self.left)
    }

    /// Left end and width of a run, px; never so narrow that it cannot be seen.
    pub(crate) fn extent(&self, run: &Run) -> (f64, f64) {
        let (from, to) = (self.x(run.from), self.x(run.to));
        (from, (to - from).max(1.0))
    }

    /// Lines from the top to the foot of a drawing, and labels so far below it.
    pub(crate) fn draw(&self, svg: &mut String, top: f64, bottom: f64, room: f64) {
        for (x, label) in &self.marks {
            let _ = write!(svg, "<path class=\"grid\" d=\"M{x:.1} {top:.1}V{bottom:.1}\"/>");
            let below = bottom + room + 14.0;
            let _ = write!(svg, "<text class=\"mid\" x=\"{x:.1}\" y=\"{below:.1}\">{label}</text>");
        }
    }

    /// At round UTC where it is known, else at round times since the start.
    fn make_marks(&self, times: &Times) -> Vec<(f64, String)> {
        let middle = self.from + Span::from_nanos((self.to - self.from).as_nanos() / 2);
        let shift = match times.utc(middle) {
            Some(utc) => utc.as_nanos().saturating_sub(middle.as_nanos()),
            None => -self.from.as_nanos(),
        };
        let first = self.from.as_nanos().saturating_add(shift);
        let last = self.to.as_nanos().saturating_add(shift);
        let step = step(last.saturating_sub(first) / SECOND);
        let begin = first.div_euclid(step * SECOND) + i64::from(first % (step * SECOND) != 0);
        let end = last.div_euclid(step * SECOND);
        let mark = |index: i64| {
            let seconds = index * step;
            let time = Time::from_nanos((seconds * SECOND).saturating_sub(shift));
            let is_midnight = times.has_utc() && seconds.rem_euclid(DAY) == 0;
            let date = times.date(time).filter(|_| is_midnight);
            (self.x(time), date.unwrap_or_else(|| label(seconds, step, times.has_utc())))
        };
        (begin..=end).map(mark).collect()
    }
}

fn step(seconds: i64) -> i64 {
    STEPS.into_iter().find(|step| seconds / step <= MARKS).unwrap_or(seconds.max(1))
}

fn label(seconds: i64, step: i64, is_utc: bool) -> String {
    let hours = if is_utc { seconds.rem_euclid(DAY) / 3600 } else { seconds / 3600 };
    let minutes = seconds.rem_euclid(3600) / 60;
    let sign = if is_utc { "" } else { "+" };
    match step {
        60.. => format!("{sign}{hours:02}:{minutes:02}"),
        _ => format!("{sign}{hours:02}:{minutes:02}:{:02}", seconds.rem_euclid(60)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::UtcTime;

    fn labels(seconds: f64, utc: bool) -> Vec<String> {
        let mut times = Times::new(Time::from_seconds(50.0));
        let start = UtcTime::from_civil((2026, 1, 1), (23, 50, 5), 0).filter(|_| utc);
        times.note(Time::from_seconds(50.0), start);
        times.note(Time::from_seconds(50.0 + seconds), None);
        TimeAxis::new(&times, 0.0).marks.into_iter().map(|(_, label)| label).collect()
    }

    #[test]
    fn marks_are_at_round_utc_and_midnight_has_its_date() {
        assert_eq!(labels(1200.0, true)[..3], ["23:52", "23:54", "23:56"]);
        assert!(labels(1200.0, true).contains(&"2026-01-02".to_owned()));
        assert!(labels(20.0, true).contains(&"23:50:10".to_owned()));
    }

    #[test]
    fn without_utc_marks_count_from_the_start() {
        assert_eq!(labels(900.0, false)[..3], ["+00:00", "+00:02", "+00:04"]);
    }
}
