//! What has become of errors since an instant, and what was measured of them meanwhile.
//!
//! Whoever wants to know later what everything that was measured after an instant says of the errors at that instant needs no history of the
//! filter: it is all in three matrices. With T what has become of the errors x at the beginning, x_now = T x + noise, each propagation makes
//! T <- Phi T and each update by an innovation z = H x_now + v of covariance S
//!
//! l <- l + (H T)^T S^-1 z,   L <- L + (H T)^T S^-1 (H T),   T <- (I - K H) T
//!
//! (Bierman, Fixed interval smoothing with discrete measurements, Int. J. Control 18 (1973), the recursion run forwards). The
//! estimate is corrected with each update, so that z is always that of a filter whose errors are thought to be zero. K is the best gain:
//! what another one costs, and whatever else makes the covariance wider, is noise and leaves no trace here. A block that joins has come of
//! nothing, one that leaves is forgotten, a clone has come of what its original has.

use nalgebra::{DMatrix, DVector, Matrix2, SMatrix};

use crate::effects::Effects;
use crate::layout::Layout;
use crate::sums::{add_all, column_mut};
use crate::triangle::Triangle;

/// A trail that is being kept.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorTrail {
    begun: Layout,
    /// T^T: a row for each error at the beginning.
    become_of: Effects,
    gradient: DVector<f64>,
    information: DMatrix<f64>,
}

impl ErrorTrail {
    pub(crate) fn new(layout: &Layout) -> Self {
        let states = layout.states();
        ErrorTrail {
            begun: layout.clone(),
            become_of: Effects::identity(layout),
            gradient: DVector::zeros(states),
            information: DMatrix::zeros(states, states),
        }
    }

    /// The trail as it is kept: from its beginning to now.
    #[must_use]
    pub fn kept(&self) -> KeptTrail {
        KeptTrail {
            begun: self.begun.clone(),
            ended: self.become_of.layout().clone(),
            transition: self.become_of.matrix().transpose(),
            gradient: self.gradient.clone(),
            information: Triangle::of(&self.information),
        }
    }

    pub(crate) fn effects_mut(&mut self) -> &mut Effects {
        &mut self.become_of
    }

    pub(crate) fn conform(&mut self, layout: &Layout) {
        self.become_of.conform(layout);
    }

    /// So many errors from a place on have come of nothing that was there at the beginning.
    pub(crate) fn forget(&mut self, start: usize, width: usize) {
        self.become_of.matrix_mut().columns_mut(start, width).fill(0.0);
    }

    pub(crate) fn copy<const W: usize>(&mut self, from: usize, to: usize) {
        let columns = self.become_of.matrix().fixed_columns::<W>(from).into_owned();
        self.become_of.matrix_mut().fixed_columns_mut::<W>(to).copy_from(&columns);
    }

    /// x <- A x of neighbouring errors.
    pub(crate) fn transform<const W: usize>(&mut self, start: usize, by: &SMatrix<f64, W, W>) {
        let matrix = self.become_of.matrix_mut();
        let turned = matrix.fixed_columns::<W>(start) * by.transpose();
        matrix.fixed_columns_mut::<W>(start).copy_from(&turned);
    }

    /// y <- y + A x.
    pub(crate) fn add_to<const V: usize, const W: usize>(
        &mut self,
        from: usize,
        to: usize,
        by: &SMatrix<f64, V, W>,
    ) {
        let matrix = self.become_of.matrix_mut();
        let more = matrix.fixed_columns::<W>(from) * by.transpose();
        let mut own = matrix.fixed_columns_mut::<V>(to);
        own += more;
    }

    /// Two errors that stand apart carry on together.
    pub(crate) fn carry_pair(&mut self, (x, v): (usize, usize), by: &Matrix2<f64>) {
        let matrix = self.become_of.matrix_mut();
        for row in 0..matrix.nrows() {
            let (old_x, old_v) = (matrix[(row, x)], matrix[(row, v)]);
            matrix[(row, x)] = by[(0, 0)] * old_x + by[(0, 1)] * old_v;
            matrix[(row, v)] = by[(1, 0)] * old_x + by[(1, 1)] * old_v;
        }
    }

    /// What has become of the errors.
    pub(crate) fn effects(&self) -> &Effects {
        &self.become_of
    }

    /// An innovation, whitened (L^-1 z), has told of the errors at the beginning: (H T)^T L^-T, a row for each of them.
    pub(crate) fn hear(&mut self, told: &DMatrix<f64>, z: &DVector<f64>) {
        let causes = told.nrows();
        let columns = || told.as_slice().chunks_exact(causes.max(1));
        add_all(z.iter().copied().zip(columns()), self.gradient.as_mut_slice());
        for state in 0..causes {
            let own = column_mut(&mut self.information, state);
            add_all(columns().map(|column| (column[state], column)), own);
        }
    }
}

/// A stretch of a trail that is over, as it is kept.
#[derive(Clone, Debug, PartialEq)]
pub struct KeptTrail {
    pub(crate) begun: Layout,
    pub(crate) ended: Layout,
    /// T: a row for each error at the end, a column for each at the beginning.
    pub(crate) transition: DMatrix<f64>,
    /// l.
    pub(crate) gradient: DVector<f64>,
    /// L.
    pub(crate) information: Triangle,
}
