//! Vectors and positions that carry their axes in their type, for the borders between crates.
//! Inside one formula plain `nalgebra` is used, with names that check by eye.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// A vector along north, east, down.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Ned(pub Vector3<f64>);

/// A vector along forward, starboard, down of the hull.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Body(pub Vector3<f64>);

/// A vector or point in Earth-centred, Earth-fixed axes (WGS-84).
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Ecef(pub Vector3<f64>);

/// A point by geodetic latitude and longitude, rad, and height above the WGS-84 ellipsoid, m.
#[derive(Clone, Copy, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct Geodetic {
    /// Geodetic latitude, rad, north positive.
    pub latitude: f64,
    /// Longitude, rad, east positive.
    pub longitude: f64,
    /// Height above the ellipsoid, m.
    pub height: f64,
}

impl Ned {
    /// A vector from its north, east and down components.
    #[must_use]
    pub fn new(north: f64, east: f64, down: f64) -> Self {
        Ned(Vector3::new(north, east, down))
    }
}

impl Body {
    /// A vector from its forward, starboard and down components.
    #[must_use]
    pub fn new(forward: f64, starboard: f64, down: f64) -> Self {
        Body(Vector3::new(forward, starboard, down))
    }
}

impl Geodetic {
    /// A point from degrees and metres.
    #[must_use]
    pub fn from_degrees(latitude_deg: f64, longitude_deg: f64, height_m: f64) -> Self {
        Geodetic {
            latitude: latitude_deg.to_radians(),
            longitude: longitude_deg.to_radians(),
            height: height_m,
        }
    }
}
