//! Gates: the chi-square innovation test and the DOP test (5) of JAE's hybrid navigation.

use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::config::GateModel;

/// Chi-square gates for innovations of one to three components.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChiSquareGate {
    limits: [f64; 3],
}

impl ChiSquareGate {
    /// A gate that lets good measurements pass with this probability.
    #[must_use]
    pub fn new(probability: f64) -> Self {
        let limit = |freedom: f64| {
            ChiSquared::new(freedom).map_or(f64::INFINITY, |d| d.inverse_cdf(probability))
        };
        ChiSquareGate { limits: [limit(1.0), limit(2.0), limit(3.0)] }
    }

    /// Greatest normalised innovation squared that passes, for M = 1..3 components.
    #[must_use]
    pub fn limit<const M: usize>(&self) -> f64 {
        self.limits[M.clamp(1, 3) - 1]
    }
}

/// Largest horizontal innovation of a GNSS position that is still used, m:
///
/// dP = dP_INS + dP_GNSS * DOP   (systems.md (5), JAE)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_agree_with_tables() {
        let gate = ChiSquareGate::new(0.999);
        assert!((gate.limit::<1>() - 10.828).abs() < 0.01);
        assert!((gate.limit::<2>() - 13.816).abs() < 0.01);
        assert!((gate.limit::<3>() - 16.266).abs() < 0.01);
    }
}
