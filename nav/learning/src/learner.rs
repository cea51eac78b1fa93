//! Learns from labels with several notions of how the current goes on, and says what is used.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

use crate::current::CurrentModel;
use crate::kept::KeptLog;
use crate::label::Label;
use crate::model::LogErrors;
use crate::shadow::ShadowScore;
use crate::trained::Trained;

/// How a current may go on: 1-sigma, m/s, by time constant, s. The last of each is for unknown waters.
const STDS: [f64; 3] = [0.1, 0.25, 0.5];
const TIMES: [f64; 4] = [44_714.0, 20_000.0, 12_000.0, 7200.0];
/// Notions that are less likely than the best by this, as a logarithm, are given up; of the others the one with the liveliest
/// current is used.
const GIVEN_UP: f64 = 3.0;
/// What is claimed of the current is widened in such steps.
const WIDER: f64 = 1.25;
/// Labels before anything is used.
const FEWEST: u32 = 40;
/// A log that is begun anew with nothing known explains what is heard better by this, as a logarithm: the log is another.
const OTHER: f64 = 7.0;
/// and than one that is known, whatever the current, by this.
const HARDLY: f64 = 3.0;
/// Of the last labels so many refused: the log is another.
const LAST: usize = 10;
const REFUSED: usize = 6;

/// What is learnt of a log.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Learner {
    notions: Vec<LogErrors>,
    shadow: ShadowScore,
    refused: VecDeque<bool>,
    count: u32,
    is_used: bool,
    /// Models as they were at the begin of the outages that are scored.
    held: VecDeque<LogErrors>,
    /// What another log would make of what is heard, with nothing known of it: while there is something known of earlier voyages.
    rivals: Vec<LogErrors>,
    /// Labels that the rivals have heard.
    rivalled: u32,
    trained: Trained,
}

/// How a learner stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LearnerStanding {
    /// Whether what repeats of the log is used.
    pub is_used: bool,
    /// How the current goes on, once enough was heard.
    pub current: Option<CurrentModel>,
}

/// What a label changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LearnerVerdict {
    /// What is learnt has proven better than nothing, and is used from now on.
    Proven,
    /// It is not better any more.
    Unproven,
    /// The log is another than it was: fouled, exchanged or turned. All is learnt anew.
    Changed,
}

impl Default for Learner {
    fn default() -> Self {
        Learner {
            notions: notions(LogErrors::unknown),
            shadow: ShadowScore::default(),
            refused: VecDeque::new(),
            count: 0,
            is_used: false,
            held: VecDeque::new(),
            rivals: Vec::new(),
            rivalled: 0,
            trained: Trained::default(),
        }
    }
}

impl Learner {
    /// One that goes on from an earlier voyage.
    #[must_use]
    pub fn after(kept: &KeptLog) -> Self {
        let shadow = ShadowScore::after(kept);
        Learner {
            notions: notions(|current| LogErrors::known(kept, current)),
            is_used: kept.labels >= FEWEST && kept.trained.is_enough() && shadow.proves(false),
            shadow,
            count: kept.labels,
            rivals: notions(LogErrors::unknown),
            trained: kept.trained,
            ..Learner::default()
        }
    }

    /// What is kept of it for the next voyage.
    #[must_use]
    pub fn kept(&self) -> KeptLog {
        KeptLog {
            labels: self.count,
            trained: self.trained,
            shadow_without_m: self.shadow.errors().map(|pair| pair[0]).collect(),
            shadow_with_m: self.shadow.errors().map(|pair| pair[1]).collect(),
            ..self.model().kept()
        }
    }

    /// Learns from a label.
    pub fn hear(&mut self, label: &Label) -> Option<LearnerVerdict> {
        let held = self.held_at_loss();
        self.shadow.take(label, &held);
        let best = self.best();
        let heard: Vec<_> = self.notions.iter_mut().map(|notion| notion.hear(label)).collect();
        self.count += 1;
        self.refused.push_back(!heard[best].is_used);
        if self.refused.len() > LAST {
            self.refused.pop_front();
        }
        if heard[best].is_used {
            self.trained.widen(label);
        }
        if self.refused.iter().filter(|refused| **refused).count() >= REFUSED {
            *self = Learner::default();
            return Some(LearnerVerdict::Changed);
        }
        if self.is_another(label) {
            let rivals = std::mem::take(&mut self.rivals);
            *self = Learner { notions: rivals, count: self.rivalled, ..Learner::default() };
            return Some(LearnerVerdict::Changed);
        }
        let before = self.is_used;
        self.is_used = self.trained.is_enough() && self.shadow.proves(before);
        match (before, self.is_used) {
            (false, true) => {
                // the filter learns now, and its heading does not lean to what the log says in a turn any more
                self.notions.iter_mut().for_each(LogErrors::unsettle_slide);
                Some(LearnerVerdict::Proven)
            }
            (true, false) => Some(LearnerVerdict::Unproven),
            _ => None,
        }
    }

    /// Whether what is heard of this voyage is that of another log: the likeliest notion of one of which nothing is known
    /// explains it better than what is known does, by the ratio of their likelihoods.
    fn is_another(&mut self, label: &Label) -> bool {
        if self.rivals.is_empty() {
            return false;
        }
        self.rivals.iter_mut().for_each(|rival| {
            rival.hear(label);
        });
        self.rivalled += 1;
        // with the same current: a livelier one would explain what a log that was turned says, too, but hardly as well
        let rival = likeliest(&self.rivals);
        let [other, same] = [&self.rivals, &self.notions].map(|all| all[rival].score());
        let livelier = self.notions[self.best()].score();
        other - same > OTHER && other - livelier > HARDLY
    }

    /// How it stands.
    #[must_use]
    pub fn standing(&self) -> LearnerStanding {
        let current = (self.count >= FEWEST).then(|| self.honest());
        LearnerStanding { is_used: self.is_used && current.is_some(), current }
    }

    /// How the current goes on, so lively that outages that did not happen ended as far off as it claims; never livelier than in unknown waters.
    fn honest(&self) -> CurrentModel {
        let own = self.model().current();
        let excess = self.shadow.excess(self.is_used, &own).unwrap_or(1.0);
        // in steps, so that the filter is not told anew with each outage
        let steps = (excess.max(1.0).ln() / WIDER.ln()).ceil();
        let unknown = STDS[2] * (own.time / TIMES[3]).sqrt();
        CurrentModel { std: (own.std * WIDER.powf(steps)).min(unknown), ..own }
    }

    /// What is learnt: of the notions that are not given up the one with the liveliest current.
    #[must_use]
    pub fn model(&self) -> &LogErrors {
        let most = self.notions[self.best()].score();
        let walk = |notion: &LogErrors| notion.current().std.powi(2) / notion.current().time;
        let kept = self.notions.iter().filter(|notion| notion.score() > most - GIVEN_UP);
        kept.max_by(|a, b| walk(a).total_cmp(&walk(b))).unwrap_or(&self.notions[0])
    }

    /// Outages that did not happen.
    #[must_use]
    pub fn shadow(&self) -> &ShadowScore {
        &self.shadow
    }

    /// The model ten labels ago.
    fn held_at_loss(&mut self) -> LogErrors {
        self.held.push_back(*self.model());
        if self.held.len() > crate::shadow::LOST {
            self.held.pop_front();
        }
        self.held[0]
    }

    fn best(&self) -> usize {
        likeliest(&self.notions)
    }
}

fn likeliest(all: &[LogErrors]) -> usize {
    let score = |i: &usize| all[*i].score();
    (0..all.len()).max_by(|a, b| score(a).total_cmp(&score(b))).unwrap_or(0)
}

/// One for each way in which a current may go on.
fn notions(of: impl Fn(CurrentModel) -> LogErrors) -> Vec<LogErrors> {
    let models = TIMES.iter().flat_map(|time| STDS.map(|std| CurrentModel { std, time: *time }));
    models.map(of).collect()
}

#[cfg(test)]
mod tests;
