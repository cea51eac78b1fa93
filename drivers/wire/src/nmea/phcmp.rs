//! PHCMP: what an Octans, a Phins or a unit that speaks like them corrects its heading with.

use super::kinds::{Decimal, Latitude};
use super::table::sentence;

sentence! {
    /// Latitude and speed.
    ///
    /// From the maker's manual, and verified against records of Phins units. The manual of the Reson SeaBat
    /// 8101 prints one field more before the `N`; no record has it.
    own Phcmp "PHCMP", longest 29: Default;
    /// Geodetic latitude, rad, north positive, to 20 m.
    1 latitude: Option<f64> = Latitude(2);
    /// Horizontal speed, m/s, never negative.
    3 speed: Option<f64> = Decimal::magnitude(2, 999.994).knots().with_if_known(b'N');
}
