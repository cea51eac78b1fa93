//! The berth: a moored ship is where she is tied, and surges and sways about it.
//!
//! p = p_berth + o + x + w with her mean place o and her slow swaying x as states, because
//! consecutive positions of a ship on her moorings are anything but independent; what the waves add,
//! w, is noise for samples some seconds apart:
//!
//! z = p_berth + o + x - p, north and east.
//!
//! Motion and moorings look the same whichever way the axes are turned. Were o, x and w held along
//! true north and east, a heading error would seem to show in how the north and the east of the
//! computed swaying go together, and the filter would find a heading in the waves where none is. So
//! they are held in the axes of the computed heading: with d = p - p_berth,
//!
//! z = dp - dphi_D k x d - do - dx + w,   k the unit vector down,
//!
//! which no turn about the berth changes (an invariant error in the sense of Barrau and Bonnabel,
//! IEEE Trans. Automatic Control 62 (2017)).
//! Held by `every_measurement_matrix_agrees_with_perturbed_predictions`.

use insd_base::Geodetic;
use nalgebra::{Matrix2, SMatrix, Vector2};

use super::{View, reference_position};
use crate::error_state::{ATTITUDE, BERTH_OFFSET, Innovation, SWAY};

/// Innovation of a ship at her berth whose motion in the waves has sigma `std` of each component, m.
#[must_use]
pub fn innovation(view: &View, berth: &Geodetic, std: f64) -> Innovation {
    let mut innovation = reference_position::innovation(view, berth, std);
    let away = -Vector2::new(innovation.z[0], innovation.z[1]);
    let across = Vector2::new(away.y, -away.x);
    let of_sway = SMatrix::<f64, 2, 4>::from_fn(|i, j| f64::from(u8::from(j % 2 == i)));
    let h = &mut innovation.h;
    h.set(BERTH_OFFSET, &-Matrix2::identity());
    h.set(SWAY, &-of_sway);
    h.set(ATTITUDE, &(across * view.c_ne.row(2)));
    innovation.z += view.nominal.berth_offset + view.nominal.swaying();
    innovation
}
