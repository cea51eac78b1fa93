//! True heading from an external reference: gyrocompass, dual antenna.
//!
//! z = psi_ref - psi - sigma_slow x_slow, wrapped; d psi = (third row of the Euler Jacobian) C_ne phi. Held by
//! `every_measurement_matrix_agrees_with_perturbed_predictions`.
//!
//! Part of what a compass states as its sigma is an error that lasts: of speed and latitude, of a turn just made, of
//! multipath at the antennas. Taken as white, a mean over minutes would be known to hundredths of a degree, and a gyro whose
//! bias may wander would follow whatever the compass does. The share is small: what is larger is to be found out, and
//! a compass that drifts is told from one that wanders within minutes.

use insd_base::units::wrap_pi;
use nalgebra::{Matrix1, Vector1};

use super::View;
use crate::error_state::{ATTITUDE, HEADING_ERROR, Innovation, Jacobian};

/// Share of its variance that does.
const SHARE: f64 = 0.02;

/// Innovation of a true heading with sigma `std`, both rad.
#[must_use]
pub fn innovation(view: &View, heading: f64, std: f64) -> Innovation {
    let slow = SHARE.sqrt() * std;
    let attitude = view.attitude();
    let row = attitude.jacobian_of_ned_rotation().fixed_rows::<1>(2) * view.c_ne;
    let mut h = Jacobian::none(1);
    h.set(ATTITUDE, &row);
    h.set(HEADING_ERROR, &Matrix1::new(slow));
    let expected = attitude.heading + slow * view.nominal.heading_error;
    let z = Vector1::new(wrap_pi(heading - expected));
    Innovation::new(&z, h, &Vector1::new((1.0 - SHARE) * std * std))
}
