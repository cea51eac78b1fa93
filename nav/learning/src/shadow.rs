//! Outages that did not happen: what dead reckoning by the log would have been off by after five minutes, with what is learnt
//! and without.
//!
//! Of labels that were heard, the last ten minutes before an instant are what is known of the log at the loss; what it is off
//! from that in the ten labels after is the error of dead reckoning. Both ways have the same labels, so that the
//! heading and the noise are the same and what differs is the model.

use std::collections::VecDeque;

use nalgebra::{Rotation2, Vector2};
use serde::{Deserialize, Serialize};

use crate::current::CurrentModel;
use crate::kept::KeptLog;
use crate::label::{LENGTH, Label};
use crate::model::LogErrors;

/// Labels before the loss, and in the outage.
const BEFORE: usize = 20;
pub(crate) const LOST: usize = 10;
/// A new one begins so many labels after the last.
const EVERY: usize = 3;
/// So many are remembered; so many are asked for before they prove anything.
const REMEMBERED: usize = 20;
const FEWEST: usize = 6;
/// Ratios of median and 95th percentile up to which what is learnt is used.
const MEDIAN: f64 = 1.0;
const WORST: f64 = 1.1;
/// Ratio of the medians from which on it is used: it would come and go otherwise.
const MARGIN: f64 = 0.95;
/// Labels further apart are of two stretches, s.
const APART: f64 = 2.0 * LENGTH;

/// Errors at the end of outages that did not happen.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ShadowScore {
    /// Labels of this stretch, with what would have been said of what repeats in them when they were heard first.
    labels: VecDeque<Label>,
    since: usize,
    /// Without and with, m, the newest last.
    errors: VecDeque<[f64; 2]>,
}

impl ShadowScore {
    /// Takes a label, and the model as it was before it heard it; an outage that ends with it is scored with the model as
    /// it was at its loss, which `held` is.
    pub(crate) fn take(&mut self, label: &Label, held: &LogErrors) {
        if self.labels.back().is_some_and(|last| label.time - last.time > APART) {
            self.labels.clear();
        }
        self.labels.push_back(*label);
        self.since += 1;
        if self.labels.len() > BEFORE + LOST {
            self.labels.pop_front();
        }
        if self.labels.len() == BEFORE + LOST && self.since >= EVERY {
            self.since = 0;
            let without = self.off(|_| Vector2::zeros());
            let with = self.off(|label| held.repeats(label));
            self.errors.push_back([without, with]);
            if self.errors.len() > REMEMBERED {
                self.errors.pop_front();
            }
        }
    }

    /// By how much dead reckoning would be off after the outage, m, if so much of each label were known to repeat.
    fn off(&self, repeats: impl Fn(&Label) -> Vector2<f64>) -> f64 {
        let along = |label: &Label| {
            let body = label.beyond - repeats(label);
            Rotation2::from_matrix_unchecked(nalgebra::Matrix2::new(
                label.bow.x,
                -label.bow.y,
                label.bow.y,
                label.bow.x,
            )) * body
        };
        let mean = |labels: &mut dyn Iterator<Item = &Label>, n: usize| {
            labels.map(along).sum::<Vector2<f64>>() / n as f64
        };
        let known = mean(&mut self.labels.iter().take(BEFORE), BEFORE);
        let lost = mean(&mut self.labels.iter().skip(BEFORE), LOST);
        (lost - known).norm() * LENGTH * LOST as f64
    }

    /// Outages of an earlier voyage.
    #[must_use]
    pub fn after(kept: &KeptLog) -> Self {
        let pairs = kept.shadow_without_m.iter().zip(&kept.shadow_with_m);
        let errors = pairs.take(REMEMBERED).map(|(without, with)| [*without, *with]).collect();
        ShadowScore { errors, ..ShadowScore::default() }
    }

    /// Ends of outages, without and with what is learnt, m, the newest last.
    pub fn errors(&self) -> impl Iterator<Item = &[f64; 2]> {
        self.errors.iter()
    }

    /// Median and 95th percentile without and with what is learnt, m; `None` of too few.
    #[must_use]
    pub fn quantiles(&self) -> Option<[[f64; 2]; 2]> {
        if self.errors.len() < FEWEST {
            return None;
        }
        let of = |which: usize| {
            let mut all: Vec<f64> = self.errors.iter().map(|pair| pair[which]).collect();
            all.sort_by(f64::total_cmp);
            [all[all.len() / 2], all[((all.len() - 1) as f64 * 0.95).round() as usize]]
        };
        Some([of(0), of(1)])
    }

    /// By how much the errors at the ends of outages were larger than a current alone that goes on so would make them, RMS; with what is learnt, or without. `None` of
    /// too few.
    ///
    /// Of a random walk of q = 2 sigma^2 / tau the mean of the time after an instant differs from that of the time before by
    /// q (`T_before` + `T_after`) / 3, each axis.
    #[must_use]
    pub fn excess(&self, is_with: bool, current: &CurrentModel) -> Option<f64> {
        if self.errors.len() < FEWEST {
            return None;
        }
        let squares = self.errors.iter().map(|pair| pair[usize::from(is_with)].powi(2));
        let seen = squares.sum::<f64>() / self.errors.len() as f64;
        let walk = 2.0 * current.std.powi(2) / current.time;
        let lasted = LENGTH * LOST as f64;
        let apart = walk * (LENGTH * BEFORE as f64 + lasted) / 3.0;
        Some((seen / (2.0 * apart * lasted * lasted)).sqrt())
    }

    /// Whether what is learnt was better than nothing; what is not used yet is to be so by a margin.
    #[must_use]
    pub fn proves(&self, is_used: bool) -> bool {
        let most = if is_used { MEDIAN } else { MARGIN };
        self.quantiles().is_some_and(|[without, with]| {
            with[0] < most * without[0] && with[1] < WORST * without[1]
        })
    }
}
