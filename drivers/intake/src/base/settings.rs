//! What an installer knows of a base.

use insd_base::{Geodetic, earth};
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Heights above the ellipsoid at which a base can stand, m.
pub(super) const HEIGHTS: std::ops::RangeInclusive<f64> = -500.0..=9000.0;

/// What is known of a base beside what it says.
#[derive(Clone, Copy, Debug, PartialEq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct BaseSettings {
    /// Latitude of its antenna, deg: with the two others it holds in place of what the base tells.
    pub lat_deg: Option<f64>,
    /// Longitude, deg.
    pub lon_deg: Option<f64>,
    /// Height above the ellipsoid, m.
    pub height_m: Option<f64>,
    /// Whether it moves: another ship, a float. Its position is then that of its last message, and may change.
    pub moving: bool,
}

impl BaseSettings {
    /// The reference point of its antenna, ECEF, m, if it is configured.
    pub(super) fn position(&self) -> Option<Vector3<f64>> {
        let place = Geodetic::from_degrees(self.lat_deg?, self.lon_deg?, self.height_m?);
        Some(earth::ecef(&place).0)
    }

    /// What is wrong with it, in words.
    pub(crate) fn fault(&self) -> Option<&'static str> {
        let all = [self.lat_deg, self.lon_deg, self.height_m];
        let count = all.iter().flatten().count();
        let within = |value: Option<f64>, range: std::ops::RangeInclusive<f64>| {
            value.is_none_or(|value| range.contains(&value))
        };
        if count != 0 && count != 3 {
            Some("lat_deg, lon_deg and height_m, all of them or none")
        } else if count == 3 && self.moving {
            Some("coordinates or moving, not both")
        } else if !within(self.lat_deg, -90.0..=90.0)
            || !within(self.lon_deg, -180.0..=360.0)
            || !within(self.height_m, HEIGHTS)
        {
            Some("a latitude, a longitude and a height on Earth")
        } else {
            None
        }
    }
}
