//! VHW: speed through the water and heading.

use super::kinds::{Decimal, KnotsAndKmh, Turn};
use super::table::sentence;

sentence! {
    /// Speed through the water and heading.
    ///
    /// It has no status, and cannot tell drift from headway. A value that is bad, or stands beside another
    /// letter, is left out.
    approved Vhw "VHW", longest 48: Default;
    /// Heading, rad, clockwise from true north.
    1 heading: Option<f64> = Turn::of(2).with(b'T'), lenient;
    /// Heading, rad, clockwise from magnetic north.
    3 heading_magnetic: Option<f64> = Turn::of(2).with(b'M'), lenient;
    /// Speed through the water along the ship, m/s; some logs send negative values going astern.
    5 speed: Option<f64> = KnotsAndKmh(Decimal::signed(2, 999.9));
}
