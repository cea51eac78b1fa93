//! Propagation over a stretch of time.

use nalgebra::{DMatrix, SMatrix, Vector3};

use crate::covariance::Covariance;
use crate::effects::Effects;
use crate::errors::Errors;

/// What a stretch of time does to the errors: x <- Phi x. The first N of them go by a matrix and are fed by others;
/// of the others each goes on by itself, and some decay.
///
/// Whoever declares the states gives the indices, as the layout of the covariance has them. What noise adds is
/// added after that, block by block.
#[derive(Clone, Copy, Debug)]
pub struct Transition<'a, const N: usize> {
    /// Of the first N states.
    pub head: SMatrix<f64, N, N>,
    /// What feeds into them.
    pub feeds: &'a [Feed<'a, N>],
    /// What decays.
    pub decays: &'a [Decay],
}

/// Triples of states that enter the first N states through one matrix: G (a_1 x_1 + a_2 x_2 + ...), each a_i a diagonal.
#[derive(Clone, Copy, Debug)]
pub struct Feed<'a, const N: usize> {
    /// G.
    pub by: SMatrix<f64, N, 3>,
    /// Index of the first state of each triple, behind the first N, and the diagonal that it is multiplied by.
    pub from: &'a [(usize, Vector3<f64>)],
}

/// Neighbouring states of one Gauss-Markov process.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decay {
    /// Index of the first.
    pub start: usize,
    /// Number.
    pub width: usize,
    /// Share that is left of them.
    pub left: f64,
    /// Steady variance that they tend to.
    pub steady: f64,
}

/// Rows that are carried together.
const ROWS: usize = 16;

impl<const N: usize> Transition<'_, N> {
    /// Carries a covariance: P <- Phi P Phi^T, and what keeps the processes that decay as wide as they are.
    pub fn propagate(&self, p: &mut Covariance) {
        let matrix = p.matrix_mut();
        self.carry_rows(matrix.nrows(), matrix.as_mut_slice());
        let corner = self.corner(matrix);
        for column in N..matrix.ncols() {
            for row in 0..N {
                matrix[(row, column)] = matrix[(column, row)];
            }
        }
        matrix.fixed_view_mut::<N, N>(0, 0).copy_from(&corner);
        self.decays.iter().for_each(|decay| decay.relax(matrix));
    }

    /// Carries the effects of causes: U^T <- U^T Phi^T.
    pub fn carry(&self, effects: &mut Effects) {
        let causes = effects.causes();
        self.carry_all(causes, effects.matrix_mut().as_mut_slice());
    }

    /// Carries errors: x <- Phi x.
    pub fn carry_errors(&self, errors: &mut Errors) {
        self.carry_all(1, errors.values_mut());
    }

    fn carry_all(&self, rows: usize, values: &mut [f64]) {
        self.carry_rows(rows, values);
        for decay in self.decays {
            let own = decay.start * rows..(decay.start + decay.width) * rows;
            values[own].iter_mut().for_each(|value| *value *= decay.left);
        }
    }

    /// M <- M Phi^T in the first N columns of a matrix of so many rows, in place: each row depends on itself alone.
    fn carry_rows(&self, all: usize, values: &mut [f64]) {
        let mut first = 0;
        while first < all {
            let rows = ROWS.min(all - first);
            let mut sum = [[0.0; ROWS]; N];
            let column = |state: usize| state * all + first..state * all + first + rows;
            for (i, sum) in sum.iter_mut().enumerate() {
                for j in 0..N {
                    axpy(self.head[(i, j)], &values[column(j)], sum);
                }
            }
            for feed in self.feeds {
                feed.add_to(&mut sum, |state| &values[column(state)]);
            }
            for (state, sum) in sum.iter().enumerate() {
                values[column(state)].copy_from_slice(&sum[..rows]);
            }
            first += rows;
        }
    }

    /// Phi (P Phi^T) in the first N rows and columns, made symmetric; `columns` are P Phi^T.
    fn corner(&self, columns: &DMatrix<f64>) -> SMatrix<f64, N, N> {
        let mut corner = self.head * columns.fixed_view::<N, N>(0, 0);
        for feed in self.feeds {
            let mut sum = SMatrix::<f64, 3, N>::zeros();
            for (start, scale) in feed.from {
                for axis in 0..3 {
                    let row = columns.fixed_view::<1, N>(start + axis, 0);
                    sum.row_mut(axis).zip_apply(&row, |sum, x| *sum += scale[axis] * x);
                }
            }
            corner += feed.by * sum;
        }
        (corner + corner.transpose()) * 0.5
    }
}

impl<const N: usize> Feed<'_, N> {
    fn add_to<'v>(&self, sums: &mut [[f64; ROWS]; N], column: impl Fn(usize) -> &'v [f64]) {
        for axis in 0..3 {
            let mut source = [0.0; ROWS];
            for (start, scale) in self.from {
                axpy(scale[axis], column(start + axis), &mut source);
            }
            for (i, sum) in sums.iter_mut().enumerate() {
                axpy(self.by[(i, axis)], &source, sum);
            }
        }
    }
}

impl Decay {
    /// Of nothing.
    pub const NONE: Self = Decay { start: 0, width: 0, left: 1.0, steady: 0.0 };

    fn relax(&self, p: &mut DMatrix<f64>) {
        p.columns_mut(self.start, self.width).scale_mut(self.left);
        p.rows_mut(self.start, self.width).scale_mut(self.left);
        let renewed = self.steady * (1.0 - self.left * self.left);
        (self.start..self.start + self.width).for_each(|i| p[(i, i)] += renewed);
    }
}

/// sum <- sum + a x.
fn axpy(a: f64, x: &[f64], sum: &mut [f64; ROWS]) {
    if a != 0.0 {
        sum.iter_mut().zip(x).for_each(|(sum, x)| *sum += a * x);
    }
}
