//! Horizontal position from an external reference, at the IMU: a berth, a transponder, a manual fix.
//!
//! z = C_ne (r_ref - r), north and east. Held by
//! `every_measurement_matrix_agrees_with_perturbed_predictions`.

use insd_base::{Geodetic, earth};
use nalgebra::Matrix2;

use super::View;
use crate::error_state::{Innovation, Jacobian, POSITION};

/// Innovation of a horizontal position with sigma `std` of each component, m.
#[must_use]
pub fn innovation(view: &View, position: &Geodetic, std: f64) -> Innovation {
    let level = Geodetic { height: view.geodetic.height, ..*position };
    let to_north_east = view.c_ne.fixed_rows::<2>(0).into_owned();
    let mut h = Jacobian::none(2);
    h.set(POSITION, &to_north_east);
    let z = to_north_east * (earth::ecef(&level).0 - view.nominal.position);
    Innovation::new(&z, h, &Matrix2::from_diagonal_element(std * std))
}
