//! HDM: heading, magnetic.

use super::kinds::Turn;
use super::table::sentence;

sentence! {
    /// Magnetic heading. It is not in the newer editions; HDG replaces it.
    approved Hdm "HDM", longest 20;
    /// Heading, rad, clockwise from magnetic north.
    1 heading: Option<f64> = Turn::of(2).with(b'M');
}
