//! HDG: heading of a magnetic compass with deviation and variation.

use insd_base::units::wrap_two_pi;

use super::kinds::{Decimal, Turn};
use super::table::sentence;

const CORRECTION: Decimal = Decimal::signed(1, 180.0).degrees().lettered([b'E', b'W']);

sentence! {
    /// Heading of a magnetic compass.
    ///
    /// East is added to the reading, west subtracted: reading + deviation is the magnetic heading, and with
    /// the variation the true one. An empty variation is unknown, not zero. A bad deviation is a fault:
    /// without it the reading is no heading.
    approved Hdg "HDG", longest 34: Default;
    /// Reading of the sensor, rad, clockwise from compass north, uncorrected.
    1 reading: Option<f64> = Turn::of(2);
    /// Deviation, rad, east positive.
    2 deviation: Option<f64> = CORRECTION;
    /// Variation, rad, east positive.
    4 variation: Option<f64> = CORRECTION, lenient;
}

impl Hdg {
    /// Heading, rad, clockwise from true north, if the variation is known. A deviation that is not
    /// told is taken as corrected by the compass.
    #[must_use]
    pub fn true_heading(&self) -> Option<f64> {
        let corrections = self.deviation.unwrap_or(0.0) + self.variation?;
        self.reading.map(|reading| wrap_two_pi(reading + corrections))
    }
}
