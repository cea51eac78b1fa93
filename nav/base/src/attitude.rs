//! Roll, pitch and heading, and the rotation they stand for.

use nalgebra::{Matrix3, Rotation3, Vector3};

use crate::units::wrap_two_pi;

/// Euler angles of the hull in the order yaw-pitch-roll: C_nb = R_z(heading) R_y(pitch) R_x(roll).
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Attitude {
    /// Roll, rad, starboard side down positive.
    pub roll: f64,
    /// Pitch, rad, bow up positive.
    pub pitch: f64,
    /// Heading, rad, clockwise from true north, [0, 2 pi).
    pub heading: f64,
}

impl Attitude {
    /// Rotation from body to north-east-down axes.
    #[must_use]
    pub fn c_nb(&self) -> Matrix3<f64> {
        Rotation3::from_euler_angles(self.roll, self.pitch, self.heading).into_inner()
    }

    /// Euler angles of a body-to-NED rotation. At pitch +-90 deg roll is taken as zero.
    #[must_use]
    pub fn from_c_nb(c_nb: &Matrix3<f64>) -> Self {
        let (roll, pitch, heading) = Rotation3::from_matrix_unchecked(*c_nb).euler_angles();
        Attitude { roll, pitch, heading: wrap_two_pi(heading) }
    }

    /// Rows map a small rotation vector in NED axes (of n-resolved attitude error, rad) to changes
    /// of roll, pitch and heading: for C_true = (I + [phi x]) C_nb,
    ///
    /// d roll = (cos psi phi_N + sin psi phi_E) / cos theta,
    /// d pitch = -sin psi phi_N + cos psi phi_E,
    /// d heading = phi_D + tan theta (cos psi phi_N + sin psi phi_E).
    ///
    /// The inverse of the rates-to-Euler relation of Groves, Principles of GNSS, Inertial and
    /// Multisensor Integrated Navigation Systems, 2nd ed., eq. (2.57), with the turn in n axes.
    #[must_use]
    pub fn jacobian_of_ned_rotation(&self) -> Matrix3<f64> {
        let (sin_h, cos_h) = self.heading.sin_cos();
        let cos_p = self.pitch.cos().max(1e-9);
        let tan_p = self.pitch.sin() / cos_p;
        Matrix3::new(
            cos_h / cos_p,
            sin_h / cos_p,
            0.0,
            -sin_h,
            cos_h,
            0.0,
            tan_p * cos_h,
            tan_p * sin_h,
            1.0,
        )
    }
}

/// The cross-product matrix of a vector: `skew(a) * b == a.cross(&b)`.
#[must_use]
pub fn skew(a: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::new(0.0, -a.z, a.y, a.z, 0.0, -a.x, -a.y, a.x, 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::wrap_pi;
    use approx::assert_relative_eq;

    #[test]
    fn angles_survive_the_matrix() {
        let attitude = Attitude { roll: 0.2, pitch: -0.1, heading: 5.5 };
        let back = Attitude::from_c_nb(&attitude.c_nb());
        assert_relative_eq!(back.roll, attitude.roll, epsilon = 1e-12);
        assert_relative_eq!(back.pitch, attitude.pitch, epsilon = 1e-12);
        assert_relative_eq!(back.heading, attitude.heading, epsilon = 1e-12);
    }

    #[test]
    fn a_turn_to_starboard_raises_the_heading_and_points_the_bow_east() {
        let east = Attitude { roll: 0.0, pitch: 0.0, heading: 90_f64.to_radians() };
        let bow = east.c_nb() * Vector3::x();
        assert_relative_eq!(bow, Vector3::y(), epsilon = 1e-12);
    }

    #[test]
    fn the_jacobian_agrees_with_perturbed_rotations() {
        let attitude = Attitude { roll: 0.3, pitch: 0.2, heading: 2.0 };
        let jacobian = attitude.jacobian_of_ned_rotation();
        for axis in 0..3 {
            let mut phi = Vector3::zeros();
            phi[axis] = 1e-6;
            let turned =
                Attitude::from_c_nb(&((Matrix3::identity() + skew(&phi)) * attitude.c_nb()));
            let change = Vector3::new(
                turned.roll - attitude.roll,
                turned.pitch - attitude.pitch,
                wrap_pi(turned.heading - attitude.heading),
            ) / 1e-6;
            assert_relative_eq!(change, jacobian.column(axis).into_owned(), epsilon = 1e-5);
        }
    }
}
