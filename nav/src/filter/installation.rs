//! What is made of the installation.

use nalgebra::Vector3;

use crate::separate_bias::SeparateBias;
use insd_base::SolutionSigma;

/// What is made of the installation.
#[derive(Clone, Debug, Default)]
pub(super) struct Installation {
    /// What wrong constants of it would do, while the filter navigates.
    pub(super) bias: Option<SeparateBias>,
    /// Whether they told that the antenna sits elsewhere, or speaks late.
    pub(super) is_mended: bool,
    /// Whether they told of what no ship has.
    pub(super) is_impossible: bool,
    /// 1-sigma of the lever arm of the log, m, if it was found to be otherwise than configured.
    pub(super) log_lever_std: Option<Vector3<f64>>,
    /// What the solution may be off by because a constant is wrong, which is too unsure to be mended, and how likely that is.
    pub(super) doubt: Option<(f64, SolutionSigma)>,
}
