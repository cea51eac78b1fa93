//! References that are watched and not used.

use serde::{Deserialize, Serialize};

/// How one of them stands to the ship's own word, or to another one.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ShownWatch {
    /// Name of the sensor.
    pub sensor: String,
    /// Name of the one that it is compared with; `None` for the ship's own word.
    pub against: Option<String>,
    /// Of what: `heading`, `position`, `attitude`.
    pub quantity: String,
    /// Heading of the sensor less that of the other, or how far roll and pitch are apart, averaged, deg.
    pub difference_deg: Option<f64>,
    /// 1-sigma of it, as both claim, deg.
    pub sigma_deg: Option<f64>,
    /// The limit that is set, deg.
    pub limit_deg: Option<f64>,
    /// How far positions are apart, averaged, m.
    pub difference_m: Option<f64>,
    /// 1-sigma of each of its components, m.
    pub sigma_m: Option<f64>,
    /// The limit that is set, m.
    pub limit_m: Option<f64>,
    /// Whether it has been beyond the limit for long enough.
    pub differs: bool,
    /// Name of the one that is wrong, where that is known.
    pub wrong: Option<String>,
    /// How old its newest reading is, s.
    pub age_s: Option<f64>,
}
