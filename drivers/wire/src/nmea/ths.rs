//! THS: true heading and status. It replaces HDT.

use super::kinds::{Needed, Turn, letter};
use super::mode::HeadingMode;
use super::table::sentence;

sentence! {
    /// Heading with its mode.
    approved Ths "THS", longest 20;
    /// Heading, rad, clockwise from true north.
    1 heading: Option<f64> = Turn::of(2);
    /// How it was found.
    2 mode: HeadingMode = Needed(letter());
}
