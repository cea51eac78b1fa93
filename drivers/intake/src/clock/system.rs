//! Watches the system clock: it may step, and nothing but a word to the operator comes of it.

use insd_base::{Span, Stamp};

/// A difference between the two clocks that changes by more than this at once is a step, s.
const STEP: f64 = 0.05;

/// Remembers how far apart the computer's two clocks are.
#[derive(Clone, Copy, Debug, Default)]
pub struct SystemWatch {
    difference: Option<i64>,
}

impl SystemWatch {
    /// By how much the system clock has stepped since the last stamp, if it has.
    pub fn look(&mut self, stamp: &Stamp) -> Option<Span> {
        let now = stamp.system.as_nanos().saturating_sub(stamp.monotonic.as_nanos());
        let before = self.difference.replace(now)?;
        let step = Span::from_nanos(now.saturating_sub(before));
        (step.as_seconds().abs() > STEP).then_some(step)
    }
}
