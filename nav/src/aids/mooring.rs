//! Zero velocity at the berth: the mean velocity of a moored ship is zero, her sway is the noise.
//!
//! z = 0 - v_NE = dv_NE + sway. The sway is narrow-band, not white, so that samples must be spaced
//! or their variance raised; blocks 28 and 43 of JP3375720B2 treat it better.
//! Held by `every_measurement_matrix_agrees_with_perturbed_predictions`.

use nalgebra::{Matrix2, SMatrix};

use super::View;
use crate::error_state::VELOCITY;
use crate::innovation::Innovation;

/// Innovation of zero mean velocity north and east with sway sigma `std`, m/s.
#[must_use]
pub fn innovation(view: &View, std: f64) -> Innovation<2> {
    let to_north_east = view.c_ne.fixed_rows::<2>(0).into_owned();
    let mut h = SMatrix::zeros();
    VELOCITY.set_columns(&mut h, &to_north_east);
    Innovation {
        z: -to_north_east * view.nominal.velocity,
        h,
        r: Matrix2::identity() * (std * std),
    }
}
