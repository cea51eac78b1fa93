//! Intervals and delays that all parts of the heave filter share.

/// Interval of the bank and of the history, s.
pub(super) const TICK: f64 = 0.1;
/// Delay of the delayed heave, s.
pub const DELAY: f64 = 120.0;
/// Delay of the heave that the bank is measured against, s: less, to follow a sea that changes.
pub(super) const LESSON: usize = 75;
