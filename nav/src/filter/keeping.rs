//! What is kept for smoothing, where that is wanted.

use std::sync::Arc;

use insd_base::Time;

use super::Filter;
use crate::increments::Increment;
use crate::smoothing::{KeptEpoch, KeptEstimate, Past, SmoothingPlan};
use crate::strapdown;

impl Filter {
    /// Keeps from now on what smoothing needs, after what was kept before; the covariance must be settled.
    pub(super) fn keep_past(&mut self, plan: SmoothingPlan, before: Option<Arc<KeptEpoch>>) {
        self.state.covariance.break_trail();
        self.state.past = Some(Box::new(Past::new(plan, before, self.state.time)));
        self.keep_epoch();
    }

    /// Where something is kept: it comes after what another filter kept before.
    pub fn follow_past(&mut self, before: Option<Arc<KeptEpoch>>) {
        if let Some((before, plan)) = before.zip(self.config.smoothing) {
            self.settle();
            self.keep_past(plan, Some(before));
        }
    }

    /// What was kept, up to now.
    #[must_use]
    pub fn past(&self) -> Option<Arc<KeptEpoch>> {
        self.state.past.as_ref()?;
        let mut own = self.clone();
        own.settle();
        own.keep_epoch();
        own.state.past.and_then(|past| past.newest)
    }

    /// Another filter goes on in its place, and keeps what comes after.
    pub(super) fn hand_past_to(&mut self, other: &mut Filter) {
        if let Some(past) = self.state.past.take() {
            other.keep_past(past.plan, past.newest);
        }
    }

    /// Nothing is kept of it.
    pub(super) fn keep_nothing(&mut self) {
        self.state.past = None;
        self.state.covariance.break_trail();
    }

    /// Keeps the epoch if it is time for one; the covariance must be settled.
    pub(super) fn keep_epoch_if_due(&mut self) {
        let now = self.state.time;
        if self.state.past.as_deref().is_some_and(|past| past.is_due(now)) {
            self.keep_epoch();
        }
    }

    fn keep_epoch(&mut self) {
        let Some(mut past) = self.state.past.take() else { return };
        let acceleration = self.acceleration_of_antenna(self.state.time);
        let state = &self.state;
        let estimate = KeptEstimate::of(state.time, &state.nominal, &state.rate, &acceleration);
        let dating = self.dating();
        past.keep(&estimate, dating, &mut self.state.covariance);
        self.state.past = Some(past);
    }

    /// Keeps the rows that lie in an increment, before it moves over it.
    pub(super) fn keep_rows(&mut self, increment: &Increment) {
        let Some(mut past) = self.state.past.take() else { return };
        while past.next_row() <= increment.to {
            let at = past.next_row();
            let nominal = strapdown::extrapolated(&self.state.nominal, increment, at);
            let acceleration = self.acceleration_of_antenna(at);
            past.keep_row(&KeptEstimate::of(at, &nominal, &increment.end_rate, &acceleration));
        }
        self.state.past = Some(past);
    }

    fn acceleration_of_antenna(&self, at: Time) -> nalgebra::Vector3<f64> {
        self.receiver.antenna.acceleration(at, &self.antenna_velocity(), 0.0)
    }
}
