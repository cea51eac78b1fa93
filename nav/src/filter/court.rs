//! The judge of the filter, while it has one, and what he has not been told yet.

use std::sync::Arc;

use insd_base::{SolutionSigma, Time};

use super::hidden::Hidden;
use crate::error_state::Errors;
use crate::increments::Increment;
use crate::judge::{Judge, Separation};
use crate::leap::LeapWatch;
use crate::propagation::Stretch;
use crate::strapdown::Step;

/// Who is to be believed.
#[derive(Clone, Debug)]
pub(super) struct Court {
    /// While the filter navigates and nothing holds the ship.
    pub(super) judge: Option<Arc<Judge>>,
    /// Stands in for it otherwise.
    pub(super) leap: LeapWatch,
    /// Since when there is one, or none.
    pub(super) since: Time,
    /// The heading was found with a reference that nothing bears out yet.
    pub(super) heading_doubted: bool,
    /// The way since, and corrections.
    pub(super) unjudged: Stretch,
    pub(super) owed: Errors,
    /// Sigmas that cover all that may be, while somebody may lie.
    pub(super) covered: Option<SolutionSigma>,
    /// Where ranges are in use and fixes have her elsewhere: how far.
    pub(super) beside: Option<SolutionSigma>,
    /// A receiver that is left out for a leap has returned from a lie: that may be so.
    pub(super) returned: Option<Separation>,
    /// What faults that nobody has found add to the protection levels.
    pub(super) hidden: Hidden,
}

impl Court {
    /// One without a judge.
    pub(super) fn new(now: Time) -> Self {
        Court {
            judge: None,
            leap: LeapWatch::default(),
            since: now,
            heading_doubted: false,
            unjudged: Stretch::new(),
            owed: Errors::none(),
            covered: None,
            beside: None,
            returned: None,
            hidden: Hidden::default(),
        }
    }

    /// Has this judge from now on, or none.
    pub(super) fn sit(&mut self, judge: Option<Judge>, now: Time) {
        self.leap = LeapWatch::default();
        self.judge = judge.map(Arc::new);
        self.since = now;
        self.forget_unheard();
    }

    /// What the judge has not been told yet is of no account.
    pub(super) fn forget_unheard(&mut self) {
        self.unjudged = Stretch::new();
        self.owed = Errors::none();
    }

    /// Notes the way that the estimate was carried.
    pub(super) fn note(&mut self, step: &Step, increment: &Increment) {
        if self.judge.is_some() {
            self.unjudged.add(step);
            self.unjudged.add_noise(increment);
        }
    }

    /// Whether the IMU is not believed.
    pub(super) fn is_restless(&self) -> bool {
        self.judge.as_ref().is_some_and(|judge| judge.docket().is_restless())
    }
}
