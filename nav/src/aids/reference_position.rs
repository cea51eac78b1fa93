//! Horizontal position from an external reference, at the IMU: a berth, a transponder, a manual fix, Loran.
//!
//! z = C_ne (r_ref - r) - s b, north and east, with what stays of its error, s b: s its sigma, b the state [`POSITION_ERROR`]. Held by
//! `every_measurement_matrix_agrees_with_perturbed_predictions`.

use insd_base::{Geodetic, earth};
use nalgebra::Matrix2;

use super::View;
use crate::error_state::{Innovation, Jacobian, POSITION, POSITION_ERROR};

/// Innovation of a horizontal position with sigma `std` of each component, m, and none of its error that stays.
#[must_use]
pub fn innovation(view: &View, position: &Geodetic, std: f64) -> Innovation {
    let level = Geodetic { height: view.geodetic.height, ..*position };
    let to_north_east = view.c_ne.fixed_rows::<2>(0).into_owned();
    let mut h = Jacobian::none(2);
    h.set(POSITION, &to_north_east);
    let z = to_north_east * (earth::ecef(&level).0 - view.nominal.position);
    Innovation::new(&z, h, &Matrix2::from_diagonal_element(std * std))
}

/// The same of one of which an error with the sigma `lasting`, m, stays besides.
#[must_use]
pub fn with_lasting_error(view: &View, position: &Geodetic, std: f64, lasting: f64) -> Innovation {
    let mut innovation = innovation(view, position, std);
    innovation.h.set(POSITION_ERROR, &Matrix2::from_diagonal_element(lasting));
    innovation.z -= lasting * view.nominal.position_error;
    innovation
}
