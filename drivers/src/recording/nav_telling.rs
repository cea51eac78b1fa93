//! A solution as a row of `nav.csv`, with the satellites behind it.

use insd_base::{Ned, SatelliteId, SatelliteInnovation, Solution, SolutionSigma};

use super::nav_row::NavRow;
use super::nav_satellites::NavSatellites;

/// Claimed where a standard deviation is not finite or larger, in the unit of the column.
pub(super) const MAX_SIGMA: f64 = 1e6;

/// Makes rows of solutions; between them it is told what satellites do.
#[derive(Debug, Default)]
pub struct NavTelling {
    satellites: NavSatellites,
    left_out: u64,
}

impl NavTelling {
    /// The row of a solution. One that is not finite is left out and counted.
    pub fn row(&mut self, solution: &Solution) -> Option<NavRow> {
        if !is_finite(solution) {
            self.left_out += 1;
            return None;
        }
        let levels = solution.protection();
        Some(NavRow {
            solution: Solution { sigma: claimed(&solution.sigma), ..*solution },
            horizontal_level: Some(known(levels.horizontal)),
            vertical_level: Some(known(levels.vertical)),
            integrity: Some(solution.availability()),
            excluded: self.excluded(solution),
            satellites: self.satellites.used(solution.time).and_then(|used| used.try_into().ok()),
        })
    }

    /// A satellite is left out of the solutions from now on, or used again: the rows name it.
    pub fn leave_out(&mut self, satellite: SatelliteId, is_excluded: bool) {
        self.satellites.leave_out(satellite, is_excluded);
    }

    /// Takes note of what a satellite told: the rows say of how many the ranges are in use.
    pub fn hear_satellite(&mut self, told: &SatelliteInnovation) {
        self.satellites.hear(told);
    }

    /// Solutions that were left out because they were not finite.
    #[must_use]
    pub fn left_out(&self) -> u64 {
        self.left_out
    }

    fn excluded(&self, solution: &Solution) -> Vec<String> {
        let parties = solution.judgement.excluded.iter().map(|party| party.as_str().to_owned());
        parties.chain(self.satellites.excluded().map(SatelliteId::to_string)).collect()
    }
}

/// A NaN or infinite claim is one of knowing nothing, in m or m/s.
fn known(sigma: f64) -> f64 {
    if sigma.is_finite() { sigma } else { MAX_SIGMA }
}

fn claimed(sigma: &SolutionSigma) -> SolutionSigma {
    let angle = |sigma: f64| if sigma.is_finite() { sigma } else { MAX_SIGMA.to_radians() };
    SolutionSigma {
        position: Ned(sigma.position.0.map(known)),
        velocity: Ned(sigma.velocity.0.map(known)),
        roll: angle(sigma.roll),
        pitch: angle(sigma.pitch),
        heading: angle(sigma.heading),
    }
}

fn is_finite(solution: &Solution) -> bool {
    let (position, attitude) = (&solution.position, &solution.attitude);
    let Ned(velocity) = &solution.velocity;
    let angles = [position.latitude, position.longitude, attitude.roll, attitude.pitch];
    angles.iter().chain(velocity).all(|value| value.is_finite())
        && position.height.is_finite()
        && attitude.heading.is_finite()
}
