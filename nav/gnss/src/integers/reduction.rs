//! A basis of the lattice in which the search is short.

use nalgebra::{DMatrix, DVector};

/// A covariance as `Z' Q Z = L' D L`: L lower triangular with ones, Z integer with an integer inverse.
#[derive(Clone, Debug)]
pub(super) struct Reduced {
    /// Below the diagonal.
    pub(super) l: DMatrix<f64>,
    /// Conditional variances: of each number in the light of those after it.
    pub(super) d: Vec<f64>,
    /// Columns of Z.
    z: Vec<Vec<i64>>,
    /// Columns of Z' inverted, which takes integers back.
    inverse: Vec<Vec<i64>>,
}

impl Reduced {
    /// `None` unless the covariance is positive definite.
    pub(super) fn new(covariance: &DMatrix<f64>) -> Option<Self> {
        let count = covariance.nrows();
        let unit = |column: usize| (0..count).map(|row| i64::from(row == column)).collect();
        let columns: Vec<Vec<i64>> = (0..count).map(unit).collect();
        let mut reduced = Self {
            l: DMatrix::identity(count, count),
            d: vec![0.0; count],
            z: columns.clone(),
            inverse: columns,
        };
        reduced.factor(covariance)?;
        reduced.reduce()?;
        Some(reduced)
    }

    /// `Q = L' D L` from the last column on, each time with the number that is left with the least variance (Chang, Yang and Zhou 2005, 3.1).
    fn factor(&mut self, covariance: &DMatrix<f64>) -> Option<()> {
        let mut rest = covariance.clone();
        let greatest = rest.diagonal().amax();
        for k in (0..rest.nrows()).rev() {
            let least = (0..=k).min_by(|a, b| rest[(*a, *a)].total_cmp(&rest[(*b, *b)]))?;
            rest.swap_rows(k, least);
            rest.swap_columns(k, least);
            self.swap(k, least);
            // rows below k of what is done follow the exchange of the columns
            for row in k + 1..rest.nrows() {
                self.l.swap((row, k), (row, least));
            }
            let variance = rest[(k, k)];
            if variance <= 1e-15 * greatest {
                return None;
            }
            self.d[k] = variance;
            for j in 0..k {
                self.l[(k, j)] = rest[(k, j)] / variance;
            }
            for i in 0..k {
                for j in 0..k {
                    rest[(i, j)] -= variance * self.l[(k, i)] * self.l[(k, j)];
                }
            }
        }
        Some(())
    }

    /// Neighbours change places where that lets the later one have less variance; what an integer can be made smaller by is done no sooner than needed
    /// (3.2 and 3.3 there).
    fn reduce(&mut self) -> Option<()> {
        // an exchange that gains next to nothing may go on for ever
        const GAIN: f64 = 1.0 - 1e-9;
        let count = self.d.len();
        let Some(mut k) = count.checked_sub(2) else { return Some(()) };
        loop {
            let below = self.l[(k + 1, k)];
            let left = below - below.round();
            if self.d[k] + left * left * self.d[k + 1] < GAIN * self.d[k + 1] {
                for i in k + 1..count {
                    self.shrink(i, k)?;
                }
                self.exchange(k);
                k = (k + 1).min(count - 2);
            } else if k == 0 {
                break;
            } else {
                k -= 1;
            }
        }
        for column in 0..count {
            for row in column + 1..count {
                self.shrink(row, column)?;
            }
        }
        Some(())
    }

    /// An integer multiple of number `i` is taken from number `j`, so that `|l_ij| <= 1/2`. `None` where integers grow beyond counting, as
    /// they do of a covariance that is all but singular.
    fn shrink(&mut self, i: usize, j: usize) -> Option<()> {
        let multiple = self.l[(i, j)].round();
        if multiple == 0.0 {
            return Some(());
        }
        for row in i..self.d.len() {
            let part = multiple * self.l[(row, i)];
            self.l[(row, j)] -= part;
        }
        let whole = multiple as i64;
        for row in 0..self.d.len() {
            let (forth, back) = (self.z[i][row], self.inverse[j][row]);
            self.z[j][row] = self.z[j][row].checked_sub(whole.checked_mul(forth)?)?;
            self.inverse[i][row] = self.inverse[i][row].checked_add(whole.checked_mul(back)?)?;
        }
        Some(())
    }

    /// Numbers k and k + 1 change places.
    fn exchange(&mut self, k: usize) {
        let below = self.l[(k + 1, k)];
        let later = self.d[k] + below * below * self.d[k + 1];
        let eta = self.d[k] / later;
        let lambda = self.d[k + 1] * below / later;
        self.d[k] = eta * self.d[k + 1];
        self.d[k + 1] = later;
        for j in 0..k {
            let (upper, lower) = (self.l[(k, j)], self.l[(k + 1, j)]);
            self.l[(k, j)] = lower - below * upper;
            self.l[(k + 1, j)] = eta * upper + lambda * lower;
        }
        self.l[(k + 1, k)] = lambda;
        for row in k + 2..self.d.len() {
            self.l.swap((row, k), (row, k + 1));
        }
        self.swap(k, k + 1);
    }

    fn swap(&mut self, i: usize, j: usize) {
        self.z.swap(i, j);
        self.inverse.swap(i, j);
    }

    /// Conditional variances.
    pub(super) fn variances(&self) -> impl Iterator<Item = f64> + '_ {
        self.d.iter().copied()
    }

    /// `Z' a`.
    pub(super) fn forth(&self, measured: &DVector<f64>) -> DVector<f64> {
        let entry = |column: &Vec<i64>| {
            column.iter().zip(measured.iter()).map(|(own, x)| *own as f64 * x).sum::<f64>()
        };
        DVector::from_iterator(self.d.len(), self.z.iter().map(entry))
    }

    /// `Z'^-1 z`; `None` where it cannot be counted.
    pub(super) fn back(&self, integers: &[i64]) -> Option<Vec<i64>> {
        let mut back = vec![0_i64; self.d.len()];
        for (column, integer) in self.inverse.iter().zip(integers) {
            for (own, entry) in back.iter_mut().zip(column) {
                *own = own.checked_add(entry.checked_mul(*integer)?)?;
            }
        }
        Some(back)
    }
}
