//! PHLIN and PHSPD: how far and how fast the waves move a point of the ship, by Octans, Phins and the
//! units that speak like them.
//!
//! From the makers' manuals (Octans in Reson SeaBat 8101, SBG Systems `nmeaMessages.md`), and the layout
//! verified against records of Phins units. That PHSPD has the signs of PHLIN is taken from their common
//! axes X1, X2, X3 and not verified against a device.

use super::kinds::Decimal;
use super::table::sentence;

const METRES: Decimal = Decimal::signed(3, 999.999);

sentence! {
    /// Surge, sway and heave.
    own Phlin "PHLIN", longest 35: Default;
    /// Surge, m, forward positive.
    1 surge: Option<f64> = METRES;
    /// Sway, m, to **starboard** positive; the sentence has it the other way.
    2 sway: Option<f64> = METRES.reversed();
    /// Heave, m, up positive.
    3 heave: Option<f64> = METRES;
}

sentence! {
    /// Rates of surge, sway and heave.
    own Phspd "PHSPD", longest 35: Default;
    /// Rate of surge, m/s, forward positive.
    1 surge: Option<f64> = METRES;
    /// Rate of sway, m/s, to **starboard** positive; the sentence has it the other way.
    2 sway: Option<f64> = METRES.reversed();
    /// Rate of heave, m/s, up positive.
    3 heave: Option<f64> = METRES;
}
