//! Statistics of pulses.

use insd_base::{Pulse, Stamp, Time};

use super::message::Intervals;
use super::report::PulseReport;

/// Nanoseconds of a second.
const SECOND: i64 = 1_000_000_000;

/// Pulses of one port.
#[derive(Clone, Debug)]
pub(super) struct Pulses {
    count: u64,
    missed: u64,
    last: Pulse,
    intervals: Intervals,
    ahead_ms: f64,
}

impl Pulses {
    /// Another pulse, after those that came before.
    pub(super) fn with(before: Option<Self>, stamp: &Stamp, pulse: &Pulse) -> Self {
        let first = || Pulses {
            count: 0,
            missed: 0,
            last: Pulse { sequence: pulse.sequence.wrapping_sub(1), ..*pulse },
            intervals: Intervals::default(),
            ahead_ms: 0.0,
        };
        let mut pulses = before.unwrap_or_else(first);
        pulses.count += 1;
        let steps = pulse.sequence.wrapping_sub(pulses.last.sequence);
        pulses.missed += u64::from(steps.saturating_sub(1));
        pulses.last = *pulse;
        pulses.intervals.add(pulse.time);
        pulses.ahead_ms = ahead_ms(stamp, pulse);
        pulses
    }

    pub(super) fn report(&self, now: Time) -> PulseReport {
        PulseReport {
            count: self.count,
            missed: self.missed,
            interval_s: self.intervals.mean(),
            jitter_ms: self.intervals.std().map(|std| std * 1e3),
            age_s: self.intervals.age(now).unwrap_or(0.0),
            clock_ahead_ms: self.ahead_ms,
        }
    }
}

/// How far the computer's time of day was past the nearest whole second at the pulse, ms.
fn ahead_ms(stamp: &Stamp, pulse: &Pulse) -> f64 {
    let since = (stamp.monotonic - pulse.time).as_nanos();
    let edge = stamp.system.as_nanos().saturating_sub(since).rem_euclid(SECOND);
    let ahead = if edge > SECOND / 2 { edge - SECOND } else { edge };
    ahead as f64 / 1e6
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::UtcTime;

    #[test]
    fn missed_pulses_and_the_clock_s_error_are_told() {
        let mut pulses = None;
        for (at, sequence) in [(1, 7), (2, 8), (4, 10)] {
            let time = Time::from_nanos(at * SECOND);
            let monotonic = Time::from_nanos(at * SECOND + 40_000);
            let system = UtcTime::from_nanos((1_800_000_000 + at) * SECOND - 2_960_000);
            let stamp = Stamp { monotonic, system };
            pulses = Some(Pulses::with(pulses, &stamp, &Pulse { time, sequence }));
        }
        let report = pulses.unwrap().report(Time::from_seconds(4.5));
        assert_eq!((report.count, report.missed, report.age_s), (3, 1, 0.5));
        assert_eq!(report.interval_s, Some(1.5));
        assert!((report.clock_ahead_ms + 3.0).abs() < 1e-9);
    }
}
