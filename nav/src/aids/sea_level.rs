//! Mean sea level: a ship's height is the sea's plus heave.
//!
//! z = 0 - (h - h_sea) = dh - dh_sea + heave. The mean height is a state, so that a height learnt
//! from GNSS goes on holding the vertical channel without it, with the uncertainty it was learnt
//! with. Heave is narrow-band: samples must be spaced by more than a wave.
//! Held by `every_measurement_matrix_agrees_with_perturbed_predictions`.

use nalgebra::{SMatrix, Vector1};

use super::View;
use crate::error_state::{POSITION, SEA_LEVEL};
use crate::innovation::Innovation;

/// Innovation of the height against the mean height, heave sigma `std`, m.
#[must_use]
pub fn innovation(view: &View, std: f64) -> Innovation<1> {
    let up = -view.c_ne.fixed_rows::<1>(2);
    let mut h = SMatrix::zeros();
    POSITION.set_columns(&mut h, &up);
    SEA_LEVEL.set_columns(&mut h, &Vector1::new(-1.0));
    Innovation {
        z: Vector1::new(view.nominal.sea_level - view.geodetic.height),
        h,
        r: Vector1::new(std * std),
    }
}
