//! A Bayesian linear model of what a log says beyond the velocity over the Earth, beside a current that wanders.
//!
//! With u and v what the log says, r the rate of turn and psi the heading, forward and starboard:
//!
//! e_u = k u + s |u| u + b |r|   - (cos psi c_N + sin psi c_E) + w,
//! e_v = m u + q |u| u + t r     - (cos psi c_E - sin psi c_N) + w,
//!
//! k a scale factor, s its change with the speed, m a turn of the log, q its change with the speed, b and t what a hull adds as it slides through
//! a turn. x = [k, s, b, m, q, t, c_N, c_E]; the first six hardly change (fouling), c is Gauss-Markov. Kalman filter with the update in
//! Joseph's form (Bucy and Joseph, Filtering for Stochastic Processes, 1968). Held by
//! `what_repeats_is_found_beside_a_current_that_wanders`.

use nalgebra::{Matrix2, SMatrix, SVector, Vector2, Vector6};
use serde::{Deserialize, Serialize};

use crate::current::CurrentModel;
use crate::kept::{BY_TURN, KeptLog, REPEAT};
use crate::label::{LENGTH, Label};

/// With the current.
const ALL: usize = REPEAT + 2;
/// 1-sigma before anything is known: scale, its slope, s/m, what turns add forward, m; turn of the log, rad, its slope, s/m, and slide, m.
pub const PRIOR: [f64; REPEAT] = [0.03, 0.005, 5.0, 0.01, 0.003, 5.0];
/// The slide.
const SLIDE: usize = BY_TURN[1];
/// A log fouls by so much a day, 1-sigma, of each in units of its prior.
const FOULS: f64 = 0.07;
/// What is not of this model, 1-sigma in a label, m/s.
const UNMODELLED: f64 = 0.01;
/// Squares of innovations of which one in twenty thousand is larger: no label.
const GATE: f64 = 20.0;
/// How much likelier a current is to go on as it did on the voyage before, as a logarithm.
const FAMILIAR: f64 = 4.0;
const DAY: f64 = 86_400.0;

/// What repeats, with the covariance that is known to.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LogErrors {
    x: SVector<f64, ALL>,
    p: SMatrix<f64, ALL, ALL>,
    current: CurrentModel,
    last: Option<f64>,
    /// Sum of the log-likelihoods of what was heard.
    score: f64,
}

/// What became of a label.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Heard {
    /// Whether it was learnt from.
    pub(crate) is_used: bool,
}

impl LogErrors {
    /// Nothing is known but how the current goes on.
    #[must_use]
    pub fn unknown(current: CurrentModel) -> Self {
        let c = current.std;
        let std = SVector::<f64, ALL>::from_fn(|i, _| PRIOR.get(i).copied().unwrap_or(c));
        let p = SMatrix::from_diagonal(&std.component_mul(&std));
        LogErrors { x: SVector::zeros(), p, current, last: None, score: 0.0 }
    }

    /// What was kept of an earlier voyage, in unknown waters.
    pub(crate) fn known(kept: &KeptLog, current: CurrentModel) -> Self {
        let mut own = Self::unknown(current);
        let (x, p) = kept.belief();
        own.x.fixed_rows_mut::<REPEAT>(0).copy_from(&x);
        own.p.fixed_view_mut::<REPEAT, REPEAT>(0, 0).copy_from(&p);
        let is_same = current.std == kept.current_std_mps && current.time == kept.current_time_s;
        own.score = if is_same { FAMILIAR } else { 0.0 };
        own
    }

    /// What was learnt of the slide may have been too little: it is as uncertain as at first.
    pub(crate) fn unsettle_slide(&mut self) {
        self.p.row_mut(SLIDE).fill(0.0);
        self.p.column_mut(SLIDE).fill(0.0);
        self.p[(SLIDE, SLIDE)] = PRIOR[SLIDE] * PRIOR[SLIDE];
    }

    /// What is kept of it.
    pub(crate) fn kept(&self) -> KeptLog {
        let p = self.p.fixed_view::<REPEAT, REPEAT>(0, 0).into_owned();
        KeptLog::of(&self.values(), &p, &self.current)
    }

    /// Scale, its slope, s/m, what turns add forward, m; turn of the log, rad, its slope, s/m, slide, m.
    #[must_use]
    pub fn values(&self) -> Vector6<f64> {
        self.x.fixed_rows::<REPEAT>(0).into_owned()
    }

    /// Their 1-sigmas.
    #[must_use]
    pub fn stds(&self) -> Vector6<f64> {
        self.p.diagonal().fixed_rows::<REPEAT>(0).map(|variance| variance.max(0.0).sqrt())
    }

    /// How the current goes on.
    #[must_use]
    pub fn current(&self) -> CurrentModel {
        self.current
    }

    /// Sum of log-likelihoods.
    #[must_use]
    pub(crate) fn score(&self) -> f64 {
        self.score
    }

    /// What repeats of a label, forward and starboard, m/s.
    #[must_use]
    pub fn repeats(&self, label: &Label) -> Vector2<f64> {
        let mut known = self.x;
        known.fixed_rows_mut::<2>(REPEAT).fill(0.0);
        rows(label) * known
    }

    /// Learns from a label.
    pub(crate) fn hear(&mut self, label: &Label) -> Heard {
        self.carry(label.time);
        let h = rows(label);
        let noise = label.variance.add_scalar(UNMODELLED * UNMODELLED);
        let s = h * self.p * h.transpose() + Matrix2::from_diagonal(&noise);
        let off = label.beyond - h * self.x;
        let Some(inverse) = s.try_inverse() else { return Heard { is_used: false } };
        let square = (off.transpose() * inverse * off).x;
        self.score -= 0.5 * (square.min(GATE) + s.determinant().ln());
        if square > GATE {
            return Heard { is_used: false };
        }
        let k = self.p * h.transpose() * inverse;
        let left = SMatrix::<f64, ALL, ALL>::identity() - k * h;
        self.x += k * off;
        self.p =
            left * self.p * left.transpose() + k * Matrix2::from_diagonal(&noise) * k.transpose();
        self.p = (self.p + self.p.transpose()) * 0.5;
        Heard { is_used: true }
    }

    fn carry(&mut self, now: f64) {
        let dt = self.last.replace(now).map_or(LENGTH, |last| (now - last).max(0.0));
        let left = (-dt / self.current.time).exp();
        for i in REPEAT..ALL {
            self.x[i] *= left;
            self.p.row_mut(i).scale_mut(left);
            self.p.column_mut(i).scale_mut(left);
            self.p[(i, i)] += self.current.std.powi(2) * (1.0 - left * left);
        }
        for (i, prior) in PRIOR.iter().enumerate() {
            if self.p[(i, i)] > 0.0 {
                self.p[(i, i)] += (FOULS * prior).powi(2) * dt / DAY;
            }
        }
    }
}

fn rows(label: &Label) -> SMatrix<f64, 2, ALL> {
    let (u, (cos, sin)) = (label.told.x, (label.bow.x, label.bow.y));
    let (square, turn) = (u.abs() * u, label.turn);
    SMatrix::<f64, 2, ALL>::from_row_slice(&[
        u,
        square,
        turn.abs(),
        0.0,
        0.0,
        0.0,
        -cos,
        -sin, //
        0.0,
        0.0,
        0.0,
        u,
        square,
        turn,
        sin,
        -cos,
    ])
}
