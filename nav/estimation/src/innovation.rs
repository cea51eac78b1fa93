//! Innovations: what every measurement is turned into.

use nalgebra::{DMatrix, DVector, SMatrix, SVector};

use crate::jacobian::Jacobian;

/// Measured minus predicted, and how it depends on the error state: z = H x + noise(R).
#[derive(Clone, Debug, PartialEq)]
pub struct Innovation {
    /// Measured minus predicted.
    pub z: DVector<f64>,
    /// Measurement matrix.
    pub h: Jacobian,
    /// Covariance of the measurement noise.
    pub r: DMatrix<f64>,
}

impl Innovation {
    /// One of M rows.
    #[must_use]
    pub fn new<const M: usize>(z: &SVector<f64, M>, h: Jacobian, r: &SMatrix<f64, M, M>) -> Self {
        debug_assert_eq!(h.rows(), M);
        let z = DVector::from_column_slice(z.as_slice());
        Innovation { z, h, r: DMatrix::from_column_slice(M, M, r.as_slice()) }
    }

    /// One of so many rows that tells nothing.
    #[must_use]
    pub fn silent(rows: usize) -> Self {
        Innovation {
            z: DVector::zeros(rows),
            h: Jacobian::none(rows),
            r: DMatrix::identity(rows, rows),
        }
    }

    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.z.len()
    }

    /// Some of its rows alone, in this order.
    #[must_use]
    pub fn select(&self, rows: &[usize]) -> Self {
        let r = DMatrix::from_fn(rows.len(), rows.len(), |i, j| self.r[(rows[i], rows[j])]);
        Innovation { z: self.z.select_rows(rows), h: self.h.select(rows), r }
    }

    /// Two of one instant together.
    #[must_use]
    pub fn beside(&self, other: &Innovation) -> Self {
        Innovation::stacked([self, other].into_iter())
    }

    /// All of one instant together, in this order; their noises have nothing in common.
    #[must_use]
    pub fn stacked<'a>(all: impl Iterator<Item = &'a Innovation> + Clone) -> Self {
        let rows = all.clone().map(Innovation::rows).sum();
        let (mut z, mut r) = (DVector::zeros(rows), DMatrix::zeros(rows, rows));
        let mut at = 0;
        for one in all.clone() {
            z.rows_mut(at, one.rows()).copy_from(&one.z);
            r.view_mut((at, at), (one.rows(), one.rows())).copy_from(&one.r);
            at += one.rows();
        }
        Innovation { z, h: Jacobian::stacked(all.map(|one| &one.h)), r }
    }
}
