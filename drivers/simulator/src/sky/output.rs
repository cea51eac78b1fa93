//! The raw GNSS of a voyage as it is handed out.

use insd_base::Geodetic;
use insd_base::satellites::{BroadcastRecord, IonosphereModel, SatelliteEpoch};
use serde::Serialize;

use super::installation::told_antennas;
use super::truth::RawTruth;
use crate::scenario::Raw;

/// What a voyage says of its receivers: the `[raw]` table of `voyage.toml`, whose keys and units these are.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RawSpec {
    /// Rate of epochs.
    pub rate_hz: f64,
    /// Antennas from the IMU, body axes, as they are told.
    pub antennas_m: Vec<[f64; 3]>,
    /// Numbers, from 1, of the antennas whose receivers share one oscillator.
    pub common_clock: Vec<usize>,
    /// White noise of the code at the zenith, 1-sigma; times sqrt((1 + 1/sin^2 el)/2), as the next four.
    pub code_std_m: f64,
    /// Of the phase.
    pub phase_std_m: f64,
    /// Of the Doppler shift.
    pub doppler_std_mps: f64,
    /// Multipath of the code, Gauss-Markov, 1-sigma.
    pub multipath_code_std_m: f64,
    /// Of the phase.
    pub multipath_phase_std_m: f64,
    /// Its time constant.
    pub multipath_time_constant_s: f64,
    /// Random walk of a receiver's clock.
    pub clock_bias_walk_m_sqrt_s: f64,
    /// Random walk of its drift.
    pub clock_drift_walk_mps_sqrt_s: f64,
    /// Random walk of the phase delay of each antenna's line.
    pub line_bias_walk_m_sqrt_s: f64,
}

impl RawSpec {
    /// What a scenario says of them.
    pub(crate) fn of(raw: &Raw) -> Self {
        RawSpec {
            rate_hz: raw.rate_hz,
            antennas_m: told_antennas(raw),
            common_clock: raw.common_clock.clone(),
            code_std_m: raw.code_std_m,
            phase_std_m: raw.phase_std_m,
            doppler_std_mps: raw.doppler_std_mps,
            multipath_code_std_m: raw.multipath_code_std_m,
            multipath_phase_std_m: raw.multipath_phase_std_m,
            multipath_time_constant_s: raw.multipath_time_constant_s,
            clock_bias_walk_m_sqrt_s: raw.clock_bias_walk_m_sqrt_s,
            clock_drift_walk_mps_sqrt_s: raw.clock_drift_walk_mps_sqrt_s,
            line_bias_walk_m_sqrt_s: raw.line_bias_walk_m_sqrt_s,
        }
    }
}

/// A receiver on land.
#[derive(Clone, Debug, PartialEq)]
pub struct RawBaseStation {
    /// Its antenna, as it says: not always where it is.
    pub position: Geodetic,
    /// Somebody on board has it surveyed there.
    pub is_surveyed: bool,
    /// What it measures.
    pub epochs: Vec<SatelliteEpoch>,
}

/// The raw GNSS of a voyage.
#[derive(Clone, Debug, PartialEq)]
pub struct RawGnss {
    /// What is known of the receivers.
    pub spec: RawSpec,
    /// What each antenna's receiver measures, antenna by antenna.
    pub antennas: Vec<Vec<SatelliteEpoch>>,
    /// The base station, if there is one.
    pub base: Option<RawBaseStation>,
    /// What the satellites broadcast, satellite by satellite.
    pub broadcast: Vec<BroadcastRecord>,
    /// The broadcast model of the ionosphere.
    pub ionosphere: IonosphereModel,
    /// What was done to it.
    pub truth: RawTruth,
}
