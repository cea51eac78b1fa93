//! What a linear filter leaves out of a lever arm that nobody has measured: the product of its error with that of
//! attitude and turn rate.
//!
//! An antenna of which the place is unknown to metres seems to move by metres times the error of the attitude, which is
//! centimetres where the receiver tells millimetres. Where the filter is sure of neither, the fix is worth no more than that
//! (the second-order term of the measurement: Jazwinski, Stochastic Processes and Filtering Theory, section 9.3).

use insd_base::attitude::skew;
use nalgebra::{Matrix3, Vector3};

use super::Filter;
use crate::aids::View;
use crate::error_state::{ATTITUDE, GNSS_LEVER, GYRO_BIAS, GYRO_DRIFT};

impl Filter {
    /// Covariance of the position of the antenna that is left out, NED, m^2.
    pub(super) fn bent_position(&self, view: &View) -> Matrix3<f64> {
        let p = &self.state.covariance;
        let attitude = ATTITUDE.covariance_in(p, &view.c_ne);
        of_product(&attitude, &GNSS_LEVER.covariance_in(p, &view.c_nb()))
    }

    /// Covariance of the velocity of the antenna that is left out, NED, m^2/s^2.
    pub(super) fn bent_velocity(&self, view: &View) -> Matrix3<f64> {
        let (p, c_nb) = (&self.state.covariance, view.c_nb());
        let attitude = ATTITUDE.covariance_in(p, &view.c_ne);
        let swing = GNSS_LEVER.covariance_in(p, &(c_nb * skew(&view.rate)));
        let gyro = GYRO_BIAS.covariance_in(p, &c_nb) + GYRO_DRIFT.covariance_in(p, &c_nb);
        let lever = GNSS_LEVER.covariance_in(p, &c_nb);
        of_product(&attitude, &swing) + of_product(&gyro, &lever)
    }
}

/// Variance of what a linear filter leaves out of a distance along a line e by an arm a that an attitude error phi of a covariance turns, m^2:
/// e . (phi x (phi x a)) / 2 = phi^T B phi / 2, its mean and its scatter (Jazwinski, Stochastic Processes and Filtering Theory, section 9.3).
pub(super) fn bent_distance(
    attitude: &Matrix3<f64>,
    line: &Vector3<f64>,
    arm: &Vector3<f64>,
) -> f64 {
    let both = line * arm.transpose();
    let b = (both + both.transpose()) * 0.5 - Matrix3::from_diagonal_element(line.dot(arm));
    let spread = b * attitude;
    (0.5 * spread.trace()).powi(2) + 0.5 * (spread * spread).trace()
}

/// Covariance of a x b for independent a and b of mean zero.
fn of_product(a: &Matrix3<f64>, b: &Matrix3<f64>) -> Matrix3<f64> {
    let both = a * b;
    let (of_a, of_b) = (a.trace(), b.trace());
    let scale = of_a * of_b - both.trace();
    Matrix3::from_diagonal_element(scale) - a * of_b - b * of_a + both + both.transpose()
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn a_turn_about_down_moves_what_is_ahead_to_starboard() {
        let turn = Matrix3::from_diagonal(&Vector3::new(0.0, 0.0, 0.01));
        let ahead = Matrix3::from_diagonal(&Vector3::new(4.0, 0.0, 0.0));
        let starboard = Matrix3::from_diagonal(&Vector3::new(0.0, 0.04, 0.0));
        assert_relative_eq!(of_product(&turn, &ahead), starboard, epsilon = 1e-12);
    }

    #[test]
    fn it_is_the_mean_of_the_products_over_the_axes_of_both() {
        let axes = |m: Matrix3<f64>| [0, 1, 2].map(|i| m.column(i).into_owned());
        let a = Matrix3::new(1.0, 0.0, 0.0, 0.4, 2.0, 0.0, -0.3, 0.7, 0.5);
        let b = Matrix3::new(3.0, 0.0, 0.0, -1.0, 0.2, 0.0, 0.6, 0.1, 1.5);
        let mut expected = Matrix3::zeros();
        for one in axes(a) {
            for other in axes(b) {
                let product = one.cross(&other);
                expected += product * product.transpose();
            }
        }
        let found = of_product(&(a * a.transpose()), &(b * b.transpose()));
        assert_relative_eq!(found, expected, epsilon = 1e-12);
    }
}
