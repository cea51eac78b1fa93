//! What errors do to the estimate, and which lie between two.

use insd_base::{Geodetic, earth};
use nalgebra::{Matrix3, Rotation2, UnitQuaternion, Vector2, Vector3};

use crate::error_state::{ATTITUDE, DECLARATIONS, Errors, POSITION, declaration, no_errors};
use crate::nominal::Nominal;

impl Nominal {
    /// Whether it can be a ship's: numbers only, on the Earth, a rotation that is one.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        let far = (self.position.norm() / earth::SEMI_MAJOR - 1.0).abs();
        let rotation = (self.attitude.as_ref().norm() - 1.0).abs();
        let none = Nominal { attitude: UnitQuaternion::identity(), ..*self };
        let zero = Nominal::at(
            &Geodetic::from_degrees(0.0, 0.0, 0.0),
            &Vector3::zeros(),
            &Matrix3::identity(),
        );
        far < 0.01 && rotation < 1e-6 && zero.error_to(&none).values().iter().all(|x| x.is_finite())
    }

    /// Moves the estimate by an error vector: estimated + error = true. The swaying of a moored ship
    /// is held in the axes of the computed heading and turns with it ([`crate::aids::berth`]).
    pub fn inject(&mut self, error: &Errors) {
        let rotation = error.of(ATTITUDE);
        self.attitude = UnitQuaternion::new(rotation) * self.attitude;
        self.position += error.of(POSITION);
        let turn = turn_about_down(&rotation, &self.position);
        for place in error.layout().places().iter().filter(|place| place.key != POSITION.key()) {
            let Some(declared) = declaration(place.key) else { continue };
            let value = declared.value(self);
            if declared.turns_with_heading() {
                turn_pairs(&turn, value);
            }
            let own = &error.values().as_slice()[place.start..place.start + place.width];
            value.iter_mut().zip(own).for_each(|(value, error)| *value += error);
        }
    }

    /// The error vector that moves this estimate onto another: the inverse of [`Self::inject`]. It has all states that there may
    /// be.
    #[must_use]
    pub fn error_to(&self, other: &Nominal) -> Errors {
        let mut error = no_errors();
        let rotation = (other.attitude * self.attitude.inverse()).scaled_axis();
        let turn = turn_about_down(&rotation, &other.position);
        let (mut here, mut there) = (*self, *other);
        for declared in &DECLARATIONS {
            let own = declared.value(&mut here);
            if declared.turns_with_heading() {
                turn_pairs(&turn, own);
            }
            let difference = declared.value(&mut there).iter_mut().zip(own).map(|(a, b)| *a - *b);
            error.fill(declared.key, difference);
        }
        error.set(ATTITUDE, &rotation);
        error
    }
}

/// The part of a small rotation, ECEF axes, that turns the horizontal axes at a place.
///
/// Down is minus the normal of the ellipsoid, which is along (x/a^2, y/a^2, z/b^2).
fn turn_about_down(rotation: &Vector3<f64>, place: &Vector3<f64>) -> Rotation2<f64> {
    let flat = 1.0 - earth::ECCENTRICITY_SQ;
    let up = Vector3::new(place.x, place.y, place.z / flat).normalize();
    Rotation2::new(-rotation.dot(&up))
}

/// Turns pairs of north and east.
fn turn_pairs(turn: &Rotation2<f64>, pairs: &mut [f64]) {
    for pair in pairs.chunks_exact_mut(2) {
        let turned = turn * Vector2::new(pair[0], pair[1]);
        pair.copy_from_slice(turned.as_slice());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error_state::all_states;
    use approx::assert_relative_eq;

    #[test]
    fn injecting_the_error_to_another_estimate_reaches_it() {
        let here = Geodetic::from_degrees(35.0, 139.0, 10.0);
        let start = Nominal::at(&here, &Vector3::new(1.0, 2.0, 0.1), &Matrix3::identity());
        let mut error = Errors::zeros(&all_states());
        let count = all_states().states() as f64;
        for (i, place) in all_states().places().iter().enumerate() {
            let own = |k: usize| 1e-3 * ((i + k) as f64 + 1.0) / count;
            error.fill(place.key, (0..place.width).map(own));
        }
        let mut moved = start;
        moved.inject(&error);
        assert_relative_eq!(start.error_to(&moved).values(), error.values(), epsilon = 1e-9);
    }
}
