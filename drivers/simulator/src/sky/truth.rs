//! What was done to the raw GNSS of a voyage: for those who judge, never for a navigator.

use insd_base::satellites::SatelliteId;
use serde::{Serialize, Serializer};

use crate::camera::FootageTruth;

fn name<S: Serializer>(satellite: &SatelliteId, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(satellite)
}

fn names<S: Serializer>(
    satellites: &Option<Vec<SatelliteId>>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(satellites.iter().flatten().map(SatelliteId::to_string))
}

/// A span of time that is judged apart; t0 <= t < t1, s.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct JudgedSegment {
    /// Beginning, s.
    pub t0_s: f64,
    /// End, excluded, s.
    pub t1_s: f64,
    /// What it is called.
    pub label: String,
    /// The satellites that are left in it; all where absent.
    #[serde(serialize_with = "names", skip_serializing_if = "Option::is_none")]
    pub satellites: Option<Vec<SatelliteId>>,
}

/// What one satellite did that its records do not say; t0 <= t < t1, s.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct InjectedFault {
    /// The satellite.
    #[serde(serialize_with = "name")]
    pub satellite: SatelliteId,
    /// Key of its size: `ramp_mps`, `jump_m`, `clock_jump_m` or `stale_mps2`.
    pub kind: String,
    /// Beginning, s.
    pub t0_s: f64,
    /// End, excluded, s.
    pub t1_s: f64,
    /// Its size, in the unit of its key.
    pub size: f64,
}

fn antenna<S: Serializer>(number: &usize, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(&antenna_name(*number))
}

fn antennas<S: Serializer>(pair: &Option<[usize; 2]>, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(pair.iter().flatten().map(|number| antenna_name(*number)))
}

/// What an antenna is called by its number; 0 is the base station.
fn antenna_name(number: usize) -> String {
    if number == 0 { "base".to_owned() } else { format!("a{number}") }
}

/// What was wrong with the installation of one antenna; t0 <= t < t1, s.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct InjectedAntennaFault {
    /// Number of the antenna, from 1.
    #[serde(serialize_with = "antenna")]
    pub antenna: usize,
    /// Key of its size: `weaker_db` or `own_clock_mps`; `broken` has none.
    pub kind: String,
    /// Beginning, s.
    pub t0_s: f64,
    /// End, excluded, s.
    pub t1_s: f64,
    /// Its size, in the unit of its key.
    pub size: f64,
}

/// A spoofer's pull; t0 <= t < t1, s.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct InjectedSpoof {
    /// Beginning, s.
    pub t0_s: f64,
    /// End, excluded, s.
    pub t1_s: f64,
    /// Its speed, m/s.
    pub speed_mps: f64,
    /// Where to, from true north, degrees.
    pub direction_deg: f64,
    /// By how much all ranges are longer from its first moment on, m.
    pub clock_m: f64,
}

/// A cycle slip; written as a list of its fields.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(into = "(f64, String, String, i32, bool)")]
pub struct InjectedSlip {
    /// First epoch with it, by the receiver's tag, s.
    pub t_s: f64,
    /// Number of the antenna, from 1; 0 is the base station.
    pub antenna: usize,
    /// The satellite.
    pub satellite: SatelliteId,
    /// Cycles that the phase of its first signal has more from then on.
    pub cycles: i32,
    /// Whether the receiver told it.
    pub told: bool,
}

impl From<InjectedSlip> for (f64, String, String, i32, bool) {
    fn from(slip: InjectedSlip) -> Self {
        (slip.t_s, antenna_name(slip.antenna), slip.satellite.to_string(), slip.cycles, slip.told)
    }
}

/// All of it, in the shape of a voyage's `truth.json`.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct RawTruth {
    /// Name of the scenario.
    pub scenario: String,
    /// Spans of time that are judged apart.
    pub segments: Vec<JudgedSegment>,
    /// Faults of satellites.
    pub satellite_faults: Vec<InjectedFault>,
    /// Spoofers.
    pub spoofs: Vec<InjectedSpoof>,
    /// Cycle slips, antenna by antenna.
    pub slips: Vec<InjectedSlip>,
    /// Faults of the installation of single antennas.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub antenna_faults: Vec<InjectedAntennaFault>,
    /// Two antennas of which each is told to be where the other is.
    #[serde(serialize_with = "antennas", skip_serializing_if = "Option::is_none")]
    pub swapped: Option<[usize; 2]>,
    /// What was done to the camera, where there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub camera: Option<FootageTruth>,
}
