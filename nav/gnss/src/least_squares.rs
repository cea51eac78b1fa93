//! Least squares with what is known of the unknowns beforehand.

use nalgebra::{DMatrix, DVector, RowVector4};
use statrs::distribution::{ContinuousCDF, Normal as Gaussian};

/// An observation is faulty when chance makes a residual as large as its own once in so many.
pub(crate) const FALSE_ALARM: f64 = 1e-5;

/// Normal equations of linear observations.
#[derive(Clone, Debug)]
pub(crate) struct Normal {
    information: DMatrix<f64>,
    right: DVector<f64>,
}

/// The unknowns and their covariance.
#[derive(Clone, Debug)]
pub(crate) struct Solved {
    pub(crate) unknowns: DVector<f64>,
    pub(crate) covariance: DMatrix<f64>,
}

impl Normal {
    pub(crate) fn new(unknowns: usize) -> Self {
        Self { information: DMatrix::zeros(unknowns, unknowns), right: DVector::zeros(unknowns) }
    }

    /// Observations `observed = rows * unknowns + error`, the error with this inverse covariance.
    pub(crate) fn add(
        &mut self,
        rows: &DMatrix<f64>,
        observed: &DVector<f64>,
        weight: &DMatrix<f64>,
    ) {
        let weighed = rows.transpose() * weight;
        self.information += &weighed * rows;
        self.right += weighed * observed;
    }

    /// One unknown is this value to within this standard deviation.
    pub(crate) fn know(&mut self, unknown: usize, value: f64, std: f64) {
        let weight = 1.0 / (std * std);
        self.information[(unknown, unknown)] += weight;
        self.right[unknown] += weight * value;
    }

    /// `None` where the observations do not determine every unknown.
    pub(crate) fn solve(self) -> Option<Solved> {
        let size = self.information.nrows();
        // on one scale, so that metres and rates do not make it look singular
        let scale = self.information.diagonal().map(|weight| weight.sqrt().recip());
        if !scale.iter().all(|x| x.is_finite()) {
            return None;
        }
        let scaled =
            DMatrix::from_fn(size, size, |i, j| self.information[(i, j)] * scale[i] * scale[j]);
        let inverse = scaled.cholesky()?.inverse();
        if inverse.diagonal().iter().any(|x| *x > 1e12) {
            return None;
        }
        let covariance = DMatrix::from_fn(size, size, |i, j| inverse[(i, j)] * scale[i] * scale[j]);
        Some(Solved { unknowns: &covariance * self.right, covariance })
    }
}

/// One observation of a displacement or velocity and a clock: `observed = row * unknowns + error`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Observation {
    pub(crate) row: RowVector4<f64>,
    pub(crate) observed: f64,
    pub(crate) variance: f64,
}

/// Solves independent observations of four unknowns; `None` where they do not determine them.
pub(crate) fn solve(observations: &[Observation]) -> Option<Solved> {
    let mut normal = Normal::new(4);
    for observation in observations {
        let row = DMatrix::from_row_slice(1, 4, observation.row.as_slice());
        let weight = DMatrix::from_element(1, 1, 1.0 / observation.variance);
        normal.add(&row, &DVector::from_element(1, observation.observed), &weight);
    }
    normal.solve()
}

impl Solved {
    /// What an observation has over the solution, and the 1-sigma that it should have; `None` where nothing checks it.
    fn residual(&self, observation: &Observation) -> Option<(f64, f64)> {
        let row = DMatrix::from_row_slice(1, 4, observation.row.as_slice());
        let drawn = (&row * &self.covariance * row.transpose())[0];
        let left = observation.variance - drawn;
        let residual = observation.observed - (&row * &self.unknowns)[0];
        (left > 1e-9 * observation.variance).then(|| (residual, left.sqrt()))
    }

    /// The observation that contradicts the others most, if one does, by more than `least`.
    pub(crate) fn worst(&self, observations: &[Observation], least: f64) -> Option<usize> {
        let limit = -Gaussian::standard().inverse_cdf(FALSE_ALARM / 2.0);
        let surprise = |(index, observation): (usize, &Observation)| {
            let (residual, std) = self.residual(observation)?;
            let is_far = residual.abs() > limit * std && residual.abs() > least;
            is_far.then(|| (index, residual.abs() / std))
        };
        let far = observations.iter().enumerate().filter_map(surprise);
        far.max_by(|(_, a), (_, b)| a.total_cmp(b)).map(|(index, _)| index)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_found_and_one_point_without_prior_is_not_enough() {
        let rows = DMatrix::from_row_slice(3, 2, &[1.0, 0.0, 1.0, 1.0, 1.0, 2.0]);
        let observed = DVector::from_vec(vec![1.0, 3.0, 5.0]);
        let mut normal = Normal::new(2);
        normal.add(&rows, &observed, &DMatrix::identity(3, 3));
        let solved = normal.solve().unwrap();
        assert!((solved.unknowns[0] - 1.0).abs() < 1e-12);
        assert!((solved.unknowns[1] - 2.0).abs() < 1e-12);

        let mut short = Normal::new(2);
        short.add(&rows.rows(0, 1).into(), &observed.rows(0, 1).into(), &DMatrix::identity(1, 1));
        assert!(short.solve().is_none());
    }
}
