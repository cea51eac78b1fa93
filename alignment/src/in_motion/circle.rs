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
use nalgebra::{Matrix2, Rotation2, Vector2};

/// Angles at which the density is summed.
const GRID: usize = 90;
/// Sigma below which the density is taken as normal about its peak, rad.
const NARROW: f64 = 0.15;
/// 1-sigma of an angle of which nothing is known, rad: TAU / sqrt(12).
pub const UNKNOWN: f64 = 1.813_799_364_234_218;

/// Mean and 1-sigma of the angle, rad, from mean and covariance of (cos, sin).
#[must_use]
pub fn angle(mean: &Vector2<f64>, covariance: &Matrix2<f64>) -> (f64, f64) {
    let Some(information) = information(mean, covariance) else {
        return (mean.y.atan2(mean.x), UNKNOWN);
    };
    let (first, spread) = spread(&density(mean, &information));
    if spread > NARROW { (first, spread) } else { peak(mean, &information, first) }
}

/// Mean and covariance of (cos, sin) on the circle, from those in the plane; those of a narrow density by the
/// moments of the wrapped normal distribution (Mardia and Jupp, section 3.5.7).
#[must_use]
pub fn point(mean: &Vector2<f64>, covariance: &Matrix2<f64>) -> (Vector2<f64>, Matrix2<f64>) {
    let Some(information) = information(mean, covariance) else {
        return (Vector2::zeros(), Matrix2::from_diagonal_element(0.5));
    };
    let density = density(mean, &information);
    let (first, spread) = spread(&density);
    if spread > NARROW {
        let centre: Vector2<f64> = (0..GRID).map(|i| direction(at(i)) * density[i]).sum();
        let off = |i: usize| direction(at(i)) - centre;
        return (centre, (0..GRID).map(|i| off(i) * off(i).transpose() * density[i]).sum());
    }
    let (angle, sigma) = peak(mean, &information, first);
    let length = (-0.5 * sigma * sigma).exp();
    let square = length * length;
    let turn = Rotation2::new(angle).into_inner();
    let spread = Vector2::new((1.0 - square).powi(2), 1.0 - square * square) * 0.5;
    (direction(angle) * length, turn * Matrix2::from_diagonal(&spread) * turn.transpose())
}

/// What is known of the point, with what the regression has lost in length.
fn information(mean: &Vector2<f64>, covariance: &Matrix2<f64>) -> Option<Matrix2<f64>> {
    let guarded = covariance + Matrix2::from_diagonal_element(1e-12);
    guarded.try_inverse().map(|inverse| inverse * mean.norm().min(1.0))
}

fn direction(angle: f64) -> Vector2<f64> {
    Vector2::new(angle.cos(), angle.sin())
}

fn at(i: usize) -> f64 {
    TAU * i as f64 / GRID as f64
}

/// The density on the circle, summing to one.
fn density(mean: &Vector2<f64>, information: &Matrix2<f64>) -> [f64; GRID] {
    let log_density: [f64; GRID] = std::array::from_fn(|i| {
        let off = direction(at(i)) - mean;
        -0.5 * off.dot(&(information * off))
    });
    let best = log_density.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let density = log_density.map(|log| (log - best).exp());
    let total: f64 = density.iter().sum();
    density.map(|it| it / total)
}

/// Circular mean and root mean square about it, by sums over the circle.
fn spread(density: &[f64; GRID]) -> (f64, f64) {
    let centre: Vector2<f64> = (0..GRID).map(|i| direction(at(i)) * density[i]).sum();
    let middle = centre.y.atan2(centre.x);
    let square: f64 = (0..GRID).map(|i| wrap_pi(at(i) - middle).powi(2) * density[i]).sum();
    (wrap_pi(middle), square.sqrt())
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

    /// What is known in the plane of a point that lies on the circle is known there as well.
    #[test]
    fn the_point_has_the_length_of_one_however_well_it_is_known() {
        for spread in [0.001_f64, 0.05, 0.14, 0.2, 0.6, 10.0] {
            let covariance = Matrix2::from_diagonal_element(spread * spread);
            let (mean, covariance) = point(&(direction(2.0) * 0.9), &covariance);
            assert!((mean.norm_squared() + covariance.trace() - 1.0).abs() < 1e-9, "{spread}");
            assert!((mean.y.atan2(mean.x) - 2.0).abs() < 0.01, "{mean}");
        }
        let (mean, covariance) = point(&Vector2::zeros(), &Matrix2::from_diagonal_element(0.5));
        assert!(mean.norm() < 1e-9 && (covariance - Matrix2::identity() * 0.5).amax() < 1e-9);
    }

    #[test]
    fn a_mean_that_has_shrunk_gives_the_same_angle_and_a_greater_sigma() {
        let covariance = Matrix2::identity() * 0.02_f64.powi(2);
        let (found, sigma) = angle(&(direction(1.0) * 0.4), &covariance);
        assert!((found - 1.0).abs() < 1e-6);
        assert!((sigma - 0.02 / 0.4).abs() < 1e-3, "{sigma}");
    }
}
