//! PHTRO: pitch and roll of Octans, Phins and the units that speak like them.

use super::kinds::Decimal;
use super::table::sentence;

sentence! {
    /// Pitch and roll.
    ///
    /// From the makers' manuals (Octans in Reson SeaBat 8101, SBG Systems `nmeaMessages.md`), and verified
    /// against records of Phins units.
    own Phtro "PHTRO", longest 28: Default;
    /// Pitch, rad, bow up positive: M with the bow up, P with the bow down.
    1 pitch: Option<f64> = Decimal::signed(2, 90.0).degrees().lettered_rounded([b'M', b'P']);
    /// Roll, rad, starboard down positive: B with port down, T with port up.
    3 roll: Option<f64> = Decimal::signed(2, 180.0).degrees().lettered_rounded([b'T', b'B']);
}
