//! HCR: which corrections a gyro compass has made to its heading.

use super::kinds::{Decimal, Needed, Turn, letter};
use super::mode::{HeadingMode, letters};
use super::table::sentence;

/// Corrections that a heading has in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum HeadingCorrections {
    /// A: for speed and latitude, and for acceleration.
    Both,
    /// D: for acceleration.
    Dynamic,
    /// S: for speed and latitude.
    SpeedLatitude,
    /// N.
    Uncorrected,
    /// V: the talker does not know.
    Unknown,
}

letters! {
    HeadingCorrections {
        Both b'A', Dynamic b'D', SpeedLatitude b'S', Uncorrected b'N', Unknown b'V'
    }
}

sentence! {
    /// A heading and its corrections.
    ///
    /// The example of a Kongsberg MGC R3 is read by a test; the letters of field 3 are those of two public
    /// parsers. Which way field 4 is positive is not stated where we could look.
    approved Hcr "HCR", longest 27;
    /// Heading, rad, clockwise from true north.
    1 heading: Option<f64> = Turn::of(1);
    /// How it was found; never empty.
    2 mode: HeadingMode = Needed(letter());
    /// Which corrections are in it; never empty.
    3 corrections: HeadingCorrections = Needed(letter());
    /// Their sum as it was sent, rad.
    4 correction: Option<f64> = Decimal::signed(1, 180.0).degrees();
}
