//! Which signal of a band is used, what its satellite's group delay is, and how much noise it has.

use insd_base::satellites::{BroadcastKind, Measured, SPEED_OF_LIGHT};
use insd_base::{BroadcastRecord, Constellation, SatelliteId, SignalCode, SignalObservation};

use crate::orbit::SatelliteState;

/// Ways of tracking, best first: civil codes and pilots before combined ones before what is got without knowing the code.
pub(crate) const PREFERENCE: &[u8] = b"CQLIXSPWYBDZAMNE";

/// Of the signals of one satellite the best of each band that has a code, in order of the bands.
#[must_use]
pub fn best_of_each_band(signals: &[SignalObservation]) -> Vec<&SignalObservation> {
    let rank = |signal: &SignalObservation| {
        let place = PREFERENCE.iter().position(|letter| *letter == signal.signal.attribute);
        place.unwrap_or(PREFERENCE.len())
    };
    let mut best: Vec<&SignalObservation> = Vec::with_capacity(4);
    for signal in signals.iter().filter(|signal| told_code(signal).is_some()) {
        match best.iter_mut().find(|known| known.signal.band == signal.signal.band) {
            Some(known) if rank(signal) < rank(known) => *known = signal,
            Some(_) => {}
            None => best.push(signal),
        }
    }
    best.sort_by_key(|signal| signal.signal.band);
    best
}

/// Its code, m, if it is one: a receiver whose clock is off by seconds has none that is good for anything.
pub(crate) fn told_code(signal: &SignalObservation) -> Option<f64> {
    signal.code.filter(|code| code.abs() < 1e9)
}

/// Its phase, cycles, if it is one: counted from any origin, but not for years.
pub(crate) fn told_phase(signal: &SignalObservation) -> Option<f64> {
    signal.phase.filter(|phase| phase.abs() < 1e12)
}

/// The band that a constellation's position rests on, and whose receiver's delay is the clock's: the upper L band.
#[must_use]
pub fn first_band(constellation: Constellation) -> u8 {
    match constellation {
        Constellation::BeiDou => 2,
        Constellation::Navic => 5,
        _ => 1,
    }
}

/// By how much the satellite's clock is ahead for this signal, s: to be taken from the broadcast clock. `None` where the record does not tell.
///
/// IS-GPS-200N, 20.3.3.3.3.2; Galileo OS SIS ICD 2.1, 5.1.5; BDS-SIS-ICD-B1I 3.0, 5.2.4.10. Of Galileo's third band from
/// the definition of both delays, `BGD(E1,x) = (tau_E1 - tau_x) / (1 - (f_E1/f_x)^2)`.
#[must_use]
pub fn group_delay(record: &BroadcastRecord, signal: SignalCode) -> Option<f64> {
    let BroadcastRecord::Kepler(record) = record else { return Some(0.0) };
    let constellation = record.satellite.constellation;
    let [first, second] = record.group_delays;
    let ratio = dispersion(record.satellite, signal)?;
    match (constellation, signal.band) {
        (Constellation::Galileo, band) => {
            let (own, own_band, other) = match record.kind {
                BroadcastKind::Fnav => (first, 5, second),
                _ => (second, 7, first),
            };
            match band {
                1 => Some(own),
                band if band == own_band => Some(ratio * own),
                5 | 7 => Some(own - other * (1.0 - ratio)),
                _ => None,
            }
        }
        (Constellation::BeiDou, 2) => Some(first),
        (Constellation::BeiDou, 7) => Some(second),
        (Constellation::BeiDou, 6) => Some(0.0),
        (Constellation::BeiDou, _) => None,
        _ => Some(ratio * first),
    }
}

/// `(f_L1 / f)^2`: how much more the ionosphere delays this signal than one of 1575.42 MHz. `None` where the band is unknown.
#[must_use]
pub fn dispersion(satellite: SatelliteId, signal: SignalCode) -> Option<f64> {
    const L1: f64 = 1575.42e6;
    // GLONASS: the middle of its channels, which is right to 0.5 %
    let ratio = L1 / signal.frequency(satellite.constellation, Some(0))?;
    Some(ratio * ratio)
}

/// What a receiver's measurements are worth at the zenith with a good signal; 1-sigma.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// Code, m.
    pub code: f64,
    /// Phase, m.
    pub phase: f64,
    /// Range rate by the Doppler shift, m/s.
    pub rate: f64,
    /// What reflections add to the code for a minute, m.
    pub multipath: f64,
}

impl Default for Noise {
    /// A receiver for surveying, its multipath included (measured on the receivers of the real sets in docs/satellites.md).
    fn default() -> Self {
        Self { code: 0.4, phase: 0.003, rate: 0.05, multipath: 0.4 }
    }
}

/// The rate at which the range and the receiver's clock grow by a Doppler shift, m/s, with the satellite's own clock taken out.
pub(crate) fn range_rate(
    noise: Noise,
    shift: &SignalObservation,
    satellite: &SatelliteState,
    elevation: f64,
) -> Option<Measured> {
    // satellites make 5 kHz, and a poor oscillator ten times as much
    let doppler = shift.doppler.filter(|doppler| doppler.abs() < 1e6)?;
    Some(Measured {
        value: -shift.wavelength()? * doppler + SPEED_OF_LIGHT * satellite.clock_drift,
        variance: noise.rate.powi(2) * inflation(elevation, shift.cn0),
    })
}

/// By how much the variance at the zenith is multiplied: `(1 + 1/sin^2 E) / 2`, and tenfold for each 10 dB that the signal is below 42 dB Hz.
#[must_use]
pub fn inflation(elevation: f64, cn0: Option<f64>) -> f64 {
    const GOOD: f64 = 42.0;
    let sin = elevation.sin().max(0.05);
    let low = (1.0 + 1.0 / (sin * sin)) / 2.0;
    let told = cn0.filter(|cn0| cn0.is_finite());
    let weak = told.map_or(0.0, |cn0| ((GOOD - cn0) / 10.0).clamp(0.0, GOOD / 10.0));
    low * 10_f64.powf(weak)
}

/// Variance of a receiver's phase, m^2: `phase^2 (1 + 1/sin^2 E)`, tenfold for each 10 dB that C/N0 is below `weak`, dB Hz, up to a thousandfold.
pub(crate) fn phase_variance((phase, weak): (f64, f64), elevation: f64, cn0: Option<f64>) -> f64 {
    let told = cn0.filter(|cn0| cn0.is_finite());
    let poor = told.map_or(0.0, |cn0| ((weak - cn0) / 10.0).clamp(0.0, 3.0));
    2.0 * phase.powi(2) * inflation(elevation, None) * 10_f64.powf(poor)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn observed(signal: &str, code: Option<f64>) -> SignalObservation {
        let [band, attribute] = signal.as_bytes() else { panic!("two characters") };
        let satellite = "G07".parse().unwrap();
        let signal = SignalCode::new(band - b'0', *attribute);
        SignalObservation { code, ..SignalObservation::unknown(satellite, signal) }
    }

    #[test]
    fn the_best_signal_of_each_band_is_used_and_one_without_a_code_is_not() {
        let signals = [
            observed("2W", Some(1.0)),
            observed("1W", Some(2.0)),
            observed("1C", Some(3.0)),
            observed("2L", None),
            observed("5Q", Some(4.0)),
        ];
        let codes: Vec<_> = best_of_each_band(&signals).iter().map(|s| s.code.unwrap()).collect();
        assert_eq!(codes, [3.0, 1.0, 4.0]);
    }

    #[test]
    fn a_weak_or_low_signal_is_worth_less() {
        assert!((inflation(std::f64::consts::FRAC_PI_2, Some(50.0)) - 1.0).abs() < 1e-12);
        assert!((inflation(std::f64::consts::FRAC_PI_2, Some(32.0)) - 10.0).abs() < 1e-12);
        assert!(inflation(0.2, None) > 10.0);
    }
}
