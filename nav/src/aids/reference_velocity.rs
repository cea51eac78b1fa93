//! Horizontal velocity over the Earth from an external reference, at the IMU.
//!
//! z = v_ref - C_ne v, north and east. Held by
//! `every_measurement_matrix_agrees_with_perturbed_predictions`.

use nalgebra::{Matrix2, Vector2};

use super::View;
use crate::error_state::{Innovation, Jacobian, VELOCITY};

/// Innovation of a velocity north and east with sigma `std` of each component, m/s.
#[must_use]
pub fn innovation(view: &View, v_ne: &Vector2<f64>, std: f64) -> Innovation {
    let to_north_east = view.c_ne.fixed_rows::<2>(0).into_owned();
    let mut h = Jacobian::none(2);
    h.set(VELOCITY, &to_north_east);
    let z = v_ne - to_north_east * view.nominal.velocity;
    Innovation::new(&z, h, &Matrix2::from_diagonal_element(std * std))
}
