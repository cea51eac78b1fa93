//! Satellites and signals of the masks of MSM.
//!
//! Tables: RTCM 10403.3, the satellite and signal masks (DF394 and DF395 of each constellation).

use insd_base::satellites::{Constellation, SatelliteId, SignalCode};

use Constellation as C;

/// Place in the mask, from 1, and the signal.
type Signals = &'static [(u8, &'static [u8; 2])];

const GPS: Signals = &[
    (2, b"1C"),
    (3, b"1P"),
    (4, b"1W"),
    (8, b"2C"),
    (9, b"2P"),
    (10, b"2W"),
    (15, b"2S"),
    (16, b"2L"),
    (17, b"2X"),
    (22, b"5I"),
    (23, b"5Q"),
    (24, b"5X"),
    (30, b"1S"),
    (31, b"1L"),
    (32, b"1X"),
];
const GLONASS: Signals = &[(2, b"1C"), (3, b"1P"), (8, b"2C"), (9, b"2P")];
const GALILEO: Signals = &[
    (2, b"1C"),
    (3, b"1A"),
    (4, b"1B"),
    (5, b"1X"),
    (6, b"1Z"),
    (8, b"6C"),
    (9, b"6A"),
    (10, b"6B"),
    (11, b"6X"),
    (12, b"6Z"),
    (14, b"7I"),
    (15, b"7Q"),
    (16, b"7X"),
    (18, b"8I"),
    (19, b"8Q"),
    (20, b"8X"),
    (22, b"5I"),
    (23, b"5Q"),
    (24, b"5X"),
];
const SBAS: Signals = &[(2, b"1C"), (22, b"5I"), (23, b"5Q"), (24, b"5X")];
const QZSS: Signals = &[
    (2, b"1C"),
    (9, b"6S"),
    (10, b"6L"),
    (11, b"6X"),
    (15, b"2S"),
    (16, b"2L"),
    (17, b"2X"),
    (22, b"5I"),
    (23, b"5Q"),
    (24, b"5X"),
    (30, b"1S"),
    (31, b"1L"),
    (32, b"1X"),
];
const BEIDOU: Signals = &[
    (2, b"2I"),
    (3, b"2Q"),
    (4, b"2X"),
    (8, b"6I"),
    (9, b"6Q"),
    (10, b"6X"),
    (14, b"7I"),
    (15, b"7Q"),
    (16, b"7X"),
    (22, b"5D"),
    (23, b"5P"),
    (24, b"5X"),
    (25, b"7D"),
    (30, b"1D"),
    (31, b"1P"),
    (32, b"1X"),
];
const NAVIC: Signals = &[(8, b"9A"), (22, b"5A")];

/// Constellations in the order of their messages.
const ORDER: [Constellation; 7] =
    [C::Gps, C::Glonass, C::Galileo, C::Sbas, C::Qzss, C::BeiDou, C::Navic];

/// SBAS counts from PRN 120, which RINEX calls S20.
fn offset(constellation: Constellation) -> u8 {
    if constellation == C::Sbas { 19 } else { 0 }
}

/// The constellation of a message, and its variant, 1 to 7; `None` if it is no MSM.
pub(super) fn message(number: u16) -> Option<(Constellation, u8)> {
    let constellation = ORDER.get(usize::from(number.checked_sub(1070)? / 10))?;
    let variant = (number % 10) as u8;
    (1..=7).contains(&variant).then_some((*constellation, variant))
}

/// The satellite of a place in the mask, from 1.
pub(super) fn satellite(constellation: Constellation, place: u8) -> Option<SatelliteId> {
    SatelliteId::new(constellation, place + offset(constellation))
}

/// The signal of a place in the mask, from 1; `None` where the place is reserved.
pub(super) fn signal(constellation: Constellation, place: u8) -> Option<SignalCode> {
    let (_, [band, attribute]) = signals(constellation).iter().find(|(own, _)| *own == place)?;
    Some(SignalCode::new(band - b'0', *attribute))
}

/// The number of the message of a constellation in a variant, 1 to 7.
pub(super) fn number(constellation: Constellation, variant: u8) -> u16 {
    let at = ORDER.iter().position(|own| *own == constellation).unwrap_or_default();
    1070 + 10 * at as u16 + u16::from(variant)
}

/// The places, from 1, of a satellite and a signal in their masks; `None` where there is none for one of them.
pub(super) fn places(satellite: SatelliteId, code: SignalCode) -> Option<(u8, u8)> {
    let SatelliteId { constellation, number } = satellite;
    let at = number.checked_sub(offset(constellation)).filter(|at| (1..=64).contains(at))?;
    let own = signals(constellation).iter().map(|(place, _)| *place);
    Some((at, own.into_iter().find(|place| signal(constellation, *place) == Some(code))?))
}

fn signals(constellation: Constellation) -> Signals {
    match constellation {
        C::Gps => GPS,
        C::Glonass => GLONASS,
        C::Galileo => GALILEO,
        C::Sbas => SBAS,
        C::Qzss => QZSS,
        C::BeiDou => BEIDOU,
        C::Navic => NAVIC,
    }
}
