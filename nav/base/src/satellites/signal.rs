//! Constellations, satellites and signals, named as RINEX names them.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// Speed of light in vacuum, m/s (BIPM, SI brochure).
pub const SPEED_OF_LIGHT: f64 = 299_792_458.0;

const MEGA: f64 = 1e6;

/// A system of navigation satellites.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Constellation {
    /// GPS, United States.
    Gps,
    /// GLONASS, Russia: frequencies differ from satellite to satellite.
    Glonass,
    /// Galileo, European Union.
    Galileo,
    /// BeiDou, China.
    BeiDou,
    /// QZSS, Japan: time and signals of GPS.
    Qzss,
    /// NavIC, India.
    Navic,
    /// Satellites of augmentation systems.
    Sbas,
}

impl fmt::Display for Constellation {
    /// What it is called.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Gps => "GPS",
            Self::Glonass => "GLONASS",
            Self::Galileo => "Galileo",
            Self::BeiDou => "BeiDou",
            Self::Qzss => "QZSS",
            Self::Navic => "NavIC",
            Self::Sbas => "SBAS",
        })
    }
}

impl Constellation {
    /// All of them.
    pub const ALL: [Constellation; 7] = [
        Self::Gps,
        Self::Glonass,
        Self::Galileo,
        Self::BeiDou,
        Self::Qzss,
        Self::Navic,
        Self::Sbas,
    ];

    /// The letter of RINEX 3 (table 1 of its definition).
    #[must_use]
    pub fn letter(self) -> char {
        match self {
            Self::Gps => 'G',
            Self::Glonass => 'R',
            Self::Galileo => 'E',
            Self::BeiDou => 'C',
            Self::Qzss => 'J',
            Self::Navic => 'I',
            Self::Sbas => 'S',
        }
    }

    /// The constellation of a letter of RINEX 3.
    #[must_use]
    pub fn from_letter(letter: char) -> Option<Self> {
        Self::ALL.into_iter().find(|constellation| constellation.letter() == letter)
    }
}

/// A satellite: its constellation and its number there, as in RINEX (`G07`, `J02`, `S37` for PRN 137).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct SatelliteId {
    /// Its constellation.
    pub constellation: Constellation,
    /// Its number, 1 to 99.
    pub number: u8,
}

impl SatelliteId {
    /// A satellite of a constellation; `None` unless its number is 1 to 99.
    #[must_use]
    pub fn new(constellation: Constellation, number: u8) -> Option<Self> {
        (1..=99).contains(&number).then_some(Self { constellation, number })
    }

    /// Whether it stands still over the equator: a BeiDou satellite in geostationary orbit (C01 to C05 and
    /// from C59 up; BDS-SIS-ICD-B1I 3.0, table 4-1).
    #[must_use]
    pub fn is_geostationary(self) -> bool {
        self.constellation == Constellation::BeiDou && (self.number <= 5 || self.number >= 59)
    }
}

impl fmt::Display for SatelliteId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{:02}", self.constellation.letter(), self.number)
    }
}

impl FromStr for SatelliteId {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let expected = || format!("{text:?}: expected a satellite such as G07, E11 or C30");
        let constellation =
            text.chars().next().and_then(Constellation::from_letter).ok_or_else(expected)?;
        // the letter is ASCII, so that the cut is at a boundary
        let number = text[1..].trim().parse().map_err(|_| expected())?;
        Self::new(constellation, number).ok_or_else(expected)
    }
}

/// A signal: its band and its way of tracking, the two characters of RINEX 3 after the kind of observation (`1C`, `5Q`).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct SignalCode {
    /// Band, 1 to 9.
    pub band: u8,
    /// Channel or way of tracking, an ASCII letter.
    pub attribute: u8,
}

impl SignalCode {
    /// The signal of a band and a letter.
    #[must_use]
    pub const fn new(band: u8, attribute: u8) -> Self {
        Self { band, attribute }
    }

    /// Carrier frequency, Hz (RINEX 4.02, tables 9 to 15); `None` where the constellation has no such band, or for GLONASS' first two
    /// bands without the satellite's channel.
    #[must_use]
    pub fn frequency(self, constellation: Constellation, channel: Option<i8>) -> Option<f64> {
        use Constellation as C;
        let megahertz = match (constellation, self.band) {
            (C::Gps | C::Qzss | C::Galileo | C::Sbas | C::BeiDou | C::Navic, 1) => 1575.42,
            (C::Gps | C::Qzss, 2) => 1227.60,
            (C::BeiDou, 2) => 1561.098,
            (C::Gps | C::Qzss | C::Galileo | C::Sbas | C::BeiDou | C::Navic, 5) => 1176.45,
            (C::Galileo | C::Qzss, 6) => 1278.75,
            (C::BeiDou, 6) => 1268.52,
            (C::Galileo | C::BeiDou, 7) => 1207.14,
            (C::Galileo | C::BeiDou, 8) => 1191.795,
            (C::Navic, 9) => 2492.028,
            (C::Glonass, 1) => 1602.0 + f64::from(channel?) * 0.5625,
            (C::Glonass, 2) => 1246.0 + f64::from(channel?) * 0.4375,
            (C::Glonass, 3) => 1202.025,
            (C::Glonass, 4) => 1600.995,
            (C::Glonass, 6) => 1248.06,
            _ => return None,
        };
        Some(megahertz * MEGA)
    }

    /// Wavelength, m; `None` as for [`Self::frequency`].
    #[must_use]
    pub fn wavelength(self, constellation: Constellation, channel: Option<i8>) -> Option<f64> {
        self.frequency(constellation, channel).map(|frequency| SPEED_OF_LIGHT / frequency)
    }
}

impl SignalCode {
    /// What the constellation calls the band (RINEX 4.02, tables 9 to 15); `None` where it has no such band.
    #[must_use]
    pub fn band_name(self, constellation: Constellation) -> Option<&'static str> {
        use Constellation as C;
        Some(match (constellation, self.band) {
            (C::Gps | C::Qzss | C::Sbas | C::Navic, 1) => "L1",
            (C::Gps | C::Qzss, 2) => "L2",
            (C::Gps | C::Qzss | C::Sbas | C::Navic, 5) => "L5",
            (C::Qzss, 6) => "L6",
            (C::Navic, 9) => "S",
            (C::Galileo, 1) => "E1",
            (C::Galileo, 5) => "E5a",
            (C::Galileo, 6) => "E6",
            (C::Galileo, 7) => "E5b",
            (C::Galileo, 8) => "E5",
            (C::BeiDou, 1) => "B1C",
            (C::BeiDou, 2) => "B1I",
            (C::BeiDou, 5) => "B2a",
            (C::BeiDou, 6) => "B3I",
            (C::BeiDou, 7) => "B2b",
            (C::BeiDou, 8) => "B2",
            (C::Glonass, 1) => "G1",
            (C::Glonass, 2) => "G2",
            (C::Glonass, 3) => "G3",
            (C::Glonass, 4) => "G1a",
            (C::Glonass, 6) => "G2a",
            _ => return None,
        })
    }
}

impl fmt::Display for SignalCode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.band, char::from(self.attribute))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_satellite_comes_back_from_its_name() {
        for name in ["G07", "R24", "E11", "C60", "J02", "I09", "S37"] {
            assert_eq!(name.parse::<SatelliteId>().unwrap().to_string(), name);
        }
        assert_eq!("G 7".parse::<SatelliteId>().unwrap().to_string(), "G07");
    }

    #[test]
    fn what_is_no_satellite_says_what_was_expected() {
        for name in ["", "X01", "G", "G00", "G100", "é1"] {
            let error = name.parse::<SatelliteId>().unwrap_err();
            assert!(error.contains("expected a satellite"), "{error}");
        }
    }

    #[test]
    fn a_band_that_has_a_name_has_a_frequency_and_the_other_way_round() {
        for constellation in Constellation::ALL {
            for band in 0..=10 {
                let signal = SignalCode::new(band, b'C');
                let is_there = signal.frequency(constellation, Some(0)).is_some();
                let named = signal.band_name(constellation).is_some();
                assert_eq!(named, is_there, "{constellation} {band}");
            }
        }
    }

    #[test]
    fn frequencies_of_glonass_need_the_channel_and_others_do_not() {
        let first = SignalCode::new(1, b'C');
        assert_eq!(first.frequency(Constellation::Glonass, None), None);
        assert_eq!(first.frequency(Constellation::Glonass, Some(-7)), Some(1_598_062_500.0));
        assert_eq!(first.frequency(Constellation::Gps, None), Some(1_575_420_000.0));
        assert_eq!(SignalCode::new(9, b'A').frequency(Constellation::Gps, None), None);
    }
}
