//! What causes outside of the filter do to its errors.

use nalgebra::{DMatrix, DVector};

use crate::block::Block;
use crate::errors::Errors;
use crate::layout::Layout;

/// U^T: a row for each cause of unit size, its effect on each error state. Of a state that is not there the effect is
/// not known, and zero when it joins.
#[derive(Clone, Debug, PartialEq)]
pub struct Effects {
    layout: Layout,
    rows: DMatrix<f64>,
}

impl Effects {
    /// None yet of so many causes.
    #[must_use]
    pub fn none(causes: usize) -> Self {
        Effects::new(Layout::empty(), DMatrix::zeros(causes, 0))
    }

    fn new(layout: Layout, rows: DMatrix<f64>) -> Self {
        Effects { layout, rows }
    }

    /// Of one cause that does this.
    #[must_use]
    pub fn of(error: &Errors) -> Self {
        let values = error.values();
        Effects::new(
            error.layout().clone(),
            DMatrix::from_row_slice(1, values.len(), values.as_slice()),
        )
    }

    /// Of errors that are their own causes.
    pub(crate) fn identity(layout: &Layout) -> Self {
        Effects::new(layout.clone(), DMatrix::identity(layout.states(), layout.states()))
    }

    /// Number of causes.
    #[must_use]
    pub fn causes(&self) -> usize {
        self.rows.nrows()
    }

    /// Which states there are.
    #[must_use]
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// A row for each cause, a column for each state.
    #[must_use]
    pub fn matrix(&self) -> &DMatrix<f64> {
        &self.rows
    }

    pub(crate) fn matrix_mut(&mut self) -> &mut DMatrix<f64> {
        &mut self.rows
    }

    /// Takes on the states of a layout: those that it has not are forgotten, new ones are zero.
    pub fn conform(&mut self, layout: &Layout) {
        if self.layout == *layout {
            return;
        }
        let mut rows = DMatrix::zeros(self.causes(), layout.states());
        for place in layout.places() {
            let Some(own) = self.layout.place(place.key) else { continue };
            let width = own.width.min(place.width);
            rows.columns_mut(place.start, width).copy_from(&self.rows.columns(own.start, width));
        }
        self.layout = layout.clone();
        self.rows = rows;
    }

    /// Takes on so many causes: those that are new have no effect yet.
    pub fn widen(&mut self, causes: usize) {
        if causes > self.causes() {
            let rows = std::mem::replace(&mut self.rows, DMatrix::zeros(0, 0));
            self.rows = rows.resize_vertically(causes, 0.0);
        }
    }

    /// Sets what some causes, from `first` on, a row of `value` each, do to a block.
    pub fn set<const R: usize, const W: usize>(
        &mut self,
        first: usize,
        block: Block<W>,
        value: &nalgebra::SMatrix<f64, R, W>,
    ) {
        self.conform(&self.layout.with(block.key(), W));
        if let Some(start) = self.layout.start(block.key()) {
            self.rows.fixed_view_mut::<R, W>(first, start).copy_from(value);
        }
    }

    /// What causes of these sizes do together.
    #[must_use]
    pub fn total(&self, sizes: &[f64]) -> Errors {
        debug_assert_eq!(sizes.len(), self.causes());
        let values = self.rows.tr_mul(&DVector::from_column_slice(sizes));
        Errors::new(self.layout.clone(), values)
    }

    /// Some of the causes alone, so many from `first` on.
    #[must_use]
    pub fn some(&self, first: usize, count: usize) -> Self {
        Effects::new(self.layout.clone(), self.rows.rows(first, count).into_owned())
    }

    /// Multiplies what all do to a block by a factor.
    pub fn scale_block<const W: usize>(&mut self, block: Block<W>, factor: f64) {
        if let Some(start) = self.layout.start(block.key()) {
            self.rows.fixed_columns_mut::<W>(start).scale_mut(factor);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Matrix1, Matrix2};

    #[test]
    fn effects_follow_the_states_by_their_names() {
        let (a, b): (Block<2>, Block<1>) = (Block::new(0), Block::new(1));
        let mut effects = Effects::none(3);
        effects.set(1, a, &Matrix2::new(1.0, 2.0, 3.0, 4.0));
        effects.set(0, b, &Matrix1::new(7.0));
        effects.conform(&Layout::of_blocks([(b.key(), 1), (a.key(), 2)]));
        assert_eq!(effects.matrix().row(0), nalgebra::RowDVector::from_vec(vec![7.0, 0.0, 0.0]));
        assert_eq!(effects.matrix()[(2, 2)], 4.0);
        effects.conform(&Layout::of_blocks([(a.key(), 2)]));
        effects.conform(&Layout::of_blocks([(a.key(), 2), (b.key(), 1)]));
        assert_eq!(effects.matrix()[(0, 2)], 0.0, "what was forgotten stays forgotten");
    }
}
