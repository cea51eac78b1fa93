//! How a measurement depends on the error states.

use nalgebra::{DMatrix, DVector, SMatrix};

use crate::block::Block;
use crate::errors::Errors;
use crate::key::Key;
use crate::layout::Layout;

/// Blocks that a measurement depends on, as a rule.
const BLOCKS: usize = 12;

/// The columns of a measurement matrix that are not zero, by the names of their blocks.
#[derive(Clone, Debug, PartialEq)]
pub struct Jacobian {
    rows: usize,
    blocks: Vec<(Key, usize)>,
    /// Column by column, block after block.
    values: Vec<f64>,
}

impl Jacobian {
    /// One of so many rows that depends on nothing.
    #[must_use]
    pub fn none(rows: usize) -> Self {
        Jacobian {
            rows,
            blocks: Vec::with_capacity(BLOCKS),
            values: Vec::with_capacity(2 * BLOCKS * rows),
        }
    }

    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Sets all rows of a block.
    pub fn set<const M: usize, const W: usize>(
        &mut self,
        block: Block<W>,
        value: &SMatrix<f64, M, W>,
    ) {
        debug_assert_eq!(M, self.rows);
        self.set_rows(0, block, value);
    }

    /// The same, to be made in one expression.
    #[must_use]
    pub fn with<const M: usize, const W: usize>(
        mut self,
        block: Block<W>,
        value: &SMatrix<f64, M, W>,
    ) -> Self {
        self.set(block, value);
        self
    }

    /// Sets the rows of a block from `first` on.
    pub fn set_rows<const M: usize, const W: usize>(
        &mut self,
        first: usize,
        block: Block<W>,
        value: &SMatrix<f64, M, W>,
    ) {
        let at = self.make(block.key(), W);
        for (column, own) in value.column_iter().enumerate() {
            let start = at + column * self.rows + first;
            self.values[start..start + M].copy_from_slice(own.into_owned().as_slice());
        }
    }

    /// Sets all rows of a block whose width is known at run time: a column for each of its states.
    pub fn set_columns(&mut self, key: Key, columns: &DMatrix<f64>) {
        debug_assert_eq!(columns.nrows(), self.rows);
        let at = self.make(key, columns.ncols());
        self.values[at..at + columns.len()].copy_from_slice(columns.as_slice());
    }

    /// What a block's columns are; zero if it does not depend on it.
    #[must_use]
    pub fn of<const W: usize>(&self, block: Block<W>) -> DMatrix<f64> {
        match self.find(block.key()) {
            Some(at) => {
                DMatrix::from_column_slice(self.rows, W, &self.values[at..at + W * self.rows])
            }
            None => DMatrix::zeros(self.rows, W),
        }
    }

    /// Some of its rows, in this order.
    #[must_use]
    pub fn select(&self, rows: &[usize]) -> Self {
        let columns = self.values.chunks_exact(self.rows.max(1));
        let values = columns.flat_map(|column| rows.iter().map(move |row| column[*row])).collect();
        Jacobian { rows: rows.len(), blocks: self.blocks.clone(), values }
    }

    /// The rows of all, below each other in this order.
    pub(crate) fn stacked<'a>(all: impl Iterator<Item = &'a Jacobian> + Clone) -> Self {
        let mut stack = Jacobian::none(all.clone().map(Jacobian::rows).sum());
        let mut first = 0;
        for own in all {
            let mut from = 0;
            for (key, width) in &own.blocks {
                let at = stack.make(*key, *width);
                for column in 0..*width {
                    let to = at + column * stack.rows + first;
                    let values = &own.values[from..from + own.rows];
                    stack.values[to..to + own.rows].copy_from_slice(values);
                    from += own.rows;
                }
            }
            first += own.rows;
        }
        stack
    }

    /// What it makes of errors: H x.
    #[must_use]
    pub fn times(&self, errors: &Errors) -> DVector<f64> {
        let mut product = DVector::zeros(self.rows);
        for (state, column) in self.columns(errors.layout()) {
            let x = errors.values()[state];
            product.iter_mut().zip(column).for_each(|(sum, h)| *sum += h * x);
        }
        product
    }

    /// Where the values of a block begin, zeros where it was not there.
    fn make(&mut self, key: Key, width: usize) -> usize {
        self.find(key).unwrap_or_else(|| {
            let at = self.values.len();
            self.blocks.push((key, width));
            self.values.resize(at + width * self.rows, 0.0);
            at
        })
    }

    fn find(&self, key: Key) -> Option<usize> {
        let mut at = 0;
        for (own, width) in &self.blocks {
            if *own == key {
                return Some(at);
            }
            at += width * self.rows;
        }
        None
    }

    /// Each column that is there and not zero, with the index of its state.
    pub(crate) fn columns(&self, layout: &Layout) -> Vec<(usize, &[f64])> {
        let mut all = Vec::with_capacity(self.values.len() / self.rows.max(1));
        let mut columns = self.values.chunks_exact(self.rows.max(1));
        for (key, width) in &self.blocks {
            let start = layout.start(*key);
            for (component, column) in columns.by_ref().take(*width).enumerate() {
                if let Some(start) = start.filter(|_| column.iter().any(|value| *value != 0.0)) {
                    all.push((start + component, column));
                }
            }
        }
        all
    }

    /// As a matrix in the order of a layout.
    #[must_use]
    pub fn to_matrix(&self, layout: &Layout) -> DMatrix<f64> {
        let mut h = DMatrix::zeros(self.rows, layout.states());
        for (state, column) in self.columns(layout) {
            h.column_mut(state).copy_from_slice(column);
        }
        h
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Matrix1x2, Matrix2, Vector2};

    const A: Block<2> = Block::new(0);
    const B: Block<1> = Block::new(1);

    #[test]
    fn columns_find_their_states_by_name() {
        let h = Jacobian::none(2)
            .with(A, &Matrix2::new(1.0, 2.0, 3.0, 4.0))
            .with(B, &Vector2::new(5.0, 6.0));
        let layout = Layout::of_blocks([(B.key(), 1), (A.key(), 2)]);
        let matrix = DMatrix::from_row_slice(2, 3, &[5.0, 1.0, 2.0, 6.0, 3.0, 4.0]);
        assert_eq!(h.to_matrix(&layout), matrix);
        assert_eq!(h.to_matrix(&layout.without(B.key())), matrix.columns(1, 2));
        assert_eq!(h.select(&[1]).to_matrix(&layout), matrix.rows(1, 1));
    }

    #[test]
    fn rows_of_all_stand_below_each_other() {
        let one = Jacobian::none(1).with(A, &Matrix1x2::new(1.0, 2.0));
        let other = Jacobian::none(2).with(B, &Vector2::new(3.0, 4.0));
        let layout = Layout::of_blocks([(A.key(), 2), (B.key(), 1)]);
        let expected =
            DMatrix::from_row_slice(3, 3, &[1.0, 2.0, 0.0, 0.0, 0.0, 3.0, 0.0, 0.0, 4.0]);
        assert_eq!(Jacobian::stacked([&one, &other].into_iter()).to_matrix(&layout), expected);
    }
}
