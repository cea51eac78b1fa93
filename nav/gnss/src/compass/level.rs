//! What is known of the level of a hull, held against a pose.

use nalgebra::Vector3;

use super::pose::CompassPose;
use super::prior::CompassPrior;
use super::solve::Outcome;

/// How far the hull is from the level that is known, in squares of sigmas; `None` where none is known.
pub(super) fn tilt(outcome: &Outcome, prior: &CompassPrior) -> Option<f64> {
    let CompassPose::Attitude(c_nb) = outcome.pose else { return None };
    let own = prior.attitude?;
    let level = own.std.x.max(own.std.y);
    // what is known of the heading is in the region that is searched
    let down = Vector3::z();
    let tilt = (own.c_nb.transpose() * down).angle(&(c_nb.transpose() * down));
    let drawn = outcome.covariance[(0, 0)] + outcome.covariance[(1, 1)];
    (level.is_finite() && drawn.is_finite()).then(|| tilt * tilt / (level * level + drawn))
}

/// Whether a hull may stand so: not far from the level that is known, and in no case upside down.
pub(super) fn is_possible(outcome: &Outcome, prior: &CompassPrior) -> bool {
    const FAR: f64 = 25.0;
    const STEEP: f64 = 0.1;
    let is_upright = match outcome.pose {
        CompassPose::Attitude(c_nb) => c_nb[(2, 2)] > STEEP,
        CompassPose::Baseline(_) => true,
    };
    is_upright && tilt(outcome, prior).is_none_or(|tilt| tilt < FAR)
}
