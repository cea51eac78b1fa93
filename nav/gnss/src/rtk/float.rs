//! Position and ambiguities as real numbers.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::double::DoubleDifferences;
use super::prior::RoverPrior;

/// Position and ambiguities with their joint covariance.
#[derive(Clone, Debug)]
pub(super) struct Float {
    /// ECEF, m.
    pub(super) position: Vector3<f64>,
    /// Cycles.
    pub(super) ambiguities: DVector<f64>,
    /// Of position (m) and ambiguities (cycles), in that order.
    pub(super) covariance: DMatrix<f64>,
    /// Sum of the weighed squares of the residuals, and degrees of freedom.
    pub(super) misfit: (f64, usize),
    /// What is known beforehand of the noise: a sum of squares and of how many measurements.
    pub(super) known: (f64, f64),
}

impl Float {
    /// Least squares over one epoch, with a prior of the position or without. `None` where the geometry does not determine a position.
    pub(super) fn solve(
        differences: &DoubleDifferences,
        near: &Vector3<f64>,
        prior: Option<&RoverPrior>,
    ) -> Option<Self> {
        const ROUNDS: usize = 4;
        let mut float = None;
        let mut position = *near;
        for _ in 0..ROUNDS {
            let (solved, step) = Self::step(differences, &position, prior)?;
            position = solved.position;
            float = Some(solved);
            // what is left of a step of 100 m by the curvature of the ranges is below a millimetre
            if step < 100.0 {
                break;
            }
        }
        float
    }

    fn step(
        differences: &DoubleDifferences,
        near: &Vector3<f64>,
        prior: Option<&RoverPrior>,
    ) -> Option<(Self, f64)> {
        let count = differences.ambiguities().len();
        let rows = differences.rows(near, differences.whole_cycles());
        let mut design = DMatrix::zeros(rows.residuals.len(), 3 + count);
        design.columns_mut(0, 3).copy_from(&rows.directions);
        for (row, ambiguity) in rows.ambiguities.iter().enumerate() {
            if let Some((place, wavelength)) = ambiguity {
                design[(row, 3 + place)] = *wavelength;
            }
        }
        let factor = rows.covariance.cholesky()?;
        let white = factor.l().solve_lower_triangular(&design)?;
        let residuals = factor.l().solve_lower_triangular(&rows.residuals)?;
        let mut normal = white.transpose() * &white;
        let mut right = white.transpose() * &residuals;
        let mut squares = residuals.norm_squared();
        let mut freedom = rows.residuals.len();
        if let Some((information, off)) = prior.and_then(|prior| prior.information(near)) {
            let mut corner = normal.fixed_view_mut::<3, 3>(0, 0);
            corner += information;
            let mut head = right.fixed_rows_mut::<3>(0);
            head += information * off;
            squares += off.dot(&(information * off));
            freedom += 3;
        }
        let covariance = inverse(&normal)?;
        let solved = &covariance * &right;
        let step = Vector3::new(solved[0], solved[1], solved[2]);
        let misfit = (squares - solved.dot(&right)).max(0.0);
        let float = Self {
            position: near + step,
            ambiguities: differences.whole_cycles() + solved.rows(3, count),
            covariance,
            misfit: (misfit, freedom.checked_sub(3 + count)?),
            known: (0.0, 0.0),
        };
        Some((float, step.norm()))
    }

    /// The same if some ambiguities are these integers. `None` where they contradict it: chance makes that once in a thousand.
    pub(super) fn held(&self, integers: &[(usize, i64)]) -> Option<Self> {
        // cycles^2: sure, and still a covariance
        const SURE: f64 = 1e-8;
        let count = integers.len();
        let size = self.covariance.nrows();
        let place = |own: usize| 3 + integers[own].0;
        let with = DMatrix::from_fn(size, count, |i, j| self.covariance[(i, place(j))]);
        let own = DMatrix::from_fn(count, count, |i, j| {
            with[(place(i), j)] + if i == j { SURE } else { 0.0 }
        });
        let factor = own.cholesky()?;
        let off =
            DVector::from_fn(count, |i, _| integers[i].1 as f64 - self.ambiguities[integers[i].0]);
        let pulled = factor.solve(&off);
        let distance = off.dot(&pulled);
        if ChiSquared::new(count as f64).is_ok_and(|law| law.sf(distance) < 1e-3) {
            return None;
        }
        let step = &with * pulled;
        let covariance = &self.covariance - &with * factor.solve(&with.transpose());
        Some(Self {
            position: self.position + step.fixed_rows::<3>(0),
            ambiguities: &self.ambiguities + step.rows(3, size - 3),
            covariance: (&covariance + covariance.transpose()) * 0.5,
            misfit: (self.misfit.0 + distance, self.misfit.1 + count),
            known: self.known,
        })
    }

    /// Of the position alone.
    pub(super) fn position_covariance(&self) -> Matrix3<f64> {
        self.covariance.fixed_view::<3, 3>(0, 0).into()
    }
}

/// The inverse of normal equations, `None` where they are singular.
fn inverse(normal: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let scale = normal.diagonal().map(|weight| weight.sqrt().recip());
    if !scale.iter().all(|x| x.is_finite()) {
        return None;
    }
    let scaled = DMatrix::from_fn(normal.nrows(), normal.ncols(), |i, j| {
        normal[(i, j)] * scale[i] * scale[j]
    });
    let inverse = scaled.cholesky()?.inverse();
    let is_known = inverse.diagonal().iter().all(|x| *x < 1e12);
    is_known.then(|| {
        DMatrix::from_fn(normal.nrows(), normal.ncols(), |i, j| {
            inverse[(i, j)] * scale[i] * scale[j]
        })
    })
}
