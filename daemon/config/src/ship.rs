//! Ship and start.

use insd_base::VesselKind;
use insd_languages::Language;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Ship and start.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ShipSection {
    /// What is known of her motion at the start: at the berth, or under way.
    #[serde(default)]
    pub start: Start,
    /// Latitude of the berth, or of the start, deg.
    pub lat_deg: Option<f64>,
    /// Longitude, deg.
    pub lon_deg: Option<f64>,
    /// Height of the IMU above the ellipsoid, m.
    #[serde(default)]
    pub height_m: f64,
    /// Antenna from the IMU: forward, starboard, down, m.
    #[serde(default)]
    pub gnss_lever_m: [f64; 3],
    /// Log from the IMU: forward, starboard, down, m.
    #[serde(default)]
    pub log_lever_m: [f64; 3],
    /// Name of the first engine's IMU, where there are several. Left out: the best that is valid.
    pub imu: Option<String>,
    /// Whether the mounting of the IMU is as it should be, whatever gravity and course say: then nothing of
    /// its attitude is taken back. For ships that sail backwards as well as forwards, like double-ended
    /// ferries.
    #[serde(default)]
    pub accept_mounting: bool,
    /// Whether position, course, speed and heading of receivers and compass pass through, marked, while
    /// there are no data of the IMU.
    #[serde(default = "yes")]
    pub relay: bool,
    /// Solutions per second.
    #[serde(default = "ten")]
    pub rate_hz: f64,
    /// What carries the sensors: `ship`, `boat` or `car`.
    #[serde(default)]
    pub kind: CarrierKind,
    /// How well receiver and IMU agree in time, 1-sigma, s. Left out: by what ties them.
    #[serde(alias = "gnss_delay_std_s")]
    #[schemars(extend("x-alias" = "gnss_delay_std_s"))]
    pub time_std_s: Option<f64>,
    /// What people aboard read: `en` or `ja`. Of the page whoever looks at it may choose another.
    #[serde(default)]
    pub language: Language,
    /// Real-time priority of the engine's thread, 1 to 99; that of the ports is one less. 0 for none.
    #[serde(default = "twenty")]
    pub priority: Option<u8>,
}

/// What carries the sensors.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CarrierKind {
    /// A displacement ship.
    #[default]
    Ship,
    /// A fast boat that planes.
    Boat,
    /// A car, on trials ashore.
    Car,
}

impl From<CarrierKind> for VesselKind {
    fn from(kind: CarrierKind) -> Self {
        match kind {
            CarrierKind::Ship => VesselKind::Ship,
            CarrierKind::Boat => VesselKind::Boat,
            CarrierKind::Car => VesselKind::Car,
        }
    }
}

/// What is known of the ship's motion at the start.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Start {
    /// At the berth.
    Moored,
    /// Under way, or unknown.
    #[default]
    Underway,
}

fn yes() -> bool {
    true
}
fn ten() -> f64 {
    10.0
}
fn twenty() -> Option<u8> {
    Some(20)
}
