//! The DOP test (5) of JAE's hybrid navigation.

use crate::config::GateModel;

/// Largest horizontal innovation of a GNSS position that is still used, m:
///
/// dP = dP_INS + dP_GNSS * DOP   (docs/systems.md, eq. (5), JAE)
///
/// dP_INS is three sigma of the predicted position plus the growth since the last fix, dP_GNSS the
/// base error of the kind of solution.
#[must_use]
pub fn dop_limit(
    gate: &GateModel,
    rtk: bool,
    hdop: f64,
    predicted_std: f64,
    since_last_fix: f64,
) -> f64 {
    let base = if rtk { gate.rtk_base_error } else { gate.code_base_error };
    3.0 * predicted_std + gate.ins_growth * since_last_fix + base * hdop.max(1.0)
}
