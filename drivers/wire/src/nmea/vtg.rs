//! VTG: course and speed over ground.

use super::kinds::{Decimal, KnotsAndKmh, Otherwise, Turn, letter};
use super::mode::PositionMode;
use super::table::sentence;

sentence! {
    /// Course and speed over ground.
    ///
    /// The unit letters stay even beside an empty field: readers tell the older layout without letters
    /// by them. The mode must be good; a value that is bad, or stands beside another letter, is left out.
    approved Vtg "VTG", longest 48;
    /// Course over ground, rad, clockwise from true north.
    1 course: Option<f64> = Turn::of(2).with(b'T'), lenient;
    /// Course over ground, rad, clockwise from magnetic north.
    3 course_magnetic: Option<f64> = Turn::of(2).with(b'M'), lenient;
    /// Speed over ground, m/s.
    5 speed: Option<f64> = KnotsAndKmh(Decimal::magnitude(2, 9999.9));
    /// How it was found; an unknown mode is written as not valid. Absent before NMEA 2.3.
    9 mode: Option<PositionMode> = Otherwise(PositionMode::NotValid, letter()), later;
}
