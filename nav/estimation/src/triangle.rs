//! Symmetric matrices, half of which is kept.

use nalgebra::DMatrix;

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_put_away_is_taken_out_to_the_bit() {
        let own = DMatrix::from_row_slice(3, 3, &[2.0, 0.3, 1e-9, 0.3, 1.0, 0.0, 1e-9, 0.0, 0.7]);
        assert_eq!(Triangle::of(&own).whole(), own);
    }
}
