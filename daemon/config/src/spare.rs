//! Spare engines.

use schemars::JsonSchema;
use serde::Deserialize;

use crate::imu::ImuModel;

/// An engine that runs beside the first.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpareSection {
    /// Its name in the journal.
    pub name: String,
    /// Name of the sensor that is its IMU; that of the first engine if left out.
    pub imu: Option<String>,
    /// Its IMU from the first engine's: forward, starboard, down, m.
    #[serde(default)]
    pub offset_m: [f64; 3],
    /// How well its IMU's axes are known to be those of the first, 1-sigma, deg.
    #[serde(default = "tenth")]
    pub mounting_std_deg: f64,
    /// Error model of its IMU; that of `[imu]` if left out.
    pub model: Option<ImuModel>,
}

fn tenth() -> f64 {
    0.1
}
