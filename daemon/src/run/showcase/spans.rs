//! Spans of time as the page has them.

use insd_base::{Span, Time};

/// How long ago something was, s.
pub(super) fn age(now: Time, then: Option<Time>) -> Option<f64> {
    then.map(|then| (now - then).as_seconds())
}

/// Milliseconds.
pub(super) fn ms(span: Span) -> f64 {
    (span.as_seconds() * 1e6).round() / 1e3
}
