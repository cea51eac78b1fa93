//! Where the antenna is, to the metres that the atmosphere and the elevations of satellites ask for.

use insd_base::{Ecef, earth};
use nalgebra::{Matrix3, Vector3};

use crate::single_point::SinglePoint;

/// How fast a ship goes, 1-sigma, m/s.
const SPEED: f64 = 30.0;
/// By what her height wanders, m per root of a second: by waves, locks and hills.
const CLIMB: f64 = 3.0;

/// A place with its covariance, ECEF, m and m^2.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) at: Vector3<f64>,
    pub(super) covariance: Matrix3<f64>,
}

impl Place {
    /// Where an epoch alone has it.
    pub(super) fn of(point: &SinglePoint) -> Self {
        Place { at: point.position, covariance: point.covariance }
    }

    /// The mean of this one of some seconds ago and of an epoch's, by what each is worth: four satellites that stand badly are kilometres off, and the
    /// air up there is thinner by decimetres.
    pub(super) fn then(&self, elapsed: f64, point: &SinglePoint) -> Self {
        let c_ne = earth::c_ne(&earth::geodetic(&Ecef(self.at)));
        let level = (SPEED * elapsed).powi(2);
        let moved = Vector3::new(level, level, CLIMB * CLIMB * elapsed.abs());
        let before = self.covariance + c_ne.transpose() * Matrix3::from_diagonal(&moved) * c_ne;
        let Some(inverse) = (before + point.covariance).try_inverse() else {
            return Place::of(point);
        };
        let gain = before * inverse;
        let at = self.at + gain * (point.position - self.at);
        let covariance = (Matrix3::identity() - gain) * before;
        Place { at, covariance: (covariance + covariance.transpose()) * 0.5 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(position: Vector3<f64>, down_std: f64) -> SinglePoint {
        let up = position.normalize();
        let covariance = Matrix3::identity() * 4.0 + up * up.transpose() * down_std.powi(2);
        SinglePoint {
            tag: insd_base::GpsTime::from_week(2300, 0),
            position,
            covariance,
            clocks: Vec::new(),
            satellites: Vec::new(),
            chi_square: (0.0, 0),
        }
    }

    #[test]
    fn four_satellites_that_stand_badly_do_not_lift_the_antenna() {
        let ground = Vector3::new(6_378_137.0, 0.0, 0.0);
        let known = Place::of(&point(ground, 3.0));
        let lifted = known.then(1.0, &point(ground * 1.0002, 2000.0));
        assert!((lifted.at - ground).x.abs() < 0.1, "{}", lifted.at - ground);
        // one that stands well is followed
        let climbed = Vector3::new(50.0, 0.0, 0.0);
        let mut place = known;
        for _ in 0..60 {
            place = place.then(1.0, &point(ground + climbed, 2.0));
        }
        assert!((place.at - ground - climbed).norm() < 0.1);
    }
}
