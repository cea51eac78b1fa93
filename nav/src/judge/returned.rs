//! A receiver that leaps may be back ([`suspicion`](super::suspicion)): what is kept for that, and what follows.

use insd_base::{Fault, Party, Time};
use nalgebra::{Matrix3, Vector3};

use super::Judge;
use super::alternative::{Alternative, Ruling};
use super::charge::{Charge, Kind};
use super::docket::OpenLie;
use super::lie::{growth, is_growing};
use super::rows::ALL;
use super::separation::Separation;
use super::suspicion::{Suspicion, UNTIDY, chance_of_end};

/// Suspicions are kept for so long, s: a leap is found within some seconds, or not.
const KEPT: f64 = 20.0;
/// What is less likely is no suspicion.
const SUSPECTED: f64 = 1e-3;
/// What the levels allow for with less than this is of no account.
const ALLOWED: f64 = 1e-8;
/// How likely a lie is of which nobody can tell whether it is one.
const DISPUTED: f64 = 0.5;
/// Cause of a level: beyond all others of the judge.
const RETURNED: usize = 999;
/// Odds, as a logarithm, from which on one of the two is taken to be so.
const SURE: f64 = 6.9;

impl Judge {
    /// Takes note of what the levels allow for.
    pub fn note_allowed(&mut self, now: Time, all: &[Separation]) {
        let is_it = |own: &&Separation| {
            let fault = ALL.get(own.cause).map(|group| group.fault);
            own.chance > ALLOWED && fault.is_some_and(is_growing)
        };
        self.allowed.looks.retain(|(at, _)| (now - *at).as_seconds() < KEPT);
        self.allowed.looks.push((now, all.iter().filter(is_it).copied().collect()));
    }

    /// While the receiver is left out for a leap: that it has returned from a lie, and is right; `off` is where it says she is from where the navigator
    /// does, ECEF, m, of an estimate with a covariance.
    pub fn returned(
        &mut self,
        off: &Vector3<f64>,
        covariance: &Matrix3<f64>,
    ) -> Option<Separation> {
        let before = self.allowed.before.as_ref().filter(|_| self.docket.leaves_out_gnss())?;
        let ended = || chance_of_end(before, off);
        let chance = *self.allowed.ended.get_or_insert_with(ended);
        let noise = Matrix3::from_diagonal_element(UNTIDY[0] * UNTIDY[0]);
        let (growth, spreading) = (Vector3::zeros(), Matrix3::zeros());
        let (cause, covariance) = (RETURNED, covariance + noise);
        Some(Separation { cause, chance, apart: *off, growth, covariance, spreading })
    }

    /// The receiver is followed from now on, which says that she is so far, m, from where the others have her, if it is not known who of them is wrong.
    pub fn follow_contradicted(&mut self, off: f64, now: Time) {
        if self.in_doubt {
            self.leave_lie_open(now);
            self.docket.follow_contradicted(off, now);
        }
    }

    /// The IMU is convicted: what the receiver may have done instead, by what the levels allowed for at the last look, is left open; gives it.
    pub(super) fn leave_lie_open(&mut self, now: Time) -> Option<Charge> {
        let look = self.allowed.looks.last();
        let likeliest =
            look.and_then(|(_, all)| all.iter().max_by(|a, b| a.chance.total_cmp(&b.chance)));
        let Separation { cause, chance, .. } = *likeliest?;
        let is_it =
            |charge: &&Charge| matches!(charge.kind, Kind::Shaped { group, .. } if group == cause);
        let charge = *self.assessment.charges.iter().find(is_it)?;
        self.keep_open(charge, chance, now)
    }

    /// The receiver is convicted of telling the past, and its time set right: that it is off by a distance instead is left open; gives that. The two differ as
    /// soon as she turns or goes at another speed.
    pub(super) fn leave_distance_open(&mut self, now: Time) -> Option<Charge> {
        let is_off =
            |charge: &&Charge| charge.party() == Party::Gnss && growth(charge.fault, 0.0).is_some();
        let charge = *self.assessment.charges.iter().find(is_off)?;
        let chance = (charge.weight - self.assessment.total).exp();
        self.keep_open(charge, chance, now)
    }

    /// Whether the IMU is worse than assumed or the receiver goes astray nobody could tell, nor will anybody by what is heard from now on.
    pub(super) fn leave_dispute_open(&mut self) {
        let is_it = |lie: &Charge| lie.party() == Party::Gnss && is_growing(lie.fault);
        let is_fine = !self.is_coarse && !self.docket.leaves_out_gnss();
        let disputed = self.disputed.filter(|_| is_fine);
        if let Some((lie, now)) = disputed.filter(is_it).zip(self.looked) {
            self.keep_open(lie, DISPUTED, now);
        }
    }

    fn keep_open(&mut self, charge: Charge, chance: f64, now: Time) -> Option<Charge> {
        let Kind::Shaped { since, sized, .. } = charge.kind else { return None };
        self.docket.leave_lie_open(OpenLie {
            fault: charge.fault,
            since,
            value: sized.value.xy(),
            covariance: sized.covariance().fixed_view::<2, 2>(0, 0).into(),
            left: (now, chance),
        });
        Some(charge)
    }

    /// Keeps what the receiver is suspected of, by what a look has found.
    pub(super) fn note_suspicion(&mut self, now: Time) {
        self.suspicions.retain(|own| (now - own.at).as_seconds() < KEPT);
        let mut all = self.assessment.charges.iter();
        let Some(charge) = all.find(|charge| is_growing(charge.fault)).copied() else { return };
        let chance = (charge.weight - self.assessment.total).exp();
        let Kind::Shaped { group, since, .. } = charge.kind else { return };
        let effects = self.begun(since).map(|onset| onset.effects_of(&ALL[group]));
        if let Some(effects) = effects.filter(|_| chance > SUSPECTED) {
            self.suspicions.push(Suspicion { at: now, chance, charge, effects });
        }
    }

    /// What follows of a leap of the receiver that may have ended a lie: it is believed where that is sure; where it is not the receiver is left out, and the
    /// position claimed to be no better than the two are apart. `None` where it is a leap.
    pub(super) fn look_at_return(&mut self, leap: &Charge, now: Time) -> Option<Ruling> {
        let Kind::Shaped { since, sized, .. } = leap.kind else { return None };
        if leap.party() == Party::Gnss {
            (self.allowed.before, self.allowed.ended) = (None, None);
        }
        if leap.fault != Fault::Jump {
            return None;
        }
        let look = self.allowed.looks.iter().rev().find(|(at, _)| *at <= since);
        self.allowed.before = look.map(|(_, all)| all.clone());
        let before = self.suspected_before(since)?.clone();
        let jump = sized.value.xy();
        let odds =
            before.odds(&jump, &sized.covariance().fixed_view::<2, 2>(0, 0).into(), since)?;
        if odds < -SURE {
            return None;
        }
        if odds < SURE {
            let ruling = self.convict(leap, now);
            self.docket.leave_open(jump.norm(), now);
            return Some(ruling);
        }
        self.accused = None;
        let mended = before.ended(self.alternative(leap));
        self.docket.drop_suspicion(Party::Gnss, now);
        Some(Ruling { fault: before.charge.fault, mended: Some(mended) })
    }

    /// What the receiver was suspected of last, at an instant.
    fn suspected_before(&self, instant: Time) -> Option<&Suspicion> {
        self.suspicions.iter().rev().find(|own| own.at <= instant)
    }

    /// While a leap of the receiver is likeliest: the estimate if that ended what it was suspected of before.
    pub(super) fn without_what_may_have_ended(&self) -> Option<Alternative> {
        let leap = self.assessment.charges.first().filter(|first| first.fault == Fault::Jump)?;
        let Kind::Shaped { since, .. } = leap.kind else { return None };
        Some(self.suspected_before(since)?.ended(self.alternative(leap)))
    }
}
