//! A solution in the axes of robots, REP 103 of ROS: the ship's forward, left, up; the world's east, north, up.

use insd_base::{Ecef, Geodetic, Ned, Solution, earth};
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};

/// Takes north, east, down to east, north, up, and back.
pub(super) const ENU_NED: Matrix3<f64> = Matrix3::new(0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0);
/// Takes forward, left, up to forward, starboard, down, and back.
pub(super) const FRD_FLU: Matrix3<f64> =
    Matrix3::new(1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -1.0);

/// A level plane at a place, on which poses stand.
pub(super) struct Plane {
    origin: Ecef,
    /// Takes ECEF axes to north, east, down at the origin.
    c_ne: Matrix3<f64>,
}

impl Plane {
    pub(super) fn at(origin: &Geodetic) -> Self {
        Plane { origin: earth::ecef(origin), c_ne: earth::c_ne(origin) }
    }

    /// East, north and up of the origin, m.
    pub(super) fn position(&self, place: &Geodetic) -> Vector3<f64> {
        ENU_NED * (self.c_ne * (earth::ecef(place).0 - self.origin.0))
    }

    /// The rotation from forward, left, up of the ship to east, north, up of the origin.
    pub(super) fn orientation(&self, solution: &Solution) -> UnitQuaternion<f64> {
        let here = self.c_ne * earth::c_ne(&solution.position).transpose();
        let rotation = ENU_NED * here * solution.attitude.c_nb() * FRD_FLU;
        UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(rotation))
    }
}

/// A place moved north, east and down, m, as far as a plane is the Earth.
pub(super) fn moved(place: &Geodetic, by: &Ned) -> Geodetic {
    earth::geodetic(&Ecef(earth::ecef(place).0 + earth::c_ne(place).transpose() * by.0))
}

#[cfg(test)]
mod tests {
    use super::super::stretch::tests::row;
    use super::*;
    use approx::assert_relative_eq;
    use insd_base::{Attitude, Mode};
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn yaw_is_counted_from_east_and_a_list_to_starboard_is_a_positive_roll() {
        let mut solution = row(0.0, 10.0, Mode::Aided).solution;
        solution.attitude = Attitude { roll: 0.1, pitch: 0.2, heading: 0.5 };
        let plane = Plane::at(&solution.position);
        let (roll, pitch, yaw) = plane.orientation(&solution).euler_angles();
        // the bow up is a turn about the axis to the left, negative there
        let expected = [0.1, -0.2, FRAC_PI_2 - 0.5];
        for (own, expected) in [roll, pitch, yaw].into_iter().zip(expected) {
            assert_relative_eq!(own, expected, epsilon = 1e-12);
        }
    }

    #[test]
    fn a_place_east_of_the_origin_lies_along_the_first_axis() {
        let origin = Geodetic::from_degrees(54.0, 10.0, 40.0);
        let place = moved(&origin, &Ned::new(20.0, 300.0, -2.0));
        let found = Plane::at(&origin).position(&place);
        assert_relative_eq!(found, Vector3::new(300.0, 20.0, 2.0), epsilon = 1e-6);
    }
}
