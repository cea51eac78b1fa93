//! What was taken for evidence and was noise.

use insd_base::Party;

use super::dissenter::{Dissenter, Success};
use super::{Charge, Judge};

/// What is found while noise that has grown as a variance shows is no likelier than so many times that growth, as a logarithm: half of
/// it in each of six components for half a minute, and as much again.
const NOISE_EXPLAINS: f64 = 200.0;

impl Judge {
    /// Whether there is nothing worse than that somebody scatters, so many times as much as before, as a variance.
    pub(super) fn is_noise_all(&self, party: Option<Party>, growth: f64) -> bool {
        if self.disputed.is_some() {
            return false;
        }
        let most = self.assessment.charges.first().filter(|most| most.weight > 0.0);
        let is_it = |first: Charge| first.fault.is_noise() && Some(first.party()) == party;
        let is_no_more = most.is_none_or(|most| most.weight < NOISE_EXPLAINS * growth);
        is_no_more && (most.is_none() || self.likeliest().is_some_and(is_it))
    }

    /// What was taken for evidence was somebody's noise: who did not believe him goes on.
    pub(super) fn acquit_all(&mut self, noisy: Option<Party>) {
        self.onsets.clear();
        self.spawned = None;
        self.spare = Success::default();
        self.pessimist.forget();
        let dissenter = noisy.and_then(|noisy| self.dissenter(noisy));
        let now = dissenter.map_or(&self.shadow, |dissenter| &dissenter.shadow).clone();
        self.shadow = now.clone();
        self.dissenters.iter_mut().for_each(|dissenter| {
            *dissenter = Dissenter::new(dissenter.whom, now.clone());
        });
    }
}
