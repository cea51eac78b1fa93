//! Position from the codes of one epoch: the fallback, the start of everything else, and a check on the receiver's own word.

mod candidates;
mod equations;
mod witness;

use insd_base::{Constellation, GpsTime, SatelliteEpoch};
use nalgebra::{Matrix3, Vector3};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::budget::LOWEST;
use crate::context::Context;
use crate::least_squares::FALSE_ALARM;
use candidates::Candidate;
use equations::{Equations, Solution};

pub use witness::{NoPosition, Verdict, Witness};

/// A position from one epoch.
#[derive(Clone, Debug, PartialEq)]
pub struct SinglePoint {
    /// The receiver's tag.
    pub tag: GpsTime,
    /// The antenna, ECEF, m.
    pub position: Vector3<f64>,
    /// Its covariance, m^2.
    pub covariance: Matrix3<f64>,
    /// The receiver's clock ahead of each system's time, m.
    pub clocks: Vec<(Constellation, f64)>,
    /// Every satellite of the epoch.
    pub satellites: Vec<Witness>,
    /// Sum of the weighed squares of the residuals, and its degrees of freedom.
    pub chi_square: (f64, usize),
}

impl SinglePoint {
    /// The antenna at an epoch. `near`: where it may be, ECEF, m; it need not be right.
    ///
    /// Weighed least squares over all constellations and bands. Unknowns beside the antenna: a clock for each constellation (QZSS keeps GPS time), a
    /// receiver delay for each further band, and how far the ionosphere is from its model, as a whole and on each ray; so that one band rests on the
    /// model and two bands take its place, by what each is worth. One satellite after the other is left out while the worst contradicts the others
    /// (Baarda's data snooping; Groves, 2nd ed., 17.4.1).
    ///
    /// # Errors
    /// Why there is no position.
    pub fn solve(
        context: &Context,
        epoch: &SatelliteEpoch,
        near: Option<Vector3<f64>>,
    ) -> Result<Self, NoPosition> {
        let (mut candidates, mut refused) = candidates::of(context, epoch);
        let mut position = near.unwrap_or_else(Vector3::zeros);
        let mut excluded = Vec::new();
        loop {
            let solution =
                converge(context, epoch.tag, &mut candidates, &mut position, &mut refused)?;
            match worst(&candidates, &solution) {
                None => {
                    refused.extend(excluded);
                    return Ok(Self::told(epoch.tag, &candidates, &solution, refused));
                }
                Some(index) if solution.redundancy() > 1 => {
                    let witness = solution.witness(&candidates, index);
                    excluded.push(Witness { verdict: Verdict::Faulty, ..witness });
                    candidates.remove(index);
                }
                Some(_) => return Err(NoPosition::Contradiction),
            }
        }
    }

    fn told(
        tag: GpsTime,
        candidates: &[Candidate],
        solution: &Solution,
        refused: Vec<Witness>,
    ) -> Self {
        let used = (0..candidates.len()).map(|index| solution.witness(candidates, index));
        let mut satellites: Vec<Witness> = used.chain(refused).collect();
        satellites.sort_by_key(|witness| witness.satellite);
        // no better than the residuals say; their scatter may be luck to a point, so never better than the model
        let factor = (solution.chi_square / solution.redundancy().max(1) as f64).max(1.0);
        Self {
            tag,
            position: solution.position,
            covariance: solution.position_covariance() * factor,
            clocks: solution.clocks.clone(),
            satellites,
            chi_square: (solution.chi_square, solution.redundancy()),
        }
    }

    /// Those in use.
    pub fn used(&self) -> impl Iterator<Item = &Witness> {
        self.satellites.iter().filter(|witness| witness.verdict == Verdict::Used)
    }
}

/// Newton's steps until the position stands; satellites that turn out to be too low go to `refused`.
fn converge(
    context: &Context,
    tag: GpsTime,
    candidates: &mut Vec<Candidate>,
    position: &mut Vector3<f64>,
    refused: &mut Vec<Witness>,
) -> Result<Solution, NoPosition> {
    const ROUNDS: usize = 12;
    const STANDS: f64 = 1e-4;
    const NEAR_EARTH: std::ops::Range<f64> = 6.3e6..6.5e6;
    // elevations count when they no longer change
    const NEAR: f64 = 1e4;
    let mut step = f64::INFINITY;
    for _ in 0..ROUNDS {
        let on_earth = step < NEAR && NEAR_EARTH.contains(&position.norm());
        if on_earth {
            drop_low(candidates, position, refused);
        }
        let solution = Equations::new(context, tag, candidates, position, on_earth).solve()?;
        step = (solution.position - *position).norm();
        *position = solution.position;
        if on_earth && step < STANDS {
            return Ok(solution);
        }
    }
    Err(if NEAR_EARTH.contains(&position.norm()) {
        NoPosition::Geometry
    } else {
        NoPosition::NotOnEarth
    })
}

fn drop_low(candidates: &mut Vec<Candidate>, position: &Vector3<f64>, refused: &mut Vec<Witness>) {
    candidates.retain(|candidate| {
        let direction = candidate.sight.direction(position);
        let high = direction.elevation >= LOWEST;
        if !high {
            refused.push(Witness {
                direction: Some(direction),
                ..Witness::refused(candidate.satellite, Verdict::Low)
            });
        }
        high
    });
}

/// The satellite that contradicts the others most, if one does.
fn worst(candidates: &[Candidate], solution: &Solution) -> Option<usize> {
    let surprise = |index: usize| {
        let (distance, freedom) = solution.distance(index)?;
        let law = ChiSquared::new(freedom as f64).ok()?;
        Some(law.sf(distance))
    };
    (0..candidates.len())
        .filter_map(|index| Some((index, surprise(index)?)))
        .filter(|(_, chance)| *chance < FALSE_ALARM)
        .min_by(|(_, a), (_, b)| a.total_cmp(b))
        .map(|(index, _)| index)
}
