//! Parts of the error state by name: each block is declared after the last, so no index is written
//! by hand.

use nalgebra::{SMatrix, SMatrixViewMut, SVector};

use crate::error_state::{Covariance, ErrorState, STATES};

/// `W` consecutive components of the error state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Block<const W: usize> {
    start: usize,
}

impl<const W: usize> Block<W> {
    /// The block at the head of the state.
    #[must_use]
    pub const fn first() -> Self {
        Block { start: 0 }
    }

    /// The block that follows another.
    #[must_use]
    pub const fn after<const V: usize>(previous: Block<V>) -> Self {
        Block { start: previous.end() }
    }

    /// Index of the first component.
    #[must_use]
    pub const fn start(self) -> usize {
        self.start
    }

    /// Index after the last component.
    #[must_use]
    pub const fn end(self) -> usize {
        self.start + W
    }

    /// This block of an error vector.
    #[must_use]
    pub fn of(self, error: &ErrorState) -> SVector<f64, W> {
        error.fixed_rows::<W>(self.start).into_owned()
    }

    /// Writes this block of an error vector.
    pub fn set(self, error: &mut ErrorState, value: &SVector<f64, W>) {
        error.fixed_rows_mut::<W>(self.start).copy_from(value);
    }

    /// Covariance of this block with itself.
    #[must_use]
    pub fn covariance(self, p: &Covariance) -> SMatrix<f64, W, W> {
        p.fixed_view::<W, W>(self.start, self.start).into_owned()
    }

    /// Covariance of this block as other axes see it: of A x, with x the block.
    #[must_use]
    pub fn covariance_in<const M: usize>(
        self,
        p: &Covariance,
        axes: &SMatrix<f64, M, W>,
    ) -> SMatrix<f64, M, M> {
        axes * self.covariance(p) * axes.transpose()
    }

    /// 1-sigma of a component, on the mean of all.
    #[must_use]
    pub fn std(self, p: &Covariance) -> f64 {
        (self.covariance(p).trace() / W as f64).max(0.0).sqrt()
    }

    /// Writes this block of the columns of a measurement matrix.
    pub fn set_columns<const M: usize>(
        self,
        h: &mut SMatrix<f64, M, STATES>,
        value: &SMatrix<f64, M, W>,
    ) {
        h.fixed_view_mut::<M, W>(0, self.start).copy_from(value);
    }

    /// Forgets what is known of this block: new covariance, no correlation with the rest.
    pub fn renew(self, p: &mut Covariance, covariance: &SMatrix<f64, W, W>) {
        p.fixed_rows_mut::<W>(self.start).fill(0.0);
        p.fixed_columns_mut::<W>(self.start).fill(0.0);
        p.fixed_view_mut::<W, W>(self.start, self.start).copy_from(covariance);
    }

    /// Adds to the covariance of this block.
    pub fn add(self, p: &mut Covariance, covariance: &SMatrix<f64, W, W>) {
        let mut block = p.fixed_view_mut::<W, W>(self.start, self.start);
        block += (covariance + covariance.transpose()) * 0.5;
    }

    /// Transforms this block of the error by a matrix.
    pub fn transform(self, p: &mut Covariance, matrix: &SMatrix<f64, W, W>) {
        let columns = p.fixed_columns::<W>(self.start) * matrix.transpose();
        p.fixed_columns_mut::<W>(self.start).copy_from(&columns);
        let rows = matrix * p.fixed_rows::<W>(self.start);
        p.fixed_rows_mut::<W>(self.start).copy_from(&rows);
    }

    /// Tells this block in another unit: its numbers become what they were times a factor. What is told in units of its
    /// own sigma has become larger where the factor is below one, and is not known by that much: its variance tends to one.
    pub fn rescale(self, p: &mut Covariance, factor: f64) {
        self.transform(p, &SMatrix::from_diagonal_element(factor));
        self.inflate(p, (1.0 - factor * factor).max(0.0));
    }

    /// This block of rows of effects on the error state.
    pub fn columns_mut<const R: usize>(
        self,
        effects: &mut SMatrix<f64, R, STATES>,
    ) -> SMatrixViewMut<'_, f64, R, W> {
        effects.fixed_columns_mut::<W>(self.start)
    }

    /// Adds a variance to each component.
    pub fn inflate(self, p: &mut Covariance, variance: f64) {
        for i in self.start..self.end() {
            p[(i, i)] += variance;
        }
    }
}
