//! What is learnt of the sea from a ship's displacement, and whether it holds.

use insd_base::{Residual, SeaFit};
use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use super::seen::Seen;
use crate::Filter;
use crate::disturbance::{
    Displacement, SeaPrior, SeaSums, SeaWindow, Whitener, Whiteness, WhiteningConfig,
};

/// What a ship's displacement has told of the sea.
#[derive(Clone, Debug)]
pub struct WhitenedSea {
    sums: SeaSums,
    odds: Vec<f64>,
}

/// The kinds of sea that are known, which of them it is likely to be, and what was seen of it.
#[derive(Clone, Debug)]
pub(super) struct SeaLearner {
    config: WhiteningConfig,
    prior: SeaPrior,
    window: SeaWindow,
    /// Logarithms of the odds of the kinds of sea.
    odds: Vec<f64>,
    /// The sea of another, where that is what counts.
    lent: Option<WhitenedSea>,
    whiteness: Whiteness,
    fallbacks: u32,
}

/// What is kept of it for the next start of the program.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct SeaLearnerCheckpoint {
    stated: f64,
    samples: Vec<Option<Displacement>>,
    odds: Vec<f64>,
    fallbacks: u32,
}

/// Time over which the odds of the kinds of sea are forgotten, s.
const FORGETTING: f64 = 900.0;
/// Square of a sample's innovation over its variance beyond which it counts no more against a kind.
const BOUND: f64 = 12.0;
/// What a sample says of the kinds counts for so much: it was told to the filter, whose errors of now hang together with
/// those of the sample before.
const EVIDENCE: f64 = 0.5;

impl SeaLearner {
    /// Nothing is known but the stated displacement, 1-sigma of each component, m.
    pub(super) fn new(config: &WhiteningConfig, stated: f64) -> Self {
        let prior = SeaPrior::new(config.spacing.as_seconds(), config.order).stated(stated);
        SeaLearner {
            config: *config,
            odds: prior.odds(),
            prior,
            window: SeaWindow::new(config),
            lent: None,
            whiteness: Whiteness::default(),
            fallbacks: 0,
        }
    }

    /// What is worth keeping: it goes on after a gap.
    pub(super) fn kept(&self) -> SeaLearnerCheckpoint {
        SeaLearnerCheckpoint {
            stated: self.prior.stated_std(),
            samples: self.window.samples().collect(),
            odds: self.odds.clone(),
            fallbacks: self.fallbacks,
        }
    }

    /// Goes on from what was kept; `None` if it is of other kinds of sea.
    pub(super) fn taken_up(config: &WhiteningConfig, kept: &SeaLearnerCheckpoint) -> Option<Self> {
        let mut learner = SeaLearner::new(config, kept.stated);
        if learner.odds.len() != kept.odds.len() {
            return None;
        }
        kept.samples.iter().for_each(|sample| learner.push(*sample));
        learner.push(None);
        learner.odds.clone_from(&kept.odds);
        Some(SeaLearner { fallbacks: kept.fallbacks, ..learner })
    }

    /// Another displacement is stated, and what was seen was not seen from there.
    pub(super) fn restate(&mut self, stated: f64) {
        self.prior = self.prior.clone().stated(stated);
        self.begin_anew();
    }

    fn begin_anew(&mut self) {
        self.window = SeaWindow::new(&self.config);
        self.odds = self.prior.odds();
        self.whiteness = Whiteness::default();
    }

    pub(super) fn learnt(&self) -> WhitenedSea {
        WhitenedSea { sums: self.window.sums().clone(), odds: self.odds.clone() }
    }

    /// From now on the sea is what another has learnt; nothing for what is learnt here.
    pub(super) fn lend(&mut self, sea: Option<WhitenedSea>) {
        self.lent = sea;
    }

    /// Sums and odds that count.
    fn sea(&self) -> (&SeaSums, &[f64]) {
        match &self.lent {
            Some(lent) => (&lent.sums, &lent.odds),
            None => (self.window.sums(), &self.odds),
        }
    }

    /// A(q) of as many lags as there are samples before, and no more than it may have.
    pub(super) fn whitener(&self, before: usize) -> Option<Whitener> {
        let (sums, odds) = self.sea();
        sums.fit(before.min(self.config.order), &self.prior, odds)
    }

    /// Variance of a component of her displacement, m^2.
    pub(super) fn variance(&self) -> f64 {
        let (sums, _) = self.sea();
        self.prior.variance(sums.weight(), sums.mean_square())
    }

    /// The same of what was seen alone.
    pub(super) fn mean_square(&self) -> f64 {
        self.sea().0.mean_square()
    }

    /// What was seen without a gap until now, oldest first, m.
    pub(super) fn samples(&self) -> Vec<Vector2<f64>> {
        self.window.newest_run()
    }

    /// The next sample that is not corrected any more; nothing where it was lost.
    pub(super) fn push(&mut self, sample: Option<Displacement>) {
        if sample.is_some() || !self.window.is_empty() {
            self.window.push(sample);
        }
    }

    /// Weighs the kinds of sea by how well each foretold what is seen.
    pub(super) fn weigh_kinds(&mut self, filter: &Filter, seen: &Seen) {
        let variance = self.variance();
        let share = self.config.spacing.as_seconds() / FORGETTING;
        let own = seen.own(filter);
        let kinds = self.prior.foretold(seen.before().len());
        for ((odds, first), kind) in self.odds.iter_mut().zip(self.prior.odds()).zip(kinds) {
            let weighed = seen.weigh(&own, &kind.lags, kind.unexplained * variance);
            let said = weighed.map_or(0.0, |(nis, root)| -0.5 * nis.min(BOUND) - root);
            *odds += share * (first - *odds) + EVIDENCE * said;
        }
        let most = self.odds.iter().copied().fold(f64::MIN, f64::max);
        self.odds.iter_mut().for_each(|odds| *odds -= most);
    }

    /// Judges the sea by what it did not foretell, over the claimed sigma, where that is no shift of the ship; where it is
    /// more than it claims, the sea is no longer what was learnt, and what is known of any sea counts again.
    pub(super) fn judge(&mut self, residual: Vector2<f64>) {
        self.whiteness.push(residual);
        // of a lent sea the one who learnt it is to judge
        if self.lent.is_none() && self.whiteness.verdict() == Some(Residual::Loud) {
            self.begin_anew();
            self.fallbacks += 1;
        }
    }

    /// How well the sea fits, once that can be told, or after it did not.
    pub(super) fn fit(&self) -> Option<SeaFit> {
        let seen = self.whiteness.seen(self.config.spacing.as_seconds());
        (seen.is_some() || self.fallbacks > 0).then_some(SeaFit {
            order: self.config.order,
            seen,
            fallbacks: self.fallbacks,
        })
    }
}
