//! From (sin, cos) back to an angle: s^2 + (1 - c)^2 = 1, used where it belongs, on output.
//!
//! The linear filter knows the point (cos dpsi, sin dpsi) as a normal distribution with mean m and
//! information L = P^-1 in the plane. The truth lies on the unit circle, so that the density of the
//! angle is that of the plane, restricted to the circle,
//!
//! log p(dpsi) = -1/2 (e - m)^T L (e - m) + const,   e = (cos dpsi, sin dpsi)
//!
//! (for P a multiple of the unit matrix the von Mises distribution: Mardia and Jupp, Directional
//! Statistics, section 3.5.4). Since the model is linear in e and the prior constant on the circle,
//! this would be the posterior itself, were the measured force without noise. On a calm straight course
//! the force *is* noise, correlated with nothing: the regression on it shrinks m towards zero (errors
//! in the variables) and yet claims information, as if a length of one had been excluded by chance.
//! What the regression lost in length it lost in knowledge: the information is multiplied by |m| where
//! that is less than one. Held by `a_straight_and_steady_course_tells_no_heading`; without the factor
//! the error there reaches six claimed sigmas. What the noise of the IMU is known to have done has been taken
//! out before ([`blur`](super::blur)); the factor is for what is left, above all a gyro bias beyond its data sheet.
//!
//! The constraint as a measurement inside the filter would have to be linearised about a heading that
//! nobody knows yet, and adds nothing: the radial error it removes is not one of angle.

use std::f64::consts::TAU;

use insd_base::units::wrap_pi;
use nalgebra::{Matrix2, Vector2};

/// Angles at which the density is summed.
const GRID: usize = 90;
/// Sigma below which the density is taken as normal about its peak, rad.
const NARROW: f64 = 0.15;
/// 1-sigma of an angle of which nothing is known, rad: TAU / sqrt(12).
pub const UNKNOWN: f64 = 1.813_799_364_234_218;

/// Mean and 1-sigma of the angle, rad, from mean and covariance of (cos, sin).
#[must_use]
pub fn angle(mean: &Vector2<f64>, covariance: &Matrix2<f64>) -> (f64, f64) {
    let guarded = covariance + Matrix2::from_diagonal_element(1e-12);
    let shrunk = mean.norm().min(1.0);
    let Some(information) = guarded.try_inverse().map(|inverse| inverse * shrunk) else {
        return (mean.y.atan2(mean.x), UNKNOWN);
    };
    let (first, spread) = summed(mean, &information);
    if spread > NARROW { (first, spread) } else { peak(mean, &information, first) }
}

fn direction(angle: f64) -> Vector2<f64> {
    Vector2::new(angle.cos(), angle.sin())
}

/// Circular mean and root mean square about it, by sums over the circle.
fn summed(mean: &Vector2<f64>, information: &Matrix2<f64>) -> (f64, f64) {
    let at = |i: usize| TAU * i as f64 / GRID as f64;
    let log_density: [f64; GRID] = std::array::from_fn(|i| {
        let off = direction(at(i)) - mean;
        -0.5 * off.dot(&(information * off))
    });
    let best = log_density.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let density = log_density.map(|log| (log - best).exp());
    let total: f64 = density.iter().sum();
    let centre: Vector2<f64> = (0..GRID).map(|i| direction(at(i)) * density[i]).sum();
    let middle = centre.y.atan2(centre.x);
    let square: f64 = (0..GRID).map(|i| wrap_pi(at(i) - middle).powi(2) * density[i]).sum();
    (wrap_pi(middle), (square / total).sqrt())
}

/// Peak of a narrow density and its curvature there, by Newton's method.
fn peak(mean: &Vector2<f64>, information: &Matrix2<f64>, start: f64) -> (f64, f64) {
    let mut angle = start;
    let mut curvature = 0.0;
    for _ in 0..6 {
        let on = direction(angle);
        let along = Vector2::new(-on.y, on.x);
        let pull = information * (on - mean);
        let stiff = along.dot(&(information * along));
        curvature = (stiff - on.dot(&pull)).max(0.1 * stiff);
        angle -= (along.dot(&pull) / curvature).clamp(-0.1, 0.1);
    }
    (wrap_pi(angle), curvature.max(1e-12).sqrt().recip())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_known_is_a_full_circle() {
        let (_, sigma) = angle(&Vector2::zeros(), &(Matrix2::identity() * 0.5));
        assert!((sigma - UNKNOWN).abs() < 0.01, "{sigma}");
    }

    #[test]
    fn a_narrow_density_has_the_sigma_of_its_tangent() {
        for degrees in [-179.0_f64, -60.0, 3.0, 100.0, 180.0] {
            let truth = degrees.to_radians();
            let covariance = Matrix2::identity() * 0.02_f64.powi(2);
            let (found, sigma) = angle(&direction(truth), &covariance);
            assert!(wrap_pi(found - truth).abs() < 1e-6);
            assert!((sigma - 0.02).abs() < 1e-3);
        }
    }

    #[test]
    fn a_mean_that_has_shrunk_gives_the_same_angle_and_a_greater_sigma() {
        let covariance = Matrix2::identity() * 0.02_f64.powi(2);
        let (found, sigma) = angle(&(direction(1.0) * 0.4), &covariance);
        assert!((found - 1.0).abs() < 1e-6);
        assert!((sigma - 0.02 / 0.4).abs() < 1e-3, "{sigma}");
    }
}
