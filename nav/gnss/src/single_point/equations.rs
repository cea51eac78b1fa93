//! The linear equations of one epoch around a position, and what solves them.

use insd_base::frames::Ecef;
use insd_base::{Constellation, GpsTime, earth};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::candidates::{Candidate, Ranging};
use super::witness::{NoPosition, Verdict, Witness};
use crate::context::{Context, Delays};
use crate::least_squares::{Normal, Solved};
use crate::signals::inflation;

/// 1-sigma of what a broadcast orbit and clock add to a range, m: in space they are off by 0.98 (Galileo), 1.4 (GPS), 2.6 (BeiDou) and
/// 2.9 m (GLONASS, whose receivers' delays differ from channel to channel besides) against precise orbits, of which more than half is along the line.
fn orbit_std(constellation: Constellation) -> f64 {
    match constellation {
        Constellation::Galileo => 0.6,
        Constellation::BeiDou => 1.5,
        Constellation::Glonass => 2.5,
        _ => 0.9,
    }
}

/// 1-sigma of a receiver's delay on a further band against its first, m.
const BAND_DELAY: f64 = 10.0;
/// 1-sigma of a satellite's delay on L5, of which GPS' and QZSS' old messages tell nothing, m.
const UNTOLD_L5: f64 = 1.5;
/// The same of its codes on L1 and L2 that are not those which its clock refers to.
const UNTOLD_L2: f64 = 0.5;
/// 1-sigma of a code that is tracked without being known, m, against one that is: it has the other's noise as well.
const CODELESS: f64 = 1.6;
/// The same between the bands of GLONASS, where a receiver has another delay on each channel.
const UNTOLD_GLONASS: f64 = 3.0;
/// By what share the ionosphere as a whole may be other than its model; 1-sigma (IS-GPS-200N, 20.3.3.5.2.5: half of it is left).
const IONOSPHERE_SCALE: f64 = 0.5;
/// By what share it may be so on one ray alone.
const IONOSPHERE_RAY: f64 = 0.2;

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

/// Whose clock a constellation shares.
fn clock_of(constellation: Constellation) -> Constellation {
    match constellation {
        Constellation::Qzss => Constellation::Gps,
        other => other,
    }
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
            candidates.iter().map(|c| clock_of(c.satellite.constellation)).collect();
        clocks.sort_unstable();
        clocks.dedup();
        let mut bands: Vec<_> = candidates
            .iter()
            .flat_map(|c| {
                let clock = clock_of(c.satellite.constellation);
                c.rangings.iter().skip(1).map(move |ranging| (clock, ranging.band))
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
        let count = candidate.rangings.len();
        let clock = clock_of(candidate.satellite.constellation);
        let line = candidate.sight.transmitter().line(&self.position);
        let range = candidate.sight.transmitter().range(&self.position);
        let mut rows = DMatrix::zeros(count, self.unknowns());
        let mut observed = DVector::zeros(count);
        for (row, ranging) in candidate.rangings.iter().enumerate() {
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
    let count = candidate.rangings.len();
    let Some((elevation, delays)) = ray else {
        return DMatrix::identity(count, count) * 1e4;
    };
    let orbit = orbit_std(candidate.satellite.constellation);
    let shared = orbit * orbit + delays.troposphere_std * delays.troposphere_std;
    let ionosphere = IONOSPHERE_RAY * delays.ionosphere;
    DMatrix::from_fn(count, count, |i, j| {
        let (a, b) = (&candidate.rangings[i], &candidate.rangings[j]);
        let own = if i == j { own_noise(candidate, a, elevation, code_std) } else { 0.0 };
        shared + ionosphere * ionosphere * a.dispersion * b.dispersion + own
    })
}

fn own_noise(candidate: &Candidate, ranging: &Ranging, elevation: f64, code_std: f64) -> f64 {
    let untold = match (clock_of(candidate.satellite.constellation), ranging.band) {
        (Constellation::Gps, 5) => UNTOLD_L5,
        (Constellation::Gps, 2) => UNTOLD_L2,
        (Constellation::Glonass, 2) => UNTOLD_GLONASS,
        _ => 0.0,
    };
    let codeless = if ranging.attribute == b'W' { CODELESS } else { 0.0 };
    code_std * code_std * inflation(elevation, ranging.cn0) + untold * untold + codeless * codeless
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
