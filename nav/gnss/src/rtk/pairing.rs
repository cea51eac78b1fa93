//! Which signal of the rover goes with which of the base.

use insd_base::{Constellation, SatelliteEpoch, SatelliteId, SignalCode, SignalObservation};

use crate::signals::{PREFERENCE, told_code, told_phase};

/// A signal of one satellite as rover and base track it. Its ambiguity is one as long as neither loses it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SignalPair {
    /// The satellite.
    pub satellite: SatelliteId,
    /// As the rover tracks it.
    pub rover: SignalCode,
    /// As the base does.
    pub base: SignalCode,
}

/// Those that may be differenced with one another: receivers add the same to all of them, up to whole cycles.
///
/// What one make adds to a phase and another does not, as the quarter cycles of RINEX 3.05 (table A23) or the half cycle between pilots and combined signals, is
/// the same for every satellite of a constellation and a pair of signals, and is gone in their differences. Geostationary satellites of BeiDou have a
/// group of their own: makes of receivers differ by half a cycle on their other messages (Nadarajah et al., "Effects of inter-satellite-type
/// biases", 2013).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Group {
    constellation: Constellation,
    is_geostationary: bool,
    rover: SignalCode,
    base: SignalCode,
}

impl SignalPair {
    pub(super) fn group(&self) -> Group {
        Group {
            constellation: self.satellite.constellation,
            is_geostationary: self.satellite.is_geostationary(),
            rover: self.rover,
            base: self.base,
        }
    }
}

/// The pairs of all satellites that both hear: of each band the one that is most alike, with phases before codes alone. GLONASS is left out:
/// its wavelengths differ, and so do the delays of receivers from channel to channel.
pub(crate) fn pairs<'a>(
    rover: &'a SatelliteEpoch,
    base: &'a SatelliteEpoch,
) -> Vec<(SignalPair, &'a SignalObservation, &'a SignalObservation)> {
    let mut pairs: Vec<(SignalPair, &SignalObservation, &SignalObservation)> = Vec::new();
    for own in rover.signals.iter().filter(|own| is_of_use(own)) {
        let same = |other: &&SignalObservation| {
            other.satellite == own.satellite && other.signal.band == own.signal.band
        };
        for other in base.signals.iter().filter(same).filter(|other| is_of_use(other)) {
            let pair =
                SignalPair { satellite: own.satellite, rover: own.signal, base: other.signal };
            let known = pairs.iter_mut().find(|(known, ..)| {
                known.satellite == own.satellite && known.rover.band == own.signal.band
            });
            match known {
                Some(known) if rank(own, other) < rank(known.1, known.2) => {
                    *known = (pair, own, other);
                }
                Some(_) => {}
                None => pairs.push((pair, own, other)),
            }
        }
    }
    pairs.sort_by_key(|(pair, ..)| *pair);
    pairs
}

fn is_of_use(signal: &SignalObservation) -> bool {
    signal.satellite.constellation != Constellation::Glonass && told_code(signal).is_some()
}

/// Lower is better.
fn rank(rover: &SignalObservation, base: &SignalObservation) -> (bool, u8, usize) {
    let constellation = rover.satellite.constellation;
    let (own, other) = (rover.signal, base.signal);
    let kinship = if own == other {
        0
    } else if family(constellation, own) == family(constellation, other) {
        1
    } else {
        2
    };
    let has_phases = told_phase(rover).is_some() && told_phase(base).is_some();
    let place = PREFERENCE.iter().position(|letter| *letter == own.attribute);
    (!has_phases, kinship, place.unwrap_or(PREFERENCE.len()))
}

/// Signals of one family are parts of one modulation: data, pilot, or both.
fn family(constellation: Constellation, signal: SignalCode) -> u8 {
    use Constellation as C;
    match (constellation, signal.band, signal.attribute) {
        (C::Gps | C::Qzss, 1 | 2, b'S' | b'L' | b'X') => 1,
        (C::Gps | C::Qzss, 1 | 2, b'D' | b'P' | b'W' | b'Y' | b'M' | b'N') => 2,
        (C::Gps | C::Qzss, 1 | 2, _) => 0,
        (C::Galileo, 1 | 6, b'A' | b'Z') => 1,
        (C::BeiDou, 6 | 7, b'D' | b'P' | b'Z') => 1,
        _ => 0,
    }
}

#[cfg(test)]
mod tests {
    use insd_base::GpsTime;

    use super::*;

    fn epoch(signals: &[(&str, &str, bool)]) -> SatelliteEpoch {
        let signals = signals.iter().map(|(satellite, signal, has_phase)| {
            let bytes = signal.as_bytes();
            let signal = SignalCode::new(bytes[0] - b'0', bytes[1]);
            let unknown = SignalObservation::unknown(satellite.parse().unwrap(), signal);
            SignalObservation { code: Some(2e7), phase: has_phase.then_some(1e8), ..unknown }
        });
        let signals = signals.collect();
        let tag = GpsTime::from_week(2300, 0);
        SatelliteEpoch { tag, signals, leap_seconds: None, clock_reset: false }
    }

    fn paired(rover: &[(&str, &str, bool)], base: &[(&str, &str, bool)]) -> Vec<String> {
        let (rover, base) = (epoch(rover), epoch(base));
        let told = |(pair, ..): &(SignalPair, &SignalObservation, &SignalObservation)| {
            format!("{} {} {}", pair.satellite, pair.rover, pair.base)
        };
        pairs(&rover, &base).iter().map(told).collect()
    }

    #[test]
    fn the_same_signal_goes_before_its_kin_and_kin_before_another_signal_of_the_band() {
        let rover = [("G05", "2W", true), ("G05", "2L", true)];
        assert_eq!(paired(&rover, &[("G05", "2W", true), ("G05", "2X", true)]), ["G05 2W 2W"]);
        assert_eq!(paired(&rover, &[("G05", "2X", true)]), ["G05 2L 2X"]);
        assert_eq!(paired(&rover[..1], &[("G05", "2X", true)]), ["G05 2W 2X"]);
        assert_eq!(paired(&[("E07", "1C", true)], &[("E07", "1X", true)]), ["E07 1C 1X"]);
    }

    #[test]
    fn a_pair_without_phases_gives_way_and_glonass_has_none() {
        let rover = [("G05", "2W", false), ("G05", "2L", true), ("R05", "1C", true)];
        let base = [("G05", "2W", true), ("G05", "2X", true), ("R05", "1C", true)];
        assert_eq!(paired(&rover, &base), ["G05 2L 2X"]);
    }

    #[test]
    fn geostationary_satellites_are_not_differenced_with_others() {
        let b1i = SignalCode::new(2, b'I');
        let group = |name: &str| {
            SignalPair { satellite: name.parse().unwrap(), rover: b1i, base: b1i }.group()
        };
        assert_ne!(group("C03"), group("C21"));
        assert_eq!(group("C21"), group("C09"));
    }
}
