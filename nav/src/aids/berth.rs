//! The berth: a moored ship is where she is tied, and surges and sways about it.
//!
//! p = p_berth + x with the displacement x a state (first-order Gauss-Markov with the spread that the
//! reference states), because consecutive positions of a ship on her moorings are anything but
//! independent:
//!
//! z = p_berth + x - p = dp - dx, north and east, with the survey of the berth as noise.
//! Held by `every_measurement_matrix_agrees_with_perturbed_predictions`.

use insd_base::Geodetic;
use nalgebra::{Matrix2, SMatrix};

use super::{View, reference_position};
use crate::error_state::BERTH_OFFSET;
use crate::innovation::Innovation;

/// Innovation of a berth whose own position is known to `std` of each component, m.
#[must_use]
pub fn innovation(view: &View, berth: &Geodetic, std: f64) -> Innovation<2> {
    let here = reference_position::innovation(view, berth, std);
    let mut h: SMatrix<f64, 2, _> = here.h;
    BERTH_OFFSET.set_columns(&mut h, &-Matrix2::identity());
    Innovation { z: here.z + view.nominal.berth_offset, h, r: here.r }
}
