//! The straight way of a signal through a spherical Earth's space.
//!
//! The document follows it by spherical trigonometry from the ray's perigee, the point nearest to the Earth's centre (2.5.8.2,
//! equations 153 to 187). Written with vectors it is the same, and no pole and no zenith is a special case.

use insd_base::Geodetic;
use nalgebra::Vector3;

/// Radius of the model's Earth, km.
const EARTH_KM: f64 = 6371.2;
/// A ray whose perigee is nearer to the Earth's centre is vertical, km (2.5.8).
const VERTICAL_KM: f64 = 0.1;

/// A place: latitude and longitude, rad, height, km. Geodetic latitude and height are taken for those on the sphere, as in
/// the document.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    /// North positive.
    pub(super) latitude: f64,
    /// East positive.
    pub(super) longitude: f64,
    /// Above the sphere.
    pub(super) height: f64,
}

/// A ray upwards from one place to another.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ray {
    /// Earth's centre to the perigee, km.
    perigee: Vector3<f64>,
    /// Unit vector.
    direction: Vector3<f64>,
    /// From the perigee to both ends, km.
    ends: [f64; 2],
}

impl From<&Geodetic> for Place {
    fn from(from: &Geodetic) -> Self {
        Place { latitude: from.latitude, longitude: from.longitude, height: from.height / 1e3 }
    }
}

impl Place {
    /// From the Earth's centre, km: x to latitude 0 longitude 0, z to the north pole.
    fn position(&self) -> Vector3<f64> {
        let (sin, cos) = self.latitude.sin_cos();
        let (east, along) = self.longitude.sin_cos();
        (EARTH_KM + self.height) * Vector3::new(cos * along, cos * east, sin)
    }
}

impl Ray {
    pub(super) fn new(from: &Place, to: &Place) -> Self {
        let [from, to] = [from, to].map(Place::position);
        let direction = (to - from).normalize();
        let ends = [from, to].map(|end| end.dot(&direction));
        Ray { perigee: from - ends[0] * direction, direction, ends }
    }

    /// Whether one place is above the other.
    pub(super) fn is_vertical(&self) -> bool {
        self.perigee.norm() < VERTICAL_KM
    }

    /// From the perigee to both ends, km (equations 176 and 177).
    pub(super) fn ends(&self) -> [f64; 2] {
        self.ends
    }

    /// From the perigee to where the ray rises through a height, km: 0 if all of it is higher.
    pub(super) fn at_height(&self, height: f64) -> f64 {
        ((EARTH_KM + height).powi(2) - self.perigee.norm_squared()).max(0.0).sqrt()
    }

    /// The place at a distance from the perigee, km (equations 178 to 187).
    pub(super) fn place(&self, distance: f64) -> Place {
        let at = self.perigee + distance * self.direction;
        Place {
            latitude: at.z.atan2(at.x.hypot(at.y)),
            longitude: at.y.atan2(at.x),
            height: at.norm() - EARTH_KM,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(latitude: f64, longitude: f64, height: f64) -> Place {
        Place { latitude, longitude, height }
    }

    #[test]
    fn a_ray_begins_and_ends_where_it_should() {
        let (from, to) = (place(0.8, -3.0, 0.1), place(0.3, 2.9, 20_000.0));
        let ray = Ray::new(&from, &to);
        for (end, expected) in ray.ends().into_iter().zip([from, to]) {
            let found = ray.place(end);
            assert!((found.latitude - expected.latitude).abs() < 1e-12);
            assert!((found.longitude - expected.longitude).abs() < 1e-12);
            assert!((found.height - expected.height).abs() < 1e-8);
        }
        assert!((ray.place(ray.at_height(1000.0)).height - 1000.0).abs() < 1e-8);
    }

    #[test]
    fn a_ray_is_vertical_at_the_zenith_only() {
        let (from, to) = (place(0.8, 1.0, 0.0), place(0.8, 1.0, 20_000.0));
        assert!(Ray::new(&from, &to).is_vertical());
        assert!(!Ray::new(&from, &place(0.8001, 1.0, 20_000.0)).is_vertical());
        assert!(Ray::new(&place(1.57, 1.0, 0.0), &place(1.57, 1.0, 20_000.0)).is_vertical());
    }

    #[test]
    fn a_ray_may_pass_over_the_pole() {
        let ray = Ray::new(&place(1.5, 0.0, 0.0), &place(1.2, 3.1, 20_000.0));
        let places = (0..=100).map(|k| {
            let [from, to] = ray.ends();
            ray.place(from + (to - from) * f64::from(k) / 100.0)
        });
        let highest = places.map(|place| place.latitude).fold(0.0, f64::max);
        assert!((1.56..1.571).contains(&highest));
    }
}
