//! VDR: set and drift, the water's own movement.

use super::kinds::{Decimal, Turn};
use super::table::sentence;

sentence! {
    /// Set and drift.
    approved Vdr "VDR", longest 37: Default;
    /// Direction in which the water moves, rad, clockwise from true north.
    1 set: Option<f64> = Turn::of(2).with(b'T'), lenient;
    /// The same, rad, clockwise from magnetic north.
    3 set_magnetic: Option<f64> = Turn::of(2).with(b'M'), lenient;
    /// Speed of the water, m/s.
    5 drift: Option<f64> = Decimal::magnitude(2, 99.9).knots().with(b'N'), lenient;
}
