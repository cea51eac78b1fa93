//! What is learnt of the sensors.

use serde::{Deserialize, Serialize};

/// What is learnt of log, current and IMU while she is well aided.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ShownLearning {
    /// Whether it may be used: nobody has switched it off.
    pub may_be_used: bool,
    /// Whether what repeats of the log is used.
    pub uses_log: bool,
    /// Whether the pace of the current is used.
    pub uses_current: bool,
    /// Whether biases of the IMU follow its temperature.
    pub uses_temperature: bool,
    /// Hours that were learnt from.
    pub learnt_h: f64,
    /// Voyages that were learnt from, this one among them.
    pub voyages: u32,
    /// Error after five minutes without GNSS in the last outages that did not happen, median, m.
    pub outage_m: Option<f64>,
    /// The same without what is learnt, m.
    pub outage_without_m: Option<f64>,
    /// All of it in words, line by line.
    pub words: Vec<String>,
}
