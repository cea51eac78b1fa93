//! When one run was aligned, in truth and by its claim.

use insd_base::units::DEG;
use serde::{Deserialize, Serialize};

use super::component::Component;
use super::errors::EpochError;

/// Claims of this and that 1-sigma are the first that a ship can be conned and steered by, rad.
const FIRST_CLAIMS: [f64; 2] = [2.0 * DEG, 1.0 * DEG];

/// When one run was aligned, s; `None` if it never was.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RunAlignment {
    /// From when on the error of the heading stays below the bar.
    pub error: Option<f64>,
    /// When the claimed sigma first is below it.
    pub claim: Option<f64>,
    /// When it first is below 2 and below 1 deg.
    pub first: [Option<f64>; 2],
}

/// When a run was aligned within `bar`, rad. An epoch at which truth does not know the heading is
/// passed over.
#[must_use]
pub fn alignment(epochs: &[EpochError], bar: f64) -> RunAlignment {
    let known = || epochs.iter().filter_map(|e| Some((e, e.of(Component::Heading)?.abs())));
    let last_bad = known().filter(|(_, error)| *error >= bar).map(|(e, _)| e.time).next_back();
    let good = |e: &EpochError| last_bad.is_none_or(|bad| e.time > bad);
    let claimed = |bar: f64| {
        let is_below = |e: &&EpochError| e.sigma_of(Component::Heading) < bar;
        epochs.iter().find(is_below).map(|e| e.time.as_seconds())
    };
    RunAlignment {
        error: known().find(|(e, _)| good(e)).map(|(e, _)| e.time.as_seconds()),
        claim: claimed(bar),
        first: FIRST_CLAIMS.map(claimed),
    }
}
