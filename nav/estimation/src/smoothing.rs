//! What is known afterwards: fixed-interval smoothing.
//!
//! Backwards over the stretches of a [`KeptTrail`], with T, l and L of each,
//!
//! lambda_k = l + T^T lambda_k+1,   Lambda_k = L + T^T Lambda_k+1 T,
//!
//! both zero at the end; then all that was measured says of the errors at k, whose covariance was P,
//!
//! x_k = P lambda_k,   P_k = P - P Lambda_k P
//!
//! (Bierman, Int. J. Control 18 (1973); the result is that of Rauch, Tung and Striebel, AIAA J. 3 (1965), but no covariance is inverted,
//! and a state of which nothing is in doubt does no harm). Of a block that joins during a stretch nothing is said of what was before, of
//! one that leaves nothing is measured afterwards. Held by `smoothing_is_the_least_squares_fit_of_all_that_was_measured` and
//! `what_joins_leaves_and_is_cloned_is_smoothed_as_if_it_had_always_been_there`.

use nalgebra::{DMatrix, DVector};

use crate::covariance::Covariance;
use crate::errors::Errors;
use crate::layout::{Layout, Place};
use crate::trail::KeptTrail;

/// What was measured after an instant, of the errors at that instant.
#[derive(Clone, Debug, PartialEq)]
pub struct Hindsight {
    layout: Layout,
    /// lambda.
    gradient: DVector<f64>,
    /// Lambda.
    information: DMatrix<f64>,
}

impl Hindsight {
    /// At the end, after which nothing was measured.
    #[must_use]
    pub fn none() -> Self {
        let layout = Layout::empty();
        Hindsight { layout, gradient: DVector::zeros(0), information: DMatrix::zeros(0, 0) }
    }

    /// That of the instant at which a stretch begins, of this one at its end.
    #[must_use]
    pub fn before(&self, stretch: &KeptTrail) -> Self {
        let mut at_end = self.clone();
        at_end.conform(&stretch.ended);
        let t = &stretch.transition;
        let carried = t.tr_mul(&(&at_end.information * t));
        let carried = (&carried + carried.transpose()) * 0.5;
        Hindsight {
            layout: stretch.begun.clone(),
            gradient: &stretch.gradient + t.tr_mul(&at_end.gradient),
            information: stretch.information.whole() + carried,
        }
    }

    /// What it says of the errors of the states that were wanted of a covariance, as that was then; and their covariance with it.
    #[must_use]
    pub fn of(&self, kept: &KeptCovariance) -> (Errors, Covariance) {
        let KeptCovariance { layout, wanted, rows } = kept;
        let mut now = self.clone();
        now.conform(layout);
        let told = rows * &now.gradient;
        let lowered = rows * now.information * rows.transpose();
        let p = kept.own() - (&lowered + lowered.transpose()) * 0.5;
        (Errors::new(wanted.clone(), told), Covariance::new(wanted.clone(), p))
    }

    /// Takes on the states of a layout: of new ones nothing was measured.
    fn conform(&mut self, layout: &Layout) {
        if self.layout == *layout {
            return;
        }
        let gradient = Errors::new(self.layout.clone(), std::mem::take(&mut self.gradient));
        self.gradient = gradient.in_order_of(layout);
        let information = std::mem::take(&mut self.information);
        let mut wide = Covariance::new(self.layout.clone(), information);
        wide.conform(layout);
        self.information = wide.matrix().clone();
        self.layout = layout.clone();
    }
}

/// What has to be known of a covariance, so that some of its states can be smoothed: its rows that belong to them.
#[derive(Clone, Debug, PartialEq)]
pub struct KeptCovariance {
    layout: Layout,
    wanted: Layout,
    rows: DMatrix<f64>,
}

impl KeptCovariance {
    /// Of a covariance as it is, for states of which it may have some or all.
    #[must_use]
    pub fn of(p: &Covariance, wanted: &Layout) -> Self {
        let mut rows = DMatrix::zeros(wanted.states(), p.states());
        for (to, from) in both(wanted, p.layout()) {
            rows.rows_mut(to.start, to.width).copy_from(&p.matrix().rows(from.start, to.width));
        }
        KeptCovariance { layout: p.layout().clone(), wanted: wanted.clone(), rows }
    }

    /// The covariance of the states that are wanted.
    fn own(&self) -> DMatrix<f64> {
        let mut own = DMatrix::zeros(self.wanted.states(), self.wanted.states());
        for (to, from) in both(&self.wanted, &self.layout) {
            own.columns_mut(to.start, to.width).copy_from(&self.rows.columns(from.start, to.width));
        }
        own
    }
}

/// Where states stand that two layouts have.
fn both<'a>(to: &'a Layout, from: &'a Layout) -> impl Iterator<Item = (Place, Place)> + 'a {
    to.places().iter().filter_map(|to| Some((*to, from.place(to.key)?)))
}
