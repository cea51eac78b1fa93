//! Claimed 1-sigma of what a solution says, from the covariance of the error state.

use insd_base::attitude::skew;
use insd_base::{Geodetic, MotionCovariance, SolutionSigma, earth};
use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

use crate::aids::View;
use crate::dating::Dating;
use crate::error_state::{
    ATTITUDE, Covariance, Errors, GNSS_DELAY, POSITION, STRAPDOWN_STATES, VELOCITY,
};

type Rows = SMatrix<f64, 3, STRAPDOWN_STATES>;
type Square = SMatrix<f64, STRAPDOWN_STATES, STRAPDOWN_STATES>;
type Column = SVector<f64, STRAPDOWN_STATES>;

/// How the errors of a solution come from those of the state.
///
/// North itself depends on where the ship is: an error of position dr_n turns the NED axes by
/// dtheta = T dr_n, so that
///
/// dv_n = C_ne dv + [v_n x] T dr_n,   d(roll, pitch, heading) = J (C_ne phi - T dr_n),
///
/// T = [0, 1/(N+h), 0; -1/(M+h), 0, 0; 0, -tan(lat)/(N+h), 0] as in the transport rate (Groves, 2nd
/// ed., eq. (5.44)). Anywhere but near a pole T is nothing; there it is what the heading is worth.
/// Held by `velocity_and_heading_near_the_pole_share_the_position_error`.
///
/// The solution is given in GNSS time; what is not known of the IMU's delay behind it counts with the
/// ship's velocity, her acceleration (ECEF axes, m/s^2) and her turning.
struct Errorwise {
    rows: Square,
    /// The rows times the covariance of the strapdown errors.
    with_state: Square,
    by_delay: Column,
    /// Covariance with the delay, as far as it counts; and its own.
    with_delay: Column,
    unsure: f64,
}

impl Errorwise {
    fn new(view: &View, acceleration: &Vector3<f64>, dating: &Dating, p: &Covariance) -> Self {
        let corner = p.matrix().fixed_view::<STRAPDOWN_STATES, STRAPDOWN_STATES>(0, 0);
        let mut delayed = Column::zeros();
        for (block, at) in [(POSITION, 0), (VELOCITY, 3), (ATTITUDE, 6)] {
            delayed.fixed_rows_mut::<3>(at).copy_from(&block.covariance_with(GNSS_DELAY, p));
        }
        let rows = all_rows(view);
        let turning = view.attitude().jacobian_of_ned_rotation() * (view.c_nb() * view.rate);
        let mut by_delay = Column::zeros();
        by_delay.fixed_rows_mut::<3>(0).copy_from(&-view.v_n());
        by_delay.fixed_rows_mut::<3>(3).copy_from(&-(view.c_ne * acceleration));
        by_delay.fixed_rows_mut::<3>(6).copy_from(&-turning);
        let delay = GNSS_DELAY.covariance(p).x;
        Errorwise {
            with_state: rows * corner,
            with_delay: rows * delayed * dating.share,
            rows,
            by_delay,
            unsure: dating.share * dating.share * delay + dating.std * dating.std,
        }
    }

    fn variances(&self) -> Column {
        let own = self.with_state.component_mul(&self.rows).column_sum();
        let by_delay = &self.by_delay;
        own + self.with_delay.component_mul(by_delay) * 2.0
            + by_delay.component_mul(by_delay) * self.unsure
    }

    fn covariance(&self) -> MotionCovariance {
        let crossed = self.with_delay * self.by_delay.transpose();
        self.with_state * self.rows.transpose()
            + crossed
            + crossed.transpose()
            + self.by_delay * self.by_delay.transpose() * self.unsure
    }
}

/// Sigmas of position and velocity along north, east, down and of roll, pitch, heading.
#[must_use]
pub fn solution_sigma(
    view: &View,
    acceleration: &Vector3<f64>,
    dating: &Dating,
    p: &Covariance,
) -> SolutionSigma {
    SolutionSigma::of_variances(&Errorwise::new(view, acceleration, dating, p).variances())
}

/// How the same errors hang together.
#[must_use]
pub fn solution_covariance(
    view: &View,
    acceleration: &Vector3<f64>,
    dating: &Dating,
    p: &Covariance,
) -> MotionCovariance {
    Errorwise::new(view, acceleration, dating, p).covariance()
}

/// What an error of the estimate does to each component of a solution, as its size.
#[must_use]
pub fn difference(view: &View, error: &Errors) -> SolutionSigma {
    let mut own = SVector::<f64, STRAPDOWN_STATES>::zeros();
    for (block, at) in [(POSITION, 0), (VELOCITY, 3), (ATTITUDE, 6)] {
        own.fixed_rows_mut::<3>(at).copy_from(&error.of(block));
    }
    SolutionSigma::of(&(all_rows(view) * own).abs())
}

/// Derivatives of NED position and velocity and of the Euler angles with respect to the strapdown errors.
fn all_rows(view: &View) -> Square {
    let (velocity, angles) = rows(view);
    let mut all = Square::zeros();
    all.fixed_view_mut::<3, 3>(0, 0).copy_from(&view.c_ne);
    all.fixed_rows_mut::<3>(3).copy_from(&velocity);
    all.fixed_rows_mut::<3>(6).copy_from(&angles);
    all
}

/// Derivatives of NED velocity and of the Euler angles with respect to the strapdown errors.
fn rows(view: &View) -> (Rows, Rows) {
    let turn = axes_turn(&view.geodetic) * view.c_ne;
    let jacobian = view.attitude().jacobian_of_ned_rotation();
    let mut velocity = Rows::zeros();
    velocity.fixed_columns_mut::<3>(0).copy_from(&(skew(&view.v_n()) * turn));
    velocity.fixed_columns_mut::<3>(3).copy_from(&view.c_ne);
    let mut angles = Rows::zeros();
    angles.fixed_columns_mut::<3>(0).copy_from(&(-jacobian * turn));
    angles.fixed_columns_mut::<3>(6).copy_from(&(jacobian * view.c_ne));
    (velocity, angles)
}

/// Turn of the NED axes by a displacement in NED axes, rad/m.
#[must_use]
pub fn axes_turn(place: &Geodetic) -> Matrix3<f64> {
    let (meridian, prime) = earth::radii(place.latitude);
    let north = 1.0 / (meridian + place.height);
    let east = 1.0 / (prime + place.height);
    let convergence = east * place.latitude.tan();
    Matrix3::new(0.0, east, 0.0, -north, 0.0, 0.0, 0.0, -convergence, 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nominal::Nominal;
    use insd_base::Attitude;
    use insd_base::units::wrap_pi;

    #[test]
    fn velocity_and_heading_near_the_pole_share_the_position_error() {
        let attitude = Attitude { roll: 0.1, pitch: -0.05, heading: 1.0 };
        let place = Geodetic::from_degrees(89.99, 40.0, 10.0);
        let nominal = Nominal::at(&place, &Vector3::new(5.0, 2.0, 0.1), &attitude.c_nb());
        let view_of = |nominal: &Nominal| View::new(nominal, &Vector3::zeros(), 0.0);
        let (velocity, angles) = rows(&view_of(&nominal));
        for state in 0..STRAPDOWN_STATES {
            let step = if state < 3 { 0.1 } else { 1e-5 };
            let moved = |amount: f64| {
                let mut error = Errors::none();
                let block = [POSITION, VELOCITY, ATTITUDE][state / 3];
                error.set(block, &(Vector3::ith(state % 3, amount)));
                let mut moved = nominal;
                moved.inject(&error);
                view_of(&moved)
            };
            let (ahead, behind) = (moved(step), moved(-step));
            let by_velocity = (ahead.v_n() - behind.v_n()) / (2.0 * step);
            assert!((by_velocity - velocity.column(state)).norm() < 1e-5, "state {state}");
            let (a, b) = (ahead.attitude(), behind.attitude());
            let change =
                Vector3::new(a.roll - b.roll, a.pitch - b.pitch, wrap_pi(a.heading - b.heading))
                    / (2.0 * step);
            assert!((change - angles.column(state)).norm() < 1e-5, "state {state}");
        }
    }
}
