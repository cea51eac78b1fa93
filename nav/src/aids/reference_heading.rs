//! True heading from an external reference: gyrocompass, dual antenna.
//!
//! z = psi_ref - psi, wrapped; d psi = (third row of the Euler Jacobian) C_ne phi. Held by
//! `every_measurement_matrix_agrees_with_perturbed_predictions`.

use insd_base::units::wrap_pi;
use nalgebra::{SMatrix, Vector1};

use super::View;
use crate::error_state::ATTITUDE;
use crate::innovation::Innovation;

/// Innovation of a true heading with sigma `std`, both rad.
#[must_use]
pub fn innovation(view: &View, heading: f64, std: f64) -> Innovation<1> {
    let attitude = view.attitude();
    let row = attitude.jacobian_of_ned_rotation().fixed_rows::<1>(2) * view.c_ne;
    let mut h = SMatrix::zeros();
    ATTITUDE.set_columns(&mut h, &row);
    Innovation {
        z: Vector1::new(wrap_pi(heading - attitude.heading)),
        h,
        r: Vector1::new(std * std),
    }
}
