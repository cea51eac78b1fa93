//! The sky as a receiver hears it, and what becomes of each satellite: for those who look on.

use super::refusal::RangeRefusal;
use super::signal::{SatelliteId, SignalCode};
use crate::time::Time;

/// Where a satellite stands as seen from an antenna, rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LookAngles {
    /// Clockwise from north.
    pub azimuth: f64,
    /// Above the horizon.
    pub elevation: f64,
}

/// How strong a signal is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SignalStrength {
    /// The signal.
    pub signal: SignalCode,
    /// Carrier to noise density, dB Hz, where the receiver tells it.
    pub cn0: Option<f64>,
}

/// What becomes of a satellite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SatelliteUse {
    /// Its code and its phase are used.
    Phase,
    /// Its code is used; it has no phase.
    CodeOnly,
    /// It contradicts the others, and is left out since an instant.
    LeftOut {
        /// Since when.
        since: Time,
    },
    /// As many satellites as there is room for stand higher.
    Crowded,
    /// It has a range, and the navigator does not use ranges yet.
    Waiting,
    /// It has no range.
    Refused(RangeRefusal),
}

impl SatelliteUse {
    /// Its word: `used`, `code_only`, `left_out`, `crowded`, `waiting`, `refused`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            SatelliteUse::Phase => "used",
            SatelliteUse::CodeOnly => "code_only",
            SatelliteUse::LeftOut { .. } => "left_out",
            SatelliteUse::Crowded => "crowded",
            SatelliteUse::Waiting => "waiting",
            SatelliteUse::Refused(_) => "refused",
        }
    }

    /// Why it is not used, in a word; `None` where it is.
    #[must_use]
    pub fn reason(self) -> Option<&'static str> {
        match self {
            SatelliteUse::Phase | SatelliteUse::CodeOnly => None,
            SatelliteUse::LeftOut { .. } => Some("contradicts"),
            SatelliteUse::Crowded => Some("crowded"),
            SatelliteUse::Waiting => Some("waiting"),
            SatelliteUse::Refused(why) => Some(why.as_str()),
        }
    }
}

/// A satellite of the sky.
#[derive(Clone, Debug, PartialEq)]
pub struct SkySatellite {
    /// Which.
    pub satellite: SatelliteId,
    /// Where it stands, if that is known.
    pub direction: Option<LookAngles>,
    /// The best signal of each band, in order of the bands.
    pub signals: Vec<SignalStrength>,
    /// What becomes of it.
    pub fate: SatelliteUse,
    /// Its codes contradict those of all others in the position that the epoch alone makes.
    pub is_outlier: bool,
}

/// All satellites of a receiver's last epoch.
#[derive(Clone, Debug, PartialEq)]
pub struct Sky {
    /// When the epoch was sampled.
    pub time: Time,
    /// The satellites, in order of their names.
    pub satellites: Vec<SkySatellite>,
}
