//! Statistics of one kind of message.

use insd_base::Time;
use insd_wire::describe::ReadOutcome;
use insd_wire::stream::Protocol;

use super::named::Named;
use super::report::{LogAxes, MessageReport, RefusedMessage};

/// Bytes of a refused message that are kept.
const KEPT: usize = 96;

/// Bytes of a refused binary message that are kept.
const KEPT_BINARY: usize = 24;

/// Least time over which a rate means something, s.
const LEAST: f64 = 0.2;

/// What came under one name.
#[derive(Clone, Debug)]
pub(super) struct Message {
    pub(super) protocol: Protocol,
    pub(super) name: String,
    count: u64,
    used: u64,
    refused: u64,
    bare: u64,
    flawed: u64,
    intervals: Intervals,
    refusal: Option<RefusedMessage>,
    flaw: Option<RefusedMessage>,
    axes: Option<LogAxes>,
}

/// Mean and spread of the intervals between instants, kept while they pass (Welford).
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Intervals {
    last: Option<Time>,
    count: u64,
    mean: f64,
    squares: f64,
}

impl Message {
    pub(super) fn new(protocol: Protocol, name: &str) -> Self {
        Message {
            protocol,
            name: name.to_owned(),
            count: 0,
            used: 0,
            refused: 0,
            bare: 0,
            flawed: 0,
            intervals: Intervals::default(),
            refusal: None,
            flaw: None,
            axes: None,
        }
    }

    /// One more, whose first byte came at this time.
    pub(super) fn add(&mut self, named: &Named<'_>, begun: Time, bytes: &[u8]) {
        self.count += 1;
        self.intervals.add(begun);
        self.bare += u64::from(named.bare);
        self.axes = named.axes.or(self.axes);
        let told = |reason: &Option<String>| {
            let reason = reason.clone().unwrap_or_default();
            Some(RefusedMessage { reason, bytes: excerpt(bytes) })
        };
        match named.read {
            ReadOutcome::Used => {
                self.used += 1;
                if named.reason.is_some() {
                    self.flawed += 1;
                    self.flaw = told(&named.reason);
                }
            }
            ReadOutcome::Other => {}
            ReadOutcome::Refused => {
                self.refused += 1;
                self.refusal = told(&named.reason);
            }
        }
    }

    /// What is known of it at this time, or without time.
    pub(super) fn report(&self, now: Option<Time>) -> MessageReport {
        let timed = now.map(|now| (now, &self.intervals));
        MessageReport {
            protocol: self.protocol,
            name: self.name.clone(),
            count: self.count,
            used: self.used,
            refused: self.refused,
            bare: self.bare,
            flawed: self.flawed,
            rate_hz: timed.and_then(|(_, intervals)| intervals.rate()),
            jitter_ms: timed.and_then(|(_, intervals)| Some(intervals.std()? * 1e3)),
            age_s: timed.and_then(|(now, intervals)| intervals.age(now)),
            refusal: self.refusal.clone(),
            flaw: self.flaw.clone(),
            axes: self.axes,
        }
    }
}

impl Intervals {
    /// Another instant.
    pub(super) fn add(&mut self, at: Time) {
        if let Some(last) = self.last {
            let interval = (at - last).as_seconds();
            self.count += 1;
            let off = interval - self.mean;
            self.mean += off / self.count as f64;
            self.squares += off * (interval - self.mean);
        }
        self.last = Some(at);
    }

    /// Mean interval, s, if it is not zero.
    pub(super) fn mean(&self) -> Option<f64> {
        (self.count > 0 && self.mean > 0.0).then_some(self.mean)
    }

    /// Instants per second, unless they all came at nearly the same time.
    pub(super) fn rate(&self) -> Option<f64> {
        let mean = self.mean().filter(|mean| mean * self.count as f64 >= LEAST)?;
        Some(1.0 / mean)
    }

    /// Standard deviation of the intervals, s, of two or more.
    pub(super) fn std(&self) -> Option<f64> {
        (self.count > 1).then(|| (self.squares / (self.count - 1) as f64).max(0.0).sqrt())
    }

    /// Time since the last instant, s.
    pub(super) fn age(&self, now: Time) -> Option<f64> {
        self.last.map(|last| (now - last).as_seconds().max(0.0))
    }
}

/// First bytes of a message: text as it is, everything else in hexadecimal digits.
pub(super) fn excerpt(bytes: &[u8]) -> String {
    let bytes = bytes.trim_ascii_end();
    let is_text = bytes.iter().all(|byte| (b' '..=b'~').contains(byte));
    let kept = bytes.get(..if is_text { KEPT } else { KEPT_BINARY }).unwrap_or(bytes);
    let mut text = if is_text {
        String::from_utf8_lossy(kept).into_owned()
    } else {
        kept.iter().map(|byte| format!("{byte:02X}")).collect::<Vec<_>>().join(" ")
    };
    if kept.len() < bytes.len() {
        text.push_str(" ...");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rate_and_jitter_are_those_of_the_intervals() {
        let mut intervals = Intervals::default();
        for at in [0.0, 0.09, 0.2, 0.29, 0.4] {
            intervals.add(Time::from_seconds(at));
        }
        assert!((intervals.mean().unwrap() - 0.1).abs() < 1e-12);
        let expected = (4.0 * 0.01_f64.powi(2) / 3.0).sqrt();
        assert!((intervals.std().unwrap() - expected).abs() < 1e-9);
        assert!((intervals.rate().unwrap() - 10.0).abs() < 1e-9);
        assert_eq!(intervals.age(Time::from_seconds(1.4)), Some(1.0));
    }

    #[test]
    fn one_message_has_neither_rate_nor_jitter() {
        let mut intervals = Intervals::default();
        assert_eq!(intervals.age(Time::START), None);
        intervals.add(Time::START);
        assert_eq!((intervals.mean(), intervals.std()), (None, None));
    }

    #[test]
    fn what_came_in_one_burst_has_no_rate() {
        let mut intervals = Intervals::default();
        (0..50).for_each(|n| intervals.add(Time::from_seconds(f64::from(n) / 1e4)));
        assert_eq!(intervals.rate(), None);
    }

    #[test]
    fn an_excerpt_is_text_or_digits_and_short() {
        assert_eq!(excerpt(b"$A*41\r\n"), "$A*41");
        assert_eq!(excerpt(b"\xB5\x62\x01"), "B5 62 01");
        assert!(excerpt(&[0xFF; 1000]).len() < 80 && excerpt(&[b'x'; 1000]).len() < 120);
    }
}
