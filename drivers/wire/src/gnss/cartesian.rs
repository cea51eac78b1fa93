//! Places and velocities along the axes of the Earth, as some receivers tell them.

use insd_base::{Ecef, Geodetic, earth};

/// Nearer to the centre of the Earth than this nobody is, m: zeros are no place.
const DEEPEST: f64 = 6.0e6;

/// Farther from it nobody navigates by this, m.
const HIGHEST: f64 = 1.0e8;

/// Latitude, longitude and height of a place, m; `None` of none on Earth.
pub(super) fn place(position: [f64; 3]) -> Option<Geodetic> {
    let position = Ecef(position.into());
    (DEEPEST..HIGHEST).contains(&position.0.norm()).then(|| earth::geodetic(&position))
}

/// Velocity to the north, the east and down of one along the axes of the Earth at a place, m/s.
pub(super) fn velocity(place: &Geodetic, velocity: [f64; 3]) -> [f64; 3] {
    (earth::c_ne(place) * Ecef(velocity.into()).0).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ship_that_sails_north_at_the_equator_goes_along_the_third_axis() {
        let here = place([6_378_137.0, 0.0, 0.0]).unwrap();
        assert!(here.latitude.abs() < 1e-12 && here.height.abs() < 1e-6);
        assert_eq!(velocity(&here, [0.0, 0.0, 5.0]), [5.0, 0.0, 0.0]);
        assert_eq!(velocity(&here, [2.0, 3.0, 0.0]), [0.0, 3.0, -2.0]);
        assert_eq!(place([0.0; 3]), None);
    }
}
