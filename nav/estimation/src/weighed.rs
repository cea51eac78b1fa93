//! The Kalman update.

use std::cell::OnceCell;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use crate::covariance::Covariance;
use crate::effects::Effects;
use crate::errors::Errors;
use crate::innovation::Innovation;
use crate::key::Key;
use crate::layout::Layout;
use crate::sums::{add_all, axpy, column, column_mut, solve_right, solve_right_transposed};

/// An innovation with its covariance factored, S = L L^T: ready to be judged and applied.
#[derive(Clone, Debug)]
pub struct Weighed {
    innovation: Innovation,
    layout: Layout,
    /// P H^T.
    pht: DMatrix<f64>,
    factor: Cholesky<f64, Dyn>,
    /// W = P H^T L^-T, once it is asked for.
    root: OnceCell<DMatrix<f64>>,
}

/// Where the innovation is so many times as uncertain as the noise of one of its rows, as variances, the difference of
/// covariances is not far from rounding.
const SURE: f64 = 1e9;

impl Innovation {
    /// Computes S = H P H^T + R and factors it; `None` if S is not positive definite or a value is
    /// not finite.
    #[must_use]
    pub fn weigh(&self, p: &Covariance) -> Option<Weighed> {
        if self.rows() == 0 || !self.z.iter().all(|x| x.is_finite()) {
            return None;
        }
        let columns = self.h.columns(p.layout());
        let pht = p_h_transposed(p.matrix(), &columns, self.rows());
        let mut s = self.r.clone();
        for (state, column) in &columns {
            for row in 0..self.rows() {
                axpy(pht[(*state, row)], column, column_mut(&mut s, row));
            }
        }
        let factor = Cholesky::new(symmetric(s))?;
        let layout = p.layout().clone();
        Some(Weighed { innovation: self.clone(), layout, pht, factor, root: OnceCell::new() })
    }
}

impl Weighed {
    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.innovation.rows()
    }

    /// The states of the covariance that it was weighed with.
    #[must_use]
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// The innovation.
    #[must_use]
    pub fn z(&self) -> &DVector<f64> {
        &self.innovation.z
    }

    /// The innovation with all that belongs to it.
    #[must_use]
    pub fn innovation(&self) -> &Innovation {
        &self.innovation
    }

    /// Covariance of the errors (rows) with the innovation: P H^T.
    #[must_use]
    pub fn cross(&self) -> &DMatrix<f64> {
        &self.pht
    }

    /// Covariance of the innovation, S.
    #[must_use]
    pub fn covariance(&self) -> DMatrix<f64> {
        let l = self.factor.l();
        &l * l.transpose()
    }

    /// Normalised innovation squared, z^T S^-1 z: chi-square with as many degrees of freedom as rows.
    #[must_use]
    pub fn nis(&self) -> f64 {
        self.whitened().norm_squared()
    }

    /// Half the logarithm of det S.
    #[must_use]
    pub fn log_root_determinant(&self) -> f64 {
        self.factor.l_dirty().diagonal().iter().map(|d| d.ln()).sum()
    }

    /// 1-sigma that the filter expects of each row.
    #[must_use]
    pub fn sigma(&self) -> DVector<f64> {
        let l = self.factor.l_dirty();
        DVector::from_fn(self.rows(), |i, _| l.view((i, 0), (1, i + 1)).norm())
    }

    /// The optimal gain, P H^T S^-1.
    #[must_use]
    pub fn gain(&self) -> DMatrix<f64> {
        let mut gain = self.root().clone();
        solve_right(&mut gain, self.factor.l_dirty());
        gain
    }

    /// What a unit of one row moves the errors by: a column of the gain.
    #[must_use]
    pub fn gain_of(&self, row: usize) -> Errors {
        Errors::new(self.layout.clone(), self.gain().column(row).into_owned())
    }

    /// The innovation in units of its sigmas, L^-1 z: white, and one each, if the filter is right.
    #[must_use]
    pub fn whitened(&self) -> DVector<f64> {
        let mut z = self.innovation.z.clone();
        self.factor.l_dirty().solve_lower_triangular_mut(&mut z);
        z
    }

    /// W = P H^T L^-T, so that K = W L^-1 and K S K^T = W W^T.
    fn root(&self) -> &DMatrix<f64> {
        self.root.get_or_init(|| {
            let mut w = self.pht.clone();
            solve_right_transposed(&mut w, self.factor.l_dirty());
            w
        })
    }

    /// Kalman update: returns the estimated error and lowers the covariance, which must be the one that
    /// [`Innovation::weigh`] saw.
    ///
    /// P <- P - W W^T keeps P exactly symmetric. A measurement that is all but perfect goes through Joseph's form instead.
    #[must_use]
    pub fn update(&self, p: &mut Covariance) -> Errors {
        if self.is_all_but_perfect() {
            return self.update_with(p, &self.gain());
        }
        self.leave_trail(p);
        let w = self.root();
        self.lower(p, w);
        Errors::new(self.layout.clone(), w * self.whitened())
    }

    /// Update that leaves some blocks as they are, and what is known of them, but not how they hang together with the
    /// others: considered states (Schmidt, Advances in Control Systems 3 (1966)).
    ///
    /// Their rows of the gain are zero. Any gain K is the best one and D = K L - W more than it, and
    /// costs D D^T, which for this one is W W^T among the considered states.
    #[must_use]
    pub fn update_considering(&self, p: &mut Covariance, considered: &[Key]) -> Errors {
        self.leave_trail(p);
        let mut w = self.root().clone();
        let mut kept = DMatrix::zeros(w.nrows(), w.ncols());
        for place in considered.iter().filter_map(|key| self.layout.place(*key)) {
            let own = w.rows(place.start, place.width).into_owned();
            kept.rows_mut(place.start, place.width).copy_from(&own);
        }
        self.lower(p, &w);
        add_product(p.p_mut(), &kept, 1.0);
        w -= kept;
        Errors::new(self.layout.clone(), w * self.whitened())
    }

    /// Update with a gain of one's own choice, states by rows: Joseph's form,
    /// P <- (I - K H) P (I - K H)^T + K R K^T.
    #[must_use]
    pub fn update_with(&self, p: &mut Covariance, gain: &DMatrix<f64>) -> Errors {
        debug_assert_eq!(self.layout, *p.layout());
        self.leave_trail(p);
        let states = p.states();
        let mut left = DMatrix::identity(states, states);
        for (state, weights) in self.innovation.h.columns(&self.layout) {
            for (row, weight) in weights.iter().enumerate() {
                axpy(-weight, column(gain, row), column_mut(&mut left, state));
            }
        }
        let matrix = p.p_mut();
        let lowered = &left * &*matrix * left.transpose();
        *matrix = lowered + gain * &self.innovation.r * gain.transpose();
        p.symmetrise();
        Errors::new(self.layout.clone(), gain * &self.innovation.z)
    }

    fn lower(&self, p: &mut Covariance, w: &DMatrix<f64>) {
        debug_assert_eq!(self.layout, *p.layout());
        add_product(p.p_mut(), w, -1.0);
    }

    /// The trail is told of the update with the best gain: what another one costs is noise.
    fn leave_trail(&self, p: &mut Covariance) {
        let Some(trail) = p.trail_mut() else { return };
        let none = DMatrix::zeros(trail.effects().causes(), self.rows());
        let told = self.effect_of(trail.effects(), none);
        trail.hear(&told, &self.whitened());
        self.pass_on(trail.effects_mut(), &told);
    }

    fn is_all_but_perfect(&self) -> bool {
        let s = self.sigma();
        (0..self.rows()).any(|i| s[i] * s[i] > SURE * self.innovation.r[(i, i)])
    }

    /// What causes do to the innovation in units of its sigmas, a row for each cause: (L^-1 (H U + D))^T, D^T what they do to
    /// the measurement itself. They have the states of the covariance that was weighed.
    #[must_use]
    pub fn effect_of(&self, effects: &Effects, direct: DMatrix<f64>) -> DMatrix<f64> {
        debug_assert_eq!(self.layout, *effects.layout());
        let mut effect = direct;
        let columns = self.innovation.h.columns(&self.layout);
        for row in 0..self.rows() {
            let terms =
                columns.iter().map(|(state, by)| (by[row], column(effects.matrix(), *state)));
            add_all(terms, column_mut(&mut effect, row));
        }
        self.whiten(effect)
    }

    /// What causes do to the innovation, a row for each cause, in units of its sigmas: E^T L^-T.
    #[must_use]
    pub fn whiten(&self, mut effect: DMatrix<f64>) -> DMatrix<f64> {
        solve_right_transposed(&mut effect, self.factor.l_dirty());
        effect
    }

    /// Takes from the effects of causes what the update takes from them, U <- U - K (H U + D); `effect` is what
    /// [`Weighed::effect_of`] gave.
    pub fn pass_on(&self, effects: &mut Effects, effect: &DMatrix<f64>) {
        debug_assert_eq!(self.layout, *effects.layout());
        Self::pass_on_with(effects, effect, self.root());
    }

    /// The same of an update with another gain, states by rows.
    pub fn pass_on_by(&self, effects: &mut Effects, effect: &DMatrix<f64>, gain: &DMatrix<f64>) {
        // (H U + D)^T from what is in units of sigmas
        let told = effect * self.factor.l().transpose();
        Self::pass_on_with(effects, &told, gain);
    }

    fn pass_on_with(effects: &mut Effects, effect: &DMatrix<f64>, by: &DMatrix<f64>) {
        let causes = effects.causes().max(1);
        let states = effects.matrix_mut().as_mut_slice().chunks_exact_mut(causes);
        for (state, own) in states.enumerate() {
            let rows = effect.as_slice().chunks_exact(causes).enumerate();
            add_all(rows.map(|(row, told)| (-by[(state, row)], told)), own);
        }
    }
}

/// P H^T, by the columns of H that are not empty.
fn p_h_transposed(p: &DMatrix<f64>, columns: &[(usize, &[f64])], rows: usize) -> DMatrix<f64> {
    let mut pht = DMatrix::zeros(p.nrows(), rows);
    for row in 0..rows {
        let terms = columns.iter().map(|(state, by)| (by[row], column(p, *state)));
        add_all(terms.filter(|(by, _)| *by != 0.0), column_mut(&mut pht, row));
    }
    pht
}

fn symmetric(s: DMatrix<f64>) -> DMatrix<f64> {
    let transposed = s.transpose();
    (s + transposed) * 0.5
}

/// P <- P + sign W W^T, both halves alike to the bit: one is reckoned, and copied into the other.
fn add_product(p: &mut DMatrix<f64>, w: &DMatrix<f64>, sign: f64) {
    let states = p.nrows().max(1);
    for (j, own) in p.as_mut_slice().chunks_exact_mut(states).enumerate() {
        let terms = w.as_slice().chunks_exact(states).map(|of_w| (sign * of_w[j], &of_w[j..]));
        add_all(terms, &mut own[j..]);
    }
    p.fill_upper_triangle_with_lower_triangle();
}
