//! The heading that several antennas tell, for who does not follow their phases: a filter without ranges, and its judge.
//!
//! z = psi_told - psi - offset - sqrt(s) sigma x, wrapped; the offset is how the antennas sit otherwise than configured, x what is reflected, which goes on for
//! minutes, of a share s as in [`super::antenna_phases`]. Held by `every_measurement_matrix_agrees_with_perturbed_predictions`.

use insd_base::units::wrap_pi;
use nalgebra::{Matrix1, Vector1};

use super::View;
use super::antenna_phases::{REFLECTED, WHITE};
use crate::error_state::{
    ANTENNA_HEADING_ERROR, ANTENNA_HEADING_OFFSET, ATTITUDE, Innovation, Jacobian,
};

/// Innovation of a heading with sigma `std` as the phases have it, both rad.
#[must_use]
pub fn innovation(view: &View, heading: f64, std: f64) -> Innovation {
    let slow = REFLECTED.sqrt() * std;
    let attitude = view.attitude();
    let row = attitude.jacobian_of_ned_rotation().fixed_rows::<1>(2) * view.c_ne;
    let mut h = Jacobian::none(1);
    h.set(ATTITUDE, &row);
    h.set(ANTENNA_HEADING_ERROR, &Matrix1::new(slow));
    h.set(ANTENNA_HEADING_OFFSET, &Matrix1::new(1.0));
    let nominal = &view.nominal;
    let off = nominal.antenna_heading_offset + slow * nominal.antenna_heading_error;
    let z = Vector1::new(wrap_pi(heading - attitude.heading - off));
    Innovation::new(&z, h, &Vector1::new(WHITE * std * std))
}
