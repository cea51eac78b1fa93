//! What is asked of who keeps a voyage for smoothing.

use insd_base::Span;

/// How much is kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmoothingPlan {
    /// Interval between what is smoothed by itself, s; in between it is interpolated.
    pub interval: f64,
    /// Interval between the rows of the solution: whole multiples of it since the start of the voyage.
    pub period: Span,
}
