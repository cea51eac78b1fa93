//! The berth that the voyage ends at.

use insd_base::Geodetic;
use insd_base::earth::ecef;
use serde::{Deserialize, Serialize};

use super::fault::Faults;

/// Which side of the line is water, looking from its first point to the second.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum Water {
    /// The right-hand side.
    #[default]
    Right,
    /// The left-hand side.
    Left,
}

/// The berth that the voyage ends at, for a docking view: the ship is where her route, sea and shifts bring her, whatever is written here.
/// Keys and units are those of a `[[berth]]` of insd.toml.
#[derive(Clone, Debug, Deserialize, Serialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct ScenarioBerth {
    /// Its name.
    name: String,
    /// One point of the edge of the quay: latitude, longitude.
    from_deg: [f64; 2],
    /// Another.
    to_deg: [f64; 2],
    /// Where the water is.
    #[serde(default)]
    water: Water,
    /// Face of the fenders before the edge.
    #[serde(default)]
    fender_m: f64,
    /// From the first point.
    #[serde(default)]
    bollards_m: Vec<f64>,
}

impl ScenarioBerth {
    /// What it is called.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Two points of the edge of the quay with the water on the right, looking from the first to the second, at a height above the ellipsoid, m.
    pub(crate) fn edge(&self, height: f64) -> [Geodetic; 2] {
        let [from, to] =
            [self.from_deg, self.to_deg].map(|[lat, lon]| Geodetic::from_degrees(lat, lon, height));
        match self.water {
            Water::Right => [from, to],
            Water::Left => [to, from],
        }
    }

    /// Bollards, from the first of these points, m, when the edge is `length`, m.
    pub(crate) fn bollards(&self, length: f64) -> impl Iterator<Item = f64> + '_ {
        let from_first = move |at: &f64| match self.water {
            Water::Right => *at,
            Water::Left => length - at,
        };
        self.bollards_m.iter().map(from_first)
    }

    pub(super) fn check(&self, faults: &mut Faults) {
        for (key, [lat, lon]) in [("from_deg", self.from_deg), ("to_deg", self.to_deg)] {
            faults.range(format!("berth.{key}[0]"), lat, -90.0, 90.0);
            faults.range(format!("berth.{key}[1]"), lon, -360.0, 360.0);
        }
        let place = |[lat, lon]: [f64; 2]| ecef(&Geodetic::from_degrees(lat, lon, 0.0)).0;
        let length = (place(self.to_deg) - place(self.from_deg)).norm();
        if !(1.0..=5000.0).contains(&length) {
            faults.add(
                "berth.to_deg",
                format!("expected 1 to 5000 m from from_deg, found {length:.0}"),
            );
        }
        faults.range("berth.fender_m", self.fender_m, 0.0, 30.0);
        for (index, at) in self.bollards_m.iter().enumerate() {
            faults.range(format!("berth.bollards_m[{index}]"), *at, 0.0, length);
        }
    }
}
