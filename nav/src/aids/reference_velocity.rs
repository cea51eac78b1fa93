//! Horizontal velocity over the Earth from an external reference, at the IMU.
//!
//! z = v_ref - C_ne v, north and east. Held by
//! `every_measurement_matrix_agrees_with_perturbed_predictions`.

use nalgebra::{Matrix2, SMatrix, Vector2};

use super::View;
use crate::error_state::VELOCITY;
use crate::innovation::Innovation;

/// Innovation of a velocity north and east with sigma `std` of each component, m/s.
#[must_use]
pub fn innovation(view: &View, v_ne: &Vector2<f64>, std: f64) -> Innovation<2> {
    let to_north_east = view.c_ne.fixed_rows::<2>(0).into_owned();
    let mut h = SMatrix::zeros();
    VELOCITY.set_columns(&mut h, &to_north_east);
    Innovation {
        z: v_ne - to_north_east * view.nominal.velocity,
        h,
        r: Matrix2::identity() * (std * std),
    }
}
