//! A covariance of many states, most of which have to do with few others.

use nalgebra::{DMatrix, DVector};

/// The covariance.
#[derive(Clone, Debug)]
pub(super) struct Knowledge {
    p: DMatrix<f64>,
}

impl Knowledge {
    /// Of `size` states, about which everything is known.
    pub(super) fn new(size: usize) -> Self {
        Knowledge { p: DMatrix::zeros(size, size) }
    }

    /// Forgets all that is known of a state but that it has this variance.
    pub(super) fn reset(&mut self, place: usize, variance: f64) {
        self.p.row_mut(place).fill(0.0);
        self.p.column_mut(place).fill(0.0);
        self.p[(place, place)] = variance;
    }

    /// A state becomes what another one is now.
    pub(super) fn copy(&mut self, from: usize, to: usize) {
        let row = self.p.row(from).into_owned();
        self.p.row_mut(to).copy_from(&row);
        let column = self.p.column(from).into_owned();
        self.p.column_mut(to).copy_from(&column);
    }

    /// Adds the same random number, of this variance, to several states.
    pub(super) fn add_together(&mut self, places: &[usize], variance: f64) {
        for one in places {
            places.iter().for_each(|other| self.p[(*one, *other)] += variance);
        }
    }

    /// x <- m x + w of one state, w of this variance.
    pub(super) fn decay(&mut self, place: usize, m: f64, variance: f64) {
        self.p.row_mut(place).scale_mut(m);
        self.p.column_mut(place).scale_mut(m);
        self.p[(place, place)] += variance;
    }

    /// x <- Phi x + w of the states from `start` on, w of covariance `added`.
    pub(super) fn carry(&mut self, start: usize, phi: &DMatrix<f64>, added: &DMatrix<f64>) {
        let size = phi.nrows();
        let rows = phi * self.p.rows(start, size);
        self.p.rows_mut(start, size).copy_from(&rows);
        let columns = self.p.columns(start, size) * phi.transpose();
        self.p.columns_mut(start, size).copy_from(&columns);
        let mut own = self.p.view_mut((start, start), (size, size));
        own += added;
    }

    /// Takes a measurement of a weighted sum of states into account, whose noise has this variance: P <- P - P h h' P / (h' P h + r).
    pub(super) fn measure(&mut self, h: &[(usize, f64)], variance: f64) {
        let mut ph = DVector::zeros(self.p.nrows());
        for (place, factor) in h {
            ph.axpy(*factor, &self.p.column(*place), 1.0);
        }
        let s: f64 = h.iter().map(|(place, factor)| ph[*place] * factor).sum::<f64>() + variance;
        if s > 0.0 {
            self.p.ger(-1.0 / s, &ph, &ph, 1.0);
        }
    }

    /// Variance of a weighted sum of states.
    pub(super) fn variance(&self, h: &[(usize, f64)]) -> f64 {
        let pairs = h.iter().flat_map(|a| h.iter().map(move |b| (a, b)));
        pairs.map(|(a, b)| a.1 * b.1 * self.p[(a.0, b.0)]).sum::<f64>().max(0.0)
    }
}
