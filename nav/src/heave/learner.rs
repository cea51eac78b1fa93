//! The covariance of the bank's errors at one point, learnt from the sea as it is.
//!
//! Some time after an instant the heave of that instant is known from both of its sides. Against it the
//! errors of all of the bank's signals are measured, and their covariance learnt, second by second:
//!
//! C = (n_0 C_model + sum w e e^T) / (n_0 + sum w) + guard,   w fading with age.
//!
//! The covariance of the model stands in for what has not been seen; the guard is a part of the sea as it
//! could be, so that the filter stays one for periods from 3 to 25 s in a sea that has only some of them.
//!
//! What the sections took away is seen at once, and tells whether the covariance still holds: if its
//! normalised square is too large, either the accelerometer drifts or the sea has changed. Noise and waves
//! are added to the covariance, as much of each as makes what was seen likeliest, and fade once it is seen
//! no more (as in Jazwinski, Adaptive Filtering, Automatica 5 (1969)). What was seen while the
//! accelerometer was in doubt counts the less in learning, and so does any single error that is beyond all
//! expectation (the weights of Huber, Robust Statistics, chapter 8).

use std::collections::VecDeque;

use super::bank::Signals;
use super::combine::{Combination, Fit, Taken, normalised_square, parts};
use super::model::{Errors, Model};

/// Memory of the errors' covariance, s.
const MEMORY: f64 = 500.0;
/// What the model's covariance counts for, in seconds of learning: for good, at the beginning, and how
/// many seconds it takes to lose what it counted for at the beginning.
const PRIOR: (f64, f64, f64) = (3.0, 30.0, 50.0);
/// Seconds of learning after which the covariance is held against what is seen.
const LEARNT: f64 = 30.0;
/// Seconds of learning after which the variance of the sum is twice what it seems to be.
const SCATTER: f64 = 30.0;
/// Factor of the variance before that, when all rests on the model.
const UNSURE: f64 = 1.5;
/// Heave of the guard over that of the sea.
const GUARD: f64 = 0.1;
/// Least heave of the sea that the guard allows for, 1-sigma, m.
const GUARDED: f64 = 0.2;
/// Heave of a sea that nothing is known of, 1-sigma, m, and how many seconds that counts for.
const UNKNOWN_SEA: (f64, f64) = (1.0, 10.0);
/// Memory of the power of the sea, s.
const SEA_MEMORY: f64 = 60.0;
/// Memory of what was seen, to be held against the covariance, s.
const SIGHT: f64 = 3.0;
/// Normalised square of what was seen beyond which the covariance is doubted.
const MISFIT: f64 = 2.5;
/// Time in which a doubt fades, s.
const FADING: f64 = 8.0;
/// Smallest doubt: variances added over those of the model.
const LEAST_DOUBT: Doubt = Doubt { drift: 0.25, sea: 0.003 };
/// How many fourfold steps it may grow.
const DRIFT_STEPS: i32 = 14;
const SEA_STEPS: i32 = 7;
/// Share of the random walk of the acceleration in a drift: that of the noise over ten seconds.
const DRIFT_WALK: f64 = 0.01;
/// Normalised square of errors from which they count the less in learning.
const SURPRISE: f64 = 3.0;
/// Least weight of a second in learning.
const LEAST_TRUST: f64 = 0.02;

/// What the IMU's data sheet says of the vertical.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Grade {
    /// White noise, (m/s)/sqrt(s).
    pub(super) noise: f64,
    /// Random walk of the acceleration, m/s^2/sqrt(s).
    pub(super) walk: f64,
    /// Constant error of the acceleration at the start, 1-sigma, m/s^2.
    pub(super) constant: f64,
}

/// Variance that is added to the covariance because it did not hold, over those of the model.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
struct Doubt {
    drift: f64,
    sea: f64,
}

/// The errors of the bank at a point.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Learner {
    grade: Grade,
    learnt: Errors,
    count: f64,
    seen: Taken,
    sea: f64,
    seconds: f64,
    doubt: Doubt,
    misfit: f64,
    /// Weight of each of the last seconds, the oldest first.
    trust: VecDeque<f64>,
}

impl Learner {
    pub(super) fn new(grade: Grade) -> Self {
        Learner {
            grade,
            learnt: Errors::zeros(),
            count: 0.0,
            seen: Taken::zeros(),
            sea: UNKNOWN_SEA.0 * UNKNOWN_SEA.0,
            seconds: 0.0,
            doubt: Doubt::default(),
            misfit: 0.0,
            trust: VecDeque::new(),
        }
    }

    /// The bank starts anew; the sea is still the same.
    pub(super) fn restart(&mut self) {
        *self = Learner { sea: self.sea, ..Learner::new(self.grade) };
    }

    /// Mean square of the heave, m^2, as the model's sea.
    pub(super) fn sea(&self) -> f64 {
        self.sea
    }

    /// A second later the bank stands at `signals`. The errors of `lag` seconds ago, if they are known by
    /// now, are `past`.
    pub(super) fn second(
        &mut self,
        model: &Model,
        signals: &Signals,
        past: Option<&Signals>,
        lag: usize,
    ) {
        self.look(model, signals);
        if let Some(errors) = past {
            self.learn(model, errors);
        }
        self.doubt_what_is_seen(model);
        self.remember_trust(model, lag);
    }

    /// Takes note of what the sections took away.
    fn look(&mut self, model: &Model, signals: &Signals) {
        self.seconds += 1.0;
        let taken = parts(signals);
        let product = taken * taken.transpose();
        self.seen += (product - self.seen) / self.seconds.min(SIGHT);
        let share = |i: usize| taken[i] * taken[i] / model.sea[(i, i)].max(1e-12);
        let power = (0..taken.len()).map(share).sum::<f64>() / taken.len() as f64;
        self.sea += (power - self.sea) / (self.seconds + UNKNOWN_SEA.1).min(SEA_MEMORY);
    }

    /// Errors beyond what the covariance lets expect count the less: what is rare must not spoil what is
    /// known of all other times, and what lasts is learnt nevertheless.
    fn learn(&mut self, model: &Model, errors: &Signals) {
        let fading = (-1.0 / MEMORY).exp();
        let surprise = normalised_square(&self.lasting(model), errors).unwrap_or(1.0);
        let trust = self.trust.front().copied().unwrap_or(1.0);
        let weight = trust * (SURPRISE / surprise).min(1.0);
        self.learnt = self.learnt * fading + errors * errors.transpose() * weight;
        self.count = self.count * fading + weight;
    }

    /// The covariance of what lasts: noise and sea.
    fn lasting(&self, model: &Model) -> Errors {
        let Grade { noise, walk, .. } = self.grade;
        let expected =
            model.noise * (noise * noise) + model.walk * (walk * walk) + model.sea * self.sea;
        let prior = PRIOR.0 + PRIOR.1 * (-self.count / PRIOR.2).exp();
        let guard = GUARD * GUARD * self.sea.max(GUARDED * GUARDED);
        (expected * prior + self.learnt) / (prior + self.count) + model.sea * guard
    }

    /// The same with what happened at known instants and a drift of the accelerometer, if there is doubt.
    fn drifting(&self, model: &Model) -> Errors {
        self.lasting(model)
            + model.known(self.grade.constant)
            + self.drift(model) * self.doubt.drift
    }

    /// Holds the covariance against what is seen. If it does not fit, that doubt of the accelerometer and
    /// of the sea holds which makes what is seen likeliest; doubts of before fade.
    fn doubt_what_is_seen(&mut self, model: &Model) {
        let fading = (-1.0 / FADING).exp();
        self.doubt = Doubt { drift: self.doubt.drift * fading, sea: self.doubt.sea * fading };
        let known = self.lasting(model) + model.known(self.grade.constant);
        let Some(fit) = Fit::of(&known, &self.seen) else { return };
        self.misfit = fit.misfit;
        if fit.misfit <= MISFIT || self.count <= LEARNT {
            return;
        }
        let (drift, sea) = (self.drift(model), model.sea * self.sea);
        let mut best = (fit.cost, Doubt::default());
        for b in grid(LEAST_DOUBT.sea, SEA_STEPS) {
            let waves = known + sea * b;
            for a in grid(LEAST_DOUBT.drift, DRIFT_STEPS) {
                match Fit::of(&(waves + drift * a), &self.seen) {
                    Some(fit) if fit.cost < best.0 => best = (fit.cost, Doubt { drift: a, sea: b }),
                    _ => {}
                }
            }
        }
        self.doubt.drift = self.doubt.drift.max(best.1.drift);
        self.doubt.sea = self.doubt.sea.max(best.1.sea);
    }

    /// The covariance of noise, and of a walk of the acceleration that goes with it.
    fn drift(&self, model: &Model) -> Errors {
        (model.noise + model.walk * DRIFT_WALK) * (self.grade.noise * self.grade.noise)
    }

    /// The best sum of the signals, as far as is known.
    pub(super) fn best(&self, model: &Model) -> Option<Combination> {
        let doubted = self.drifting(model) + model.sea * (self.sea * self.doubt.sea);
        let best = Combination::best(&doubted)?;
        let unlearnt = if self.count > LEARNT {
            1.0 + SCATTER / self.count
        } else {
            UNSURE * self.misfit.max(1.0)
        };
        Some(Combination { sigma: best.sigma * unlearnt.sqrt(), ..best })
    }

    /// How much this second will count for once its errors are known.
    fn remember_trust(&mut self, model: &Model, lag: usize) {
        let sigma = |errors: &Errors| Combination::best(errors).map(|best| best.sigma);
        let trust = match (sigma(&self.lasting(model)), sigma(&self.drifting(model))) {
            (Some(lasting), Some(drifting)) => (lasting / drifting).powi(2).max(LEAST_TRUST),
            _ => LEAST_TRUST,
        };
        self.trust.push_back(trust);
        while self.trust.len() > lag {
            self.trust.pop_front();
        }
    }
}

/// Nothing, and so many fourfold steps from the least doubt on.
fn grid(least: f64, steps: i32) -> impl Iterator<Item = f64> {
    std::iter::once(0.0).chain((0..steps).map(move |i| least * 4.0_f64.powi(i)))
}
