//! Sums over columns, which the compiler makes vector instructions of.

use nalgebra::DMatrix;

/// y <- y + a x; nothing where a is zero.
pub(crate) fn axpy(a: f64, x: &[f64], y: &mut [f64]) {
    if a != 0.0 {
        y.iter_mut().zip(x).for_each(|(y, x)| *y += a * x);
    }
}

/// y <- y + a_1 x_1 + a_2 x_2 + ..., the terms three at a time.
pub(crate) fn add_all<'a>(terms: impl Iterator<Item = (f64, &'a [f64])>, y: &mut [f64]) {
    let mut terms = terms.fuse();
    while let Some((a, x)) = terms.next() {
        let Some((b, second)) = terms.next() else { return axpy(a, x, y) };
        let Some((c, third)) = terms.next() else {
            axpy(a, x, y);
            return axpy(b, second, y);
        };
        let all = y.iter_mut().zip(x).zip(second).zip(third);
        all.for_each(|(((y, x), second), third)| *y = *y + a * x + b * second + c * third);
    }
}

/// A column of a matrix.
pub(crate) fn column(m: &DMatrix<f64>, at: usize) -> &[f64] {
    let rows = m.nrows();
    &m.as_slice()[at * rows..(at + 1) * rows]
}

/// A column of a matrix, to be changed.
pub(crate) fn column_mut(m: &mut DMatrix<f64>, at: usize) -> &mut [f64] {
    let rows = m.nrows();
    &mut m.as_mut_slice()[at * rows..(at + 1) * rows]
}

/// The columns before one, and that one to be changed.
pub(crate) fn columns_to(m: &mut DMatrix<f64>, at: usize) -> (&[f64], &mut [f64]) {
    let rows = m.nrows();
    let (before, rest) = m.as_mut_slice().split_at_mut(at * rows);
    (before, &mut rest[..rows])
}

/// M <- M L^-T with a lower triangular L.
pub(crate) fn solve_right_transposed(m: &mut DMatrix<f64>, l: &DMatrix<f64>) {
    let rows = m.nrows().max(1);
    for at in 0..m.ncols() {
        let (before, own) = columns_to(m, at);
        for (j, column) in before.chunks_exact(rows).enumerate() {
            axpy(-l[(at, j)], column, own);
        }
        let by = 1.0 / l[(at, at)];
        own.iter_mut().for_each(|value| *value *= by);
    }
}

/// M <- M L^-1 with a lower triangular L.
pub(crate) fn solve_right(m: &mut DMatrix<f64>, l: &DMatrix<f64>) {
    let rows = m.nrows().max(1);
    for at in (0..m.ncols()).rev() {
        let (head, behind) = m.as_mut_slice().split_at_mut((at + 1) * rows);
        let own = &mut head[at * rows..];
        for (j, column) in behind.chunks_exact(rows).enumerate() {
            axpy(-l[(at + 1 + j, at)], column, own);
        }
        let by = 1.0 / l[(at, at)];
        own.iter_mut().for_each(|value| *value *= by);
    }
}
