//! What a navigation filter takes of an epoch.

use insd_base::{SatelliteId, SignalCode};
use nalgebra::{DMatrix, DVector};

use super::line::LineBias;

/// Differences between antennas, linear in what the assumed attitude and line biases are off by:
/// `residual = attitude . psi + lines . (true - assumed biases) + error`, psi as in `C = (I - [psi x]) C_assumed`.
///
/// Each row is the phase of an antenna less that of the first antenna that has the signal; rows of one signal share that phase, and the covariance has it.
#[derive(Clone, Debug, PartialEq)]
pub struct CompassRows {
    /// Measured less computed, integers taken out, m.
    pub residuals: DVector<f64>,
    /// Three columns: `(C b x e)'` in ECEF axes, m; of a baseline `-e'`, for the error of the vector.
    pub attitude: DMatrix<f64>,
    /// Which line biases the columns of [`Self::lines`] belong to.
    pub biases: Vec<LineBias>,
    /// What was assumed of them, m.
    pub assumed: DVector<f64>,
    /// How rows depend on them: 1, -1 or 0.
    pub lines: DMatrix<f64>,
    /// Covariance of their errors, m^2.
    pub covariance: DMatrix<f64>,
    /// Whose difference each row is: satellite, signal, antenna and the one that it is held against.
    pub of: Vec<(SatelliteId, SignalCode, usize, usize)>,
}
