//! The heartbeat of a node.

use insd_base::{Span, Time};

use crate::groups::{Controller, Heartbeat};

/// The heartbeat's interval where nobody wants another.
pub(crate) const PULSE: Span = Span::from_nanos(60_000_000_000);

/// When the next heartbeat is due.
#[derive(Clone, Debug)]
pub(crate) struct Pulse {
    interval: Span,
    next: Option<Time>,
    sequence: u8,
}

impl Default for Pulse {
    fn default() -> Self {
        Pulse { interval: PULSE, next: None, sequence: 0 }
    }
}

impl Pulse {
    /// The first now, and then at the interval.
    pub(crate) fn start(&mut self, now: Time) {
        self.next = Some(now);
    }

    pub(crate) fn stop(&mut self) {
        self.next = None;
    }

    pub(crate) fn interval(&self) -> Span {
        self.interval
    }

    /// Another interval, the first heartbeat at that time.
    pub(crate) fn set(&mut self, interval: Span, first: Time) {
        self.interval = interval;
        self.next = Some(first);
    }

    pub(crate) fn next(&self) -> Option<Time> {
        self.next
    }

    /// Whether one is due; then the next is an interval later.
    pub(crate) fn is_due(&mut self, now: Time) -> bool {
        let Some(due) = self.next.filter(|due| *due <= now) else { return false };
        let regular = due + self.interval;
        self.next = Some(if regular > now { regular } else { now + self.interval });
        true
    }

    /// The contents of the next heartbeat.
    pub(super) fn beat(&mut self) -> Heartbeat {
        let sequence = Some(self.sequence);
        self.sequence = if self.sequence >= 252 { 0 } else { self.sequence + 1 };
        let first = Some(Controller::Active);
        Heartbeat { interval: Some(self.interval), sequence, first, second: None, fault: None }
    }
}
