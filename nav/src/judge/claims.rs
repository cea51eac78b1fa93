//! What the estimate may be if it is not the navigator's, and how likely that is.

use insd_base::Party;

use super::charge::{Assessment, Charge};
use super::{Alternative, Judge};

/// What is less likely than this, as a logarithm, is not covered by the claims.
const COVERED: f64 = -9.2;

/// What is less likely than this is of no account.
const CHANCE: f64 = 1e-3;

impl Judge {
    /// Whether somebody lies, whoever it is.
    #[must_use]
    pub fn is_in_doubt(&self) -> bool {
        self.in_doubt
    }

    /// Whether somebody is likely to lie, whoever it is.
    #[must_use]
    pub fn finds_a_lie_likely(&self) -> bool {
        self.disputed.is_some() || self.assessment.is_likely
    }

    /// What the estimate may be if it is not the navigator's: nothing unless somebody may lie.
    #[must_use]
    pub fn claims(&self) -> Vec<Alternative> {
        let total = self.assessment.total;
        if let Some(lie) = &self.disputed {
            return vec![self.alternative(lie), self.pessimist.shadow.alternative()];
        }
        if !self.assessment.is_covered {
            return Vec::new();
        }
        let stands = |weight: f64| weight - total > COVERED;
        let faults = self.assessment.charges.iter().filter(|charge| stands(charge.weight));
        let mut all: Vec<Alternative> = faults.map(|charge| self.alternative(charge)).collect();
        if !all.is_empty() && stands(0.0) {
            all.push(self.shadow());
        }
        all.extend(self.without_what_may_have_ended());
        all
    }

    /// What the estimate may be instead, and how likely that is, while that is too little for the claims to cover all of it.
    #[must_use]
    pub fn chances(&self) -> Vec<(f64, Alternative)> {
        let Assessment { charges, total, is_covered, .. } = &self.assessment;
        let chance = |charge: &Charge| (charge.weight - total).exp();
        let open = charges.iter().filter(|charge| !is_covered && chance(charge) > CHANCE);
        open.map(|charge| (chance(charge), self.alternative(charge))).collect()
    }

    /// What a navigator is to become that refuses a receiver against whom nothing speaks: what it would be had it believed everybody, or
    /// all but him who is suspected.
    #[must_use]
    pub fn unbiased(&self) -> Option<Alternative> {
        if !self.in_doubt {
            return Some(self.shadow());
        }
        let is_alone = |suspect: &Charge| !self.lies_another(suspect.party());
        let others = self.suspect.filter(|own| own.party() != Party::Imu && is_alone(own));
        others.map(|suspect| self.alternative(&suspect))
    }

    /// The estimate of him who believes everybody.
    #[must_use]
    pub fn shadow(&self) -> Alternative {
        self.shadow.alternative()
    }
}
