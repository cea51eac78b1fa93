//! How far an antenna has moved between two epochs, from phase alone.

use insd_base::SatelliteId;
use nalgebra::{Matrix3, RowVector4, Vector3};

use super::change::PhaseChange;
use crate::least_squares::{Observation, Solved, solve};

/// No slip is smaller, m: half a cycle on L1 is 95 mm, of which a part goes into the solution.
const SLIP: f64 = 0.05;

/// A displacement between two epochs.
#[derive(Clone, Debug, PartialEq)]
pub struct CarrierDisplacement {
    /// Of the antenna, ECEF, m.
    pub displacement: Vector3<f64>,
    /// Its covariance, m^2.
    pub covariance: Matrix3<f64>,
    /// Change of the receiver's clock, m.
    pub clock: f64,
    /// Satellites used.
    pub used: Vec<SatelliteId>,
    /// Satellites whose phase slipped without a word.
    pub slipped: Vec<SatelliteId>,
    /// What each of them leaves, by the 1-sigma of its change.
    pub residuals: Vec<f64>,
}

impl CarrierDisplacement {
    /// By least squares, from where the antenna was at the epoch before, ECEF, m. Nothing is made linear but the last metres: ranges are of the
    /// very points (gnss.md, eq. 13 and what follows). `None` where fewer than four phases were kept, or they contradict one another.
    #[must_use]
    pub fn solve(changes: &[PhaseChange], before: &Vector3<f64>) -> Option<Self> {
        let mut changes = changes.to_vec();
        let mut slipped = Vec::new();
        loop {
            let (displacement, solved, observations) = converge(&changes, before)?;
            let Some(worst) = solved.worst(&observations, SLIP) else {
                return Some(Self {
                    displacement,
                    covariance: solved.covariance.fixed_view::<3, 3>(0, 0).into(),
                    clock: solved.unknowns[3],
                    used: changes.iter().map(|change| change.satellite).collect(),
                    slipped,
                    residuals: residuals(&solved, &observations),
                });
            };
            if changes.len() < 6 {
                return None;
            }
            slipped.push(changes.remove(worst).satellite);
        }
    }
}

fn residuals(solved: &Solved, observations: &[Observation]) -> Vec<f64> {
    let left = |own: &Observation| own.observed - own.row.transpose().dot(&solved.unknowns);
    observations.iter().map(|own| left(own) / own.variance.sqrt()).collect()
}

/// The displacement, and what the last step solved.
fn converge(
    changes: &[PhaseChange],
    before: &Vector3<f64>,
) -> Option<(Vector3<f64>, Solved, Vec<Observation>)> {
    const ROUNDS: usize = 6;
    let mut displacement = Vector3::zeros();
    for _ in 0..ROUNDS {
        let now = before + displacement;
        let observations: Vec<_> =
            changes.iter().map(|change| observation(change, before, &now)).collect();
        let solved = solve(&observations)?;
        let step = Vector3::new(solved.unknowns[0], solved.unknowns[1], solved.unknowns[2]);
        displacement += step;
        if step.norm() < 1e-6 {
            return Some((displacement, solved, observations));
        }
    }
    None
}

fn observation(change: &PhaseChange, before: &Vector3<f64>, now: &Vector3<f64>) -> Observation {
    let line = change.now.transmitter().line(now);
    Observation {
        row: RowVector4::new(-line.x, -line.y, -line.z, 1.0),
        observed: change.change
            - (change.now.transmitter().range(now) - change.before.transmitter().range(before)),
        variance: change.variance,
    }
}
