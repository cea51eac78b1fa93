//! The satellites, and what becomes of each.

use serde::{Deserialize, Serialize};

use super::aids::Cause;

/// What is known of single satellites.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SkyState {
    /// A receiver tells what it measures of each.
    Raw,
    /// A receiver is heard, and sends fixes only.
    FixesOnly,
    /// A receiver told what it measures of each, and does so no more.
    Silent,
    /// No receiver is heard.
    NoReceiver,
    /// Nothing is known, or a word that this version does not know.
    #[default]
    #[serde(other)]
    Unknown,
}

/// The sky as a receiver hears it.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ShownSky {
    /// What is known of single satellites.
    pub state: SkyState,
    /// Time of validity, on the ship's time line, s.
    pub valid_at_s: Option<f64>,
    /// How many of them the navigator uses.
    pub used: Option<u32>,
    /// The satellites of the last epoch, GPS first; empty unless `state` is `raw`.
    pub satellites: Vec<ShownSatellite>,
    /// Satellites that gave no range, by reason: one is counted in each epoch.
    pub refused: Vec<Cause>,
    /// What became of the epochs against a base, by outcome: `fixed`, or why there was no place; `withdrawn`, `refuted` and `agrees`
    /// count turns. Empty without a base.
    pub against_base: Vec<Cause>,
}

/// What becomes of a satellite.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SatelliteFate {
    /// Code and phase are used.
    Used,
    /// Its code is used; it has no phase.
    CodeOnly,
    /// It contradicts the others, and is left out.
    LeftOut,
    /// As many satellites as there is room for stand higher.
    Crowded,
    /// It could be used, and the navigator does not use ranges yet.
    Waiting,
    /// It cannot be used, for the reason told.
    Refused,
    /// A word that this version does not know.
    #[default]
    #[serde(other)]
    Unknown,
}

impl SatelliteFate {
    /// Whether the navigator uses it.
    #[must_use]
    pub fn is_used(self) -> bool {
        matches!(self, SatelliteFate::Used | SatelliteFate::CodeOnly)
    }
}

/// One satellite.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ShownSatellite {
    /// Its name as in RINEX: `G07`, `E11`, `C30`, `J02`.
    pub name: String,
    /// Its system: `GPS`, `GLONASS`, `Galileo`, `BeiDou`, `QZSS`, `NavIC`, `SBAS`.
    pub system: String,
    /// Where it stands, from true north, deg, 0 to 360, if its orbit is known.
    pub azimuth_deg: Option<f64>,
    /// Above the horizon, deg.
    pub elevation_deg: Option<f64>,
    /// Its signals, one for each band.
    pub signals: Vec<ShownSignal>,
    /// What becomes of it.
    pub fate: SatelliteFate,
    /// For how long it has been left out, s.
    pub left_out_for_s: Option<f64>,
    /// Why it is not used: `contradicts`, `crowded`, `waiting`, `low`, `no_code`, `no_orbit`, `stale_orbit`, `unhealthy`,
    /// `implausible_orbit`, `no_place`, `no_delay`; `None` where it is used.
    pub reason: Option<String>,
    /// The same in words, and what else there is to say of it.
    pub text: Option<String>,
}

/// A signal of a satellite.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ShownSignal {
    /// The band as its system calls it: `L1`, `E5a`, `B1I`.
    pub band: String,
    /// The signal as RINEX calls it: `1C`, `5Q`.
    pub code: String,
    /// Carrier to noise density, dB Hz.
    pub cn0_db_hz: Option<f64>,
}

impl ShownSatellite {
    /// The strongest of its signals, dB Hz.
    #[must_use]
    pub fn strongest(&self) -> Option<f64> {
        self.signals.iter().filter_map(|signal| signal.cn0_db_hz).reduce(f64::max)
    }
}
