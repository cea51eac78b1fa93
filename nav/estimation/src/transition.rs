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
const ROWS: usize = 4;

impl<const N: usize> Transition<'_, N> {
    /// Carries a covariance: P <- Phi P Phi^T, and what keeps the processes that decay as wide as they are.
    pub fn propagate(&self, p: &mut Covariance) {
        let matrix = p.p_mut();
        self.carry_rows(matrix.nrows(), matrix.as_mut_slice());
        let corner = self.corner(matrix);
        let states = matrix.nrows();
        let (head, rest) = matrix.as_mut_slice().split_at_mut(N * states);
        for (at, column) in head.chunks_exact(states.max(1)).enumerate() {
            let rows = rest.chunks_exact_mut(states.max(1)).zip(&column[N..]);
            rows.for_each(|(row, value)| row[at] = *value);
        }
        matrix.fixed_view_mut::<N, N>(0, 0).copy_from(&corner);
        self.relax(matrix);
        if let Some(trail) = p.trail_mut() {
            self.carry(trail.effects_mut());
        }
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
            scale(&mut values[own], decay.left);
        }
    }

    /// What decays does so in rows and columns, and stays as wide as it is.
    fn relax(&self, p: &mut DMatrix<f64>) {
        let states = p.nrows().max(1);
        for decay in self.decays {
            let own = decay.start..decay.start + decay.width;
            let rows = p.as_mut_slice().chunks_exact_mut(states);
            rows.for_each(|column| scale(&mut column[own.clone()], decay.left));
            scale(&mut p.as_mut_slice()[own.start * states..own.end * states], decay.left);
            let renewed = decay.steady * (1.0 - decay.left * decay.left);
            own.for_each(|state| p[(state, state)] += renewed);
        }
    }

    /// M <- M Phi^T in the first N columns of a matrix of so many rows, in place: each row depends on itself alone.
    fn carry_rows(&self, all: usize, values: &mut [f64]) {
        let mut first = 0;
        while first + ROWS <= all {
            self.carry_some::<ROWS>(all, first, values);
            first += ROWS;
        }
        (first..all).for_each(|row| self.carry_some::<1>(all, row, values));
    }

    /// The same for L rows from `first` on.
    fn carry_some<const L: usize>(&self, all: usize, first: usize, values: &mut [f64]) {
        let rows = |state: usize| -> [f64; L] {
            let own = &values[state * all + first..][..L];
            std::array::from_fn(|row| own[row])
        };
        let before: [[f64; L]; N] = std::array::from_fn(rows);
        let mut after = self.head.transpose().data.0.map(|by| sum(&by, &before));
        for feed in self.feeds {
            let source: [[f64; L]; 3] = std::array::from_fn(|axis| {
                let all = feed.from.iter().map(|(at, by)| rows(at + axis).map(|x| by[axis] * x));
                all.fold([0.0; L], |sum, own| std::array::from_fn(|row| sum[row] + own[row]))
            });
            let fed = feed.by.transpose().data.0.map(|by| sum(&by, &source));
            after.as_flattened_mut().iter_mut().zip(fed.as_flattened()).for_each(|(a, b)| *a += b);
        }
        for (state, after) in after.iter().enumerate() {
            values[state * all + first..][..L].copy_from_slice(after);
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

impl Decay {
    /// Of nothing.
    pub const NONE: Self = Decay { start: 0, width: 0, left: 1.0, steady: 0.0 };
}

/// Values times a factor; mostly they are three.
fn scale(values: &mut [f64], by: f64) {
    if let [x, y, z] = values {
        [*x, *y, *z] = [*x * by, *y * by, *z * by];
    } else {
        values.iter_mut().for_each(|value| *value *= by);
    }
}

/// Rows times the factors of their states, added up.
fn sum<const L: usize, const K: usize>(by: &[f64; K], rows: &[[f64; L]; K]) -> [f64; L] {
    let mut sum = [0.0; L];
    for (by, rows) in by.iter().zip(rows) {
        (0..L).for_each(|row| sum[row] += by * rows[row]);
    }
    sum
}
