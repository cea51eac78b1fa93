//! The plane of the chart: an oblique stereographic projection of the WGS-84 ellipsoid about the middle of
//! the track. It is conformal, so the scale is the same in all directions everywhere on the chart, and it
//! knows neither poles nor antimeridian. North is up in the middle.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use insd_base::earth;
use insd_base::units::DEG;

/// The middle is no nearer to a pole than this, as its own meridian must be up.
const POLAR: f64 = 89.99 * DEG;
/// Rounds of the latitude's iteration: each leaves less than a hundredth of the error.
const ROUNDS: usize = 6;

/// The projection about one point. Snyder, Map Projections: A Working Manual (USGS 1395), ch. 21, on the
/// conformal sphere, eqs. (3-1), (3-4), (20-14), (20-15), (21-2) to (21-4).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Projection {
    /// Radius of the sphere, m: the scale is true in the middle.
    radius: f64,
    /// Conformal latitude of the middle, and its longitude, rad.
    latitude: f64,
    pub(crate) longitude: f64,
}

impl Projection {
    /// About a point by latitude and longitude, rad.
    pub(crate) fn new(latitude: f64, longitude: f64) -> Self {
        let geodetic = latitude.clamp(-POLAR, POLAR);
        let conformal = conformal(geodetic);
        let (_, normal) = earth::radii(geodetic);
        let radius = normal * geodetic.cos() / conformal.cos();
        Projection { radius, latitude: conformal, longitude }
    }

    /// East and north on the chart, m.
    pub(crate) fn plane(&self, latitude: f64, longitude: f64) -> (f64, f64) {
        let (sin, cos) = conformal(latitude).sin_cos();
        let (sin_1, cos_1) = self.latitude.sin_cos();
        let (sin_l, cos_l) = (longitude - self.longitude).sin_cos();
        let scale = 2.0 * self.radius / (1.0 + sin_1 * sin + cos_1 * cos * cos_l).max(1e-9);
        (scale * cos * sin_l, scale * (cos_1 * sin - sin_1 * cos * cos_l))
    }

    /// Latitude, and longitude east of the middle, rad, of a point of the chart.
    pub(crate) fn sphere(&self, east: f64, north: f64) -> (f64, f64) {
        let distance = east.hypot(north).max(1e-9);
        let (sin_c, cos_c) = (2.0 * (distance / (2.0 * self.radius)).atan()).sin_cos();
        let (sin_1, cos_1) = self.latitude.sin_cos();
        let sine = cos_c * sin_1 + north * sin_c * cos_1 / distance;
        let across = distance * cos_1 * cos_c - north * sin_1 * sin_c;
        (geodetic(sine.clamp(-1.0, 1.0).asin()), (east * sin_c).atan2(across))
    }
}

/// Conformal latitude of a geodetic one.
fn conformal(latitude: f64) -> f64 {
    let latitude = latitude.clamp(-FRAC_PI_2, FRAC_PI_2);
    let tangent = (FRAC_PI_4 + latitude / 2.0).tan() / stretch(latitude);
    2.0 * tangent.atan() - FRAC_PI_2
}

fn geodetic(conformal: f64) -> f64 {
    let tangent = (FRAC_PI_4 + conformal / 2.0).tan();
    (0..ROUNDS)
        .fold(conformal, |latitude, _| 2.0 * (tangent * stretch(latitude)).atan() - FRAC_PI_2)
}

fn stretch(latitude: f64) -> f64 {
    let eccentricity = earth::ECCENTRICITY_SQ.sqrt();
    let sine = eccentricity * latitude.sin();
    ((1.0 + sine) / (1.0 - sine)).powf(eccentricity / 2.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::Geodetic;

    #[test]
    fn distances_on_the_chart_are_those_on_the_earth_in_all_directions_and_places() {
        for latitude in [-89.999, -60.0, 0.0, 35.0, 71.0, 89.9] {
            let (latitude, longitude) = (latitude * DEG, 179.999 * DEG);
            let projection = Projection::new(latitude, longitude);
            for (north, east) in [(1e-4, 0.0), (0.0, 1e-4), (-1e-4, 1e-4)] {
                let there = (latitude + north * DEG, longitude + east * DEG / latitude.cos());
                let plane = |at: (f64, f64)| projection.plane(at.0, at.1);
                let (one, other) = (plane((latitude, longitude)), plane(there));
                let drawn = (other.0 - one.0).hypot(other.1 - one.1);
                let ecef = |at: (f64, f64)| {
                    earth::ecef(&Geodetic { latitude: at.0, longitude: at.1, height: 0.0 }).0
                };
                let true_one = (ecef(there) - ecef((latitude, longitude))).norm();
                assert!((drawn / true_one - 1.0).abs() < 2e-4, "{latitude} {north} {east}");
            }
        }
    }

    #[test]
    fn a_point_of_the_chart_is_found_again() {
        let projection = Projection::new(54.0 * DEG, -179.9 * DEG);
        for (east, north) in [(0.0, 0.0), (30_000.0, -12_000.0), (-400_000.0, 900_000.0)] {
            let (latitude, longitude) = projection.sphere(east, north);
            let (x, y) = projection.plane(latitude, longitude + projection.longitude);
            assert!((x - east).abs() < 1e-3 && (y - north).abs() < 1e-3, "{x} {y}");
        }
    }
}
