//! The sensors and which of them is used.

use serde::{Deserialize, Serialize};

use super::aids::Cause;

/// How a sensor is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SensorState {
    /// It has not been heard since the start.
    Waiting,
    /// It is heard, and not used: another one is, or the navigator has no use for it yet.
    Received,
    /// It is heard, stands behind what it says, and is used.
    Valid,
    /// It is heard, and says that it is invalid, or what it says is refused.
    Rejected,
    /// It was heard, and has been silent for longer than its patience.
    Silent,
    /// A word that this version does not know.
    #[default]
    #[serde(other)]
    Unknown,
}

/// One sensor.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Sensor {
    /// Its name.
    pub name: String,
    /// Its format, as in the configuration: `sbg`, `ubx`, `compass`, ...
    pub kind: String,
    /// The port it is on.
    pub port: String,
    /// How it is.
    pub state: SensorState,
    /// Measurements a second, over the last seconds.
    pub rate_hz: Option<f64>,
    /// How long ago it was heard, s; `None` if never.
    pub age_s: Option<f64>,
    /// Its status word, if its format has one.
    pub status_word: Option<u32>,
    /// What that word says, one entry for each thing that is worth telling; empty where it is not known.
    pub status: Vec<String>,
    /// Temperature, deg C, if it tells.
    pub temperature_c: Option<f64>,
    /// Quantities that it is used for: `inertial`, `gnss`, `bottom_velocity`, `water_velocity`,
    /// `heading`, `position`.
    pub used_for: Vec<String>,
    /// Why it is used, or why not, in words.
    pub why: Option<String>,
    /// Measurements passed on to the navigator.
    pub passed: u64,
    /// Samples missing by its own counter.
    pub lost: u64,
    /// Measurements and frames not passed on, by reason.
    pub refused: Vec<Cause>,
    /// Which device of a bus it is: address and NAME.
    pub device: Option<String>,
    /// Of a base station: what is known of it.
    pub base: Option<ShownBase>,
    /// Of a satellite receiver: how its last fix was made, in words.
    pub fix: Option<String>,
    /// Of a satellite receiver: satellites in use.
    pub satellites: Option<u32>,
}

/// What is known of a base station.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ShownBase {
    /// Its number.
    pub station: Option<u16>,
    /// Latitude of its antenna, deg; null, as the next two, while it is not known.
    pub lat_deg: Option<f64>,
    /// Longitude, deg.
    pub lon_deg: Option<f64>,
    /// Height above the ellipsoid, m.
    pub height_m: Option<f64>,
    /// How far it is from the ship, m.
    pub distance_m: Option<f64>,
    /// How old its newest epoch is, s.
    pub age_s: Option<f64>,
    /// Satellites of that epoch.
    pub satellites: u32,
    /// Epochs so far.
    pub epochs: u64,
}

/// The source of a quantity.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ShownChoice {
    /// Of what, as in [`Sensor::used_for`].
    pub quantity: String,
    /// Name of the sensor in use; `None` where there is none.
    pub sensor: Option<String>,
    /// Why that one: `first`, `silent`, `invalid`, `better`, `none_left`.
    pub why: Option<String>,
}
