//! Symmetric matrices, half of which is kept.

use nalgebra::DMatrix;

use crate::covariance::Covariance;
use crate::layout::Layout;

/// The upper triangle by columns, each down to its diagonal.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Triangle {
    states: usize,
    values: Vec<f64>,
}

impl Triangle {
    pub(crate) fn of(matrix: &DMatrix<f64>) -> Self {
        let states = matrix.nrows();
        let mut values = Vec::with_capacity(states * (states + 1) / 2);
        for column in 0..states {
            values.extend_from_slice(&matrix.as_slice()[column * states..][..=column]);
        }
        Triangle { states, values }
    }

    /// The whole matrix.
    pub(crate) fn whole(&self) -> DMatrix<f64> {
        let mut whole = DMatrix::zeros(self.states, self.states);
        let mut values = self.values.iter();
        for column in 0..self.states {
            for (row, value) in (0..=column).zip(&mut values) {
                whole[(row, column)] = *value;
                whole[(column, row)] = *value;
            }
        }
        whole
    }
}

/// A covariance that is put away, in half the room.
#[derive(Clone, Debug, PartialEq)]
pub struct KeptCovariance {
    layout: Layout,
    triangle: Triangle,
}

impl KeptCovariance {
    /// Of a covariance as it is.
    #[must_use]
    pub fn of(p: &Covariance) -> Self {
        KeptCovariance { layout: p.layout().clone(), triangle: Triangle::of(p.matrix()) }
    }

    /// The covariance.
    #[must_use]
    pub fn taken_out(&self) -> Covariance {
        Covariance::new(self.layout.clone(), self.triangle.whole())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::Block;
    use nalgebra::{Matrix1, Matrix2};

    #[test]
    fn what_is_put_away_is_taken_out_to_the_bit() {
        let mut p = Covariance::none();
        p.join(Block::<2>::new(4), &Matrix2::new(2.0, 0.3, 0.3, 1.0));
        p.join(Block::<1>::new(1), &Matrix1::new(0.1 + 0.2));
        assert_eq!(KeptCovariance::of(&p).taken_out(), p);
    }
}
