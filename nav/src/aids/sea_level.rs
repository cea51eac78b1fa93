//! Mean sea level: a ship's mean height over some waves is the sea's.
//!
//! With the mean of the estimated height over a window of length T that ends now,
//!
//! z = h_sea - mean(h) = (dh - (T/2) dv_up) - dh_sea + mean heave,
//!
//! the error of the mean being that of the middle of the window.
//!
//! The sea level is a state, so that a height learnt from GNSS goes on holding the vertical channel
//! without it, with the uncertainty it was learnt with.
//! Held by `every_measurement_matrix_agrees_with_perturbed_predictions`.

use nalgebra::Vector1;

use super::View;
use crate::error_state::{Innovation, Jacobian, POSITION, SEA_LEVEL, VELOCITY};

/// Innovation of the mean height over the last `length` seconds against the sea level; `std` is the
/// 1-sigma of the heave's mean, m.
#[must_use]
pub fn innovation(view: &View, mean_height: f64, length: f64, std: f64) -> Innovation {
    let up = -view.c_ne.fixed_rows::<1>(2);
    let mut h = Jacobian::none(1);
    h.set(POSITION, &up);
    h.set(VELOCITY, &(up * (-0.5 * length)));
    h.set(SEA_LEVEL, &Vector1::new(-1.0));
    let z = Vector1::new(view.nominal.sea_level - mean_height);
    Innovation::new(&z, h, &Vector1::new(std * std))
}
