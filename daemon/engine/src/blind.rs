//! Somebody who finds the heading without the heading reference: whether that can be believed.
//!
//! A gyrocompass that was set wrongly is as steady as one that was not. So where a heading was found with one, the
//! filter of eight states goes on without it, by gyros, course and turns alone, until it knows the heading well
//! enough to bear it out or to refute it.

use insd_alignment::EightState;
use insd_base::units::{DEG, wrap_pi};
use insd_base::{ExternalReference, Message, Received, Solution, Time};
use insd_nav::{Estimator, Increment};

/// What nobody has borne out is claimed to be no surer than this, rad.
const UNCHECKED: f64 = 2.4 * DEG;
/// A heading known so well, rad, bears out another within so many sigmas;
const KNOWN: f64 = 1.5 * DEG;
const BEARS_OUT: f64 = 3.0;
/// one that differs by more than so many, and this, rad, for so long, s, refutes it.
const REFUTES: f64 = 5.0;
const LEAST: f64 = 1.0 * DEG;
const PERSISTS: f64 = 5.0;

/// What came of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Word {
    /// Nothing yet.
    Open,
    /// The heading is as it was told.
    BornOut,
    /// It is not.
    Refuted,
}

/// A finder that hears no heading.
#[derive(Clone, Debug)]
pub(crate) struct Blind {
    finder: Box<EightState>,
    differs_since: Option<Time>,
}

impl Blind {
    /// One that knows what a finder knows before it hears a heading.
    pub(crate) fn beside(finder: &EightState) -> Self {
        Blind { finder: Box::new(finder.clone()), differs_since: None }
    }

    pub(crate) fn finder(&self) -> &EightState {
        &self.finder
    }

    pub(crate) fn advance(&mut self, increment: &Increment) {
        self.finder.advance(increment);
    }

    /// Hears everything but headings.
    pub(crate) fn apply(&mut self, received: &Received) {
        let _ = self.finder.apply(&without_heading(received));
    }

    /// What it makes of a heading and its 1-sigma, rad.
    pub(crate) fn judge(&mut self, heading: f64, sigma: f64) -> Word {
        let (own, own_sigma) = self.finder.heading();
        let off = wrap_pi(heading - own).abs();
        let both = own_sigma.hypot(sigma);
        let differs = self.finder.finished() && off > LEAST.max(REFUTES * both);
        if !differs {
            self.differs_since = None;
            let is_known = own_sigma < KNOWN && off < BEARS_OUT * both;
            return if is_known { Word::BornOut } else { Word::Open };
        }
        let now = self.finder.time();
        let since = *self.differs_since.get_or_insert(now);
        if (now - since).as_seconds() >= PERSISTS { Word::Refuted } else { Word::Open }
    }
}

/// A solution with a heading that nobody has borne out.
pub(crate) fn unchecked(solution: Solution) -> Solution {
    let mut sigma = solution.sigma;
    sigma.heading = sigma.heading.max(UNCHECKED);
    Solution { sigma, ..solution }
}

/// A message without the heading that it may tell.
pub(crate) fn without_heading(received: &Received) -> Received {
    let message = match &received.message {
        Message::Reference(told) => {
            Message::Reference(ExternalReference { heading: None, heading_std: None, ..*told })
        }
        other => other.clone(),
    };
    Received { message, ..*received }
}

/// Whether somebody tells a heading.
pub(crate) fn tells_heading(received: &Received) -> bool {
    matches!(received.message, Message::Reference(told) if told.heading.is_some())
}
