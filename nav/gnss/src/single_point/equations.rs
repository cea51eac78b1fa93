//! The linear equations of one epoch around a position, and what solves them.

use insd_base::frames::Ecef;
use insd_base::satellites::time_keeper;
use insd_base::{Constellation, GpsTime, earth};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::candidates::Candidate;
use super::witness::{NoPosition, Verdict, Witness};
use crate::budget::{BAND_DELAY, IONOSPHERE_RAY, IONOSPHERE_SCALE, orbit_std};
use crate::context::{Context, Delays};
use crate::least_squares::{Normal, Solved};

/// Observations of one satellite.
struct Rows {
    rows: DMatrix<f64>,
    observed: DVector<f64>,
    noise: DMatrix<f64>,
    weight: DMatrix<f64>,
}

/// All equations of an epoch.
pub(super) struct Equations {
    position: Vector3<f64>,
    clocks: Vec<Constellation>,
    satellites: Vec<Rows>,
    bands: Vec<(Constellation, u8)>,
}

impl Equations {
    /// Around a position. Far from the Earth's surface neither elevations nor the atmosphere are known, and all codes weigh alike.
    pub(super) fn new(
        context: &Context,
        tag: GpsTime,
        candidates: &[Candidate],
        position: &Vector3<f64>,
        on_earth: bool,
    ) -> Self {
        let mut clocks: Vec<_> =
            candidates.iter().map(|c| time_keeper(c.satellite.constellation)).collect();
        clocks.sort_unstable();
        clocks.dedup();
        let mut bands: Vec<_> = candidates
            .iter()
            .flat_map(|c| {
                let clock = time_keeper(c.satellite.constellation);
                c.bands.iter().skip(1).map(move |ranging| (clock, ranging.band))
            })
            .collect();
        bands.sort_unstable();
        bands.dedup();
        let mut equations = Self { position: *position, clocks, bands, satellites: Vec::new() };
        let antenna = earth::geodetic(&Ecef(*position));
        for candidate in candidates {
            let ray = on_earth.then(|| {
                let direction = candidate.sight.direction(position);
                (direction.elevation, context.delays(&antenna, direction, tag))
            });
            let rows = equations.of_satellite(candidate, ray, context.noise.code);
            equations.satellites.push(rows);
        }
        equations
    }

    fn unknowns(&self) -> usize {
        3 + self.clocks.len() + self.bands.len() + 1
    }

    fn of_satellite(
        &self,
        candidate: &Candidate,
        ray: Option<(f64, Delays)>,
        code_std: f64,
    ) -> Rows {
        let count = candidate.bands.len();
        let clock = time_keeper(candidate.satellite.constellation);
        let line = candidate.sight.transmitter().line(&self.position);
        let range = candidate.sight.transmitter().range(&self.position);
        let mut rows = DMatrix::zeros(count, self.unknowns());
        let mut observed = DVector::zeros(count);
        for (row, ranging) in candidate.bands.iter().enumerate() {
            rows.fixed_view_mut::<1, 3>(row, 0).copy_from(&-line.transpose());
            if let Some(place) = self.clocks.iter().position(|known| *known == clock) {
                rows[(row, 3 + place)] = 1.0;
            }
            let band = self.bands.iter().position(|known| *known == (clock, ranging.band));
            if let Some(place) = band.filter(|_| row > 0) {
                rows[(row, 3 + self.clocks.len() + place)] = 1.0;
            }
            let delays = ray.map_or(0.0, |(_, delays)| {
                delays.troposphere + ranging.dispersion * delays.ionosphere
            });
            if let Some((_, delays)) = ray {
                rows[(row, self.unknowns() - 1)] = ranging.dispersion * delays.ionosphere;
            }
            observed[row] = ranging.code - range - delays;
        }
        let noise = noise(candidate, ray, code_std);
        let weight = noise.clone().try_inverse().unwrap_or_else(|| DMatrix::identity(count, count));
        Rows { rows, observed, noise, weight }
    }

    /// Solves them.
    pub(super) fn solve(self) -> Result<Solution, NoPosition> {
        let needed = 3 + self.clocks.len();
        if self.satellites.len() < needed {
            return Err(NoPosition::TooFew { satellites: self.satellites.len() });
        }
        let mut normal = Normal::new(self.unknowns());
        for satellite in &self.satellites {
            normal.add(&satellite.rows, &satellite.observed, &satellite.weight);
        }
        for place in 0..self.bands.len() {
            normal.know(3 + self.clocks.len() + place, 0.0, BAND_DELAY);
        }
        normal.know(self.unknowns() - 1, 0.0, IONOSPHERE_SCALE);
        let solved = normal.solve().ok_or(NoPosition::Geometry)?;
        Ok(Solution::new(&self, solved))
    }
}

/// Covariance of a satellite's codes: noise of each, and what they share.
fn noise(candidate: &Candidate, ray: Option<(f64, Delays)>, code_std: f64) -> DMatrix<f64> {
    let count = candidate.bands.len();
    let Some((elevation, delays)) = ray else {
        return DMatrix::identity(count, count) * 1e4;
    };
    let orbit = orbit_std(candidate.satellite.constellation);
    let shared = orbit * orbit + delays.troposphere_std * delays.troposphere_std;
    let ionosphere = IONOSPHERE_RAY * delays.ionosphere;
    DMatrix::from_fn(count, count, |i, j| {
        let (a, b) = (&candidate.bands[i], &candidate.bands[j]);
        let own = if i == j { a.noise(elevation, code_std) + a.untold * a.untold } else { 0.0 };
        shared + ionosphere * ionosphere * a.dispersion * b.dispersion + own
    })
}

/// A position and what each satellite says of it.
pub(super) struct Solution {
    pub(super) position: Vector3<f64>,
    pub(super) clocks: Vec<(Constellation, f64)>,
    /// Sum of the weighed squares of the residuals.
    pub(super) chi_square: f64,
    covariance: DMatrix<f64>,
    redundancy: usize,
    residuals: Vec<(DVector<f64>, DMatrix<f64>)>,
}

impl Solution {
    fn new(equations: &Equations, solved: Solved) -> Self {
        let x = &solved.unknowns;
        let mut chi_square = 0.0;
        let mut rows = 0;
        let residuals = equations
            .satellites
            .iter()
            .map(|satellite| {
                let residual = &satellite.observed - &satellite.rows * x;
                chi_square += (residual.transpose() * &satellite.weight * &residual)[0];
                rows += residual.len();
                // what is left of the noise after the satellite itself has drawn the solution to it
                let drawn = &satellite.rows * &solved.covariance * satellite.rows.transpose();
                (residual, &satellite.noise - drawn)
            })
            .collect();
        let clocks = equations.clocks.iter().enumerate();
        Self {
            position: equations.position + Vector3::new(x[0], x[1], x[2]),
            clocks: clocks.map(|(place, constellation)| (*constellation, x[3 + place])).collect(),
            chi_square,
            // delays of bands and the ionosphere are known beforehand, each is one observation more
            redundancy: rows.saturating_sub(3 + equations.clocks.len()),
            covariance: solved.covariance,
            residuals,
        }
    }

    pub(super) fn position_covariance(&self) -> Matrix3<f64> {
        self.covariance.fixed_view::<3, 3>(0, 0).into()
    }

    /// Observations more than unknowns.
    pub(super) fn redundancy(&self) -> usize {
        self.redundancy
    }

    /// Square of the Mahalanobis distance of a satellite's residuals, and their number; `None` where nothing checks it.
    pub(super) fn distance(&self, index: usize) -> Option<(f64, usize)> {
        let (residual, covariance) = self.residuals.get(index)?;
        // the first satellite of a constellation, say, fits whatever it says
        if covariance[(0, 0)] < 1e-6 {
            return None;
        }
        let solved = covariance.clone().cholesky()?.solve(residual);
        Some((residual.dot(&solved), residual.len()))
    }

    pub(super) fn witness(&self, candidates: &[Candidate], index: usize) -> Witness {
        let candidate = &candidates[index];
        let (residual, covariance) = &self.residuals[index];
        Witness {
            satellite: candidate.satellite,
            verdict: Verdict::Used,
            direction: Some(candidate.sight.direction(&self.position)),
            residual: Some(residual[0]),
            residual_std: Some(covariance[(0, 0)].max(0.0).sqrt()),
        }
    }
}
