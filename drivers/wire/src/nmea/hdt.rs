//! HDT: heading, true.

use super::kinds::Turn;
use super::table::sentence;

sentence! {
    /// Heading without any word on its quality.
    ///
    /// It has no status: a talker that is unsure of its heading must stop sending it. THS replaces it.
    approved Hdt "HDT", longest 20;
    /// Heading, rad, clockwise from true north.
    1 heading: Option<f64> = Turn::of(2).with(b'T');
}
