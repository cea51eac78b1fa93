//! What a receiver measures at one instant of its clock.

use serde::{Deserialize, Serialize};

use super::signal::{SatelliteId, SignalCode};
use crate::utc::GpsTime;

/// What a receiver measures of one signal of one satellite; whatever is not there is `None`.
///
/// Signs as in RINEX: code and phase grow with the range, the Doppler shift is positive when the satellite approaches.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SignalObservation {
    /// The satellite.
    pub satellite: SatelliteId,
    /// The signal.
    pub signal: SignalCode,
    /// GLONASS: its frequency channel, -7 to 6, where the receiver tells it.
    pub channel: Option<i8>,
    /// Pseudorange, m.
    pub code: Option<f64>,
    /// Carrier phase, cycles, of any origin.
    pub phase: Option<f64>,
    /// Doppler shift, Hz.
    pub doppler: Option<f64>,
    /// Carrier to noise density, dB Hz.
    pub cn0: Option<f64>,
    /// How long the phase has been tracked without a loss of lock, s, where the receiver tells it; some tell no more than a lower bound.
    pub lock: Option<f64>,
    /// The phase may be wrong by half a cycle.
    pub half_cycle: bool,
    /// The receiver says that lock was lost since its epoch before.
    pub slip: bool,
}

impl SignalObservation {
    /// A signal of which nothing is known yet.
    #[must_use]
    pub fn unknown(satellite: SatelliteId, signal: SignalCode) -> Self {
        Self {
            satellite,
            signal,
            channel: None,
            code: None,
            phase: None,
            doppler: None,
            cn0: None,
            lock: None,
            half_cycle: false,
            slip: false,
        }
    }

    /// Wavelength of its carrier, m; `None` where the band is unknown or, of GLONASS, the channel.
    #[must_use]
    pub fn wavelength(&self) -> Option<f64> {
        self.signal.wavelength(self.satellite.constellation, self.channel)
    }
}

/// All signals that one receiver sampled together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SatelliteEpoch {
    /// Time of reception by the receiver's own clock: never put right, as ranges and phases belong to it.
    pub tag: GpsTime,
    /// The signals, satellite by satellite.
    pub signals: Vec<SignalObservation>,
    /// GPS - UTC, s, where the receiver knows it.
    pub leap_seconds: Option<i8>,
    /// The receiver says that its clock was set since its epoch before.
    pub clock_reset: bool,
}
