//! What became of the measurements.

use serde::{Deserialize, Serialize};

/// What became of the measurements of one aid.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ShownAid {
    /// Which: `gnss_position`, `gnss_velocity`, `log_bottom`, ...
    pub name: String,
    /// Whether one was used in the last seconds.
    pub in_use: bool,
    /// How long ago one was used, s; `None` if never.
    pub age_s: Option<f64>,
    /// Measurements used; of satellites each one.
    pub accepted: u64,
    /// Measurements not used.
    pub rejected: u64,
    /// The same by reason.
    pub reasons: Vec<Cause>,
    /// Standard deviations that were missing, zero or absurd and were replaced by a floor.
    pub floored: u64,
    /// The last innovation divided by its expected 1-sigma; the component in which that is greatest.
    pub last_normalised_innovation: Option<f64>,
}

/// How often for one reason.
#[derive(Clone, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Cause {
    /// Why: `chi_square`, `dop_test`, `malformed`, `not_chosen`, `contradicts` (a satellite), ...
    pub reason: String,
    /// How often since the start.
    pub count: u64,
}

/// A measurement that was not used.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Rejected {
    /// Its time of validity, on the ship's time line, s.
    pub at_s: f64,
    /// The same in UTC, if it was known.
    pub utc: Option<String>,
    /// Who sent it.
    pub source: String,
    /// Of which aid.
    pub aid: String,
    /// Why.
    pub reason: String,
}

/// What became of the samples of the IMU.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Samples {
    /// Used.
    pub used: u64,
    /// Gaps that were bridged.
    pub gaps: u64,
    /// Repeated with the same time.
    pub duplicates: u64,
    /// With a time before the last one.
    pub out_of_order: u64,
    /// With values that are not finite or not physical.
    pub out_of_range: u64,
}
