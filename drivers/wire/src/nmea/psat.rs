//! PSAT,HPR: heading, pitch and roll of Hemisphere (CSI, Satloc) satellite compasses.

use super::civil::TimeOfDay;
use super::kinds::{Clock, Decimal, Lettered, Needed, Turn, letter};
use super::table::sentence;

const TILT: Decimal = Decimal::signed(3, 90.0).degrees();

/// By what a heading was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PsatSource {
    /// N: by satellites.
    Satellites,
    /// G: by the gyro, which holds on while satellites are hidden.
    Gyro,
}

sentence! {
    /// Attitude of a satellite compass.
    ///
    /// From the makers' manuals (CSI Wireless DGPS MAX programming manual, 2.14), the layout verified against lines of a device on board
    /// a research ship. Of pitch and roll the compass tells the one along which its antennas lie. No manual that could be read states the
    /// signs: pitch is taken as positive with the bow up and roll as positive with starboard down.
    own PsatHpr "PSAT" "HPR", longest 49;
    /// UTC.
    2 time: Option<TimeOfDay> = Clock(2);
    /// Heading, rad, clockwise from true north.
    3 heading: Option<f64> = Turn::of(3);
    /// Pitch, rad, bow up positive.
    4 pitch: Option<f64> = TILT, lenient;
    /// Roll, rad, starboard down positive; beyond 90 deg either way it is unknown.
    5 roll: Option<f64> = TILT, lenient;
    /// By what the heading was found.
    6 source: PsatSource = Needed(letter());
}

impl Lettered for PsatSource {
    fn to_letter(self) -> u8 {
        match self {
            PsatSource::Satellites => b'N',
            PsatSource::Gyro => b'G',
        }
    }

    fn of_letter(letter: u8) -> Option<Self> {
        match letter {
            b'N' => Some(PsatSource::Satellites),
            b'G' => Some(PsatSource::Gyro),
            _ => None,
        }
    }
}
