//! PFEC,GPatt: attitude of Furuno and JRC satellite compasses.

use super::kinds::{Decimal, Turn};
use super::line::NmeaLine;
use super::table::sentence;

const TILT: Decimal = Decimal::signed(1, 90.0).degrees().width(2).with_sign();

sentence! {
    /// Attitude.
    ///
    /// From the makers' manuals (Furuno SC-120; Simrad SY50, which listens to it), and the layout verified
    /// against published sentences. No manual that could be read states the signs: pitch is taken as
    /// positive with the bow up and roll as positive with starboard down, as in the makers' displays; not
    /// verified against a device.
    own PfecAttitude "PFEC" "GPatt", longest 34: Default;
    /// Heading, rad, clockwise from true north.
    2 heading: Option<f64> = Turn::of(1).full_width();
    /// Pitch, rad, bow up positive.
    3 pitch: Option<f64> = TILT;
    /// Roll, rad, starboard down positive; beyond 90 deg either way it is unknown.
    4 roll: Option<f64> = TILT;
}

impl PfecAttitude {
    /// Writes the sentence of version 1.5, which has no checksum.
    #[must_use]
    pub fn write_old(&self) -> NmeaLine {
        self.write().without_checksum()
    }
}
