//! A receiver that leaps may be back: who led it away has let go.
//!
//! What goes away slowly is suspected before it is proven, and a leap explains away whatever spoke for it: no drift fits both. So what was suspected
//! at a look before the leap is kept, and the two are weighed: that a lie which had grown to o, known to a covariance S, ended with the leap j, against
//! a leap of an honest receiver,
//!
//! R = chance(o) / lasts N(-j; o, S) / (rate 1 / (2 pi j^2 ln(most / least))),
//!
//! leaps being of any size between the least and the most, evenly by their logarithm.

use insd_base::{Fault, Party, Time};
use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};

use super::charge::{Charge, Kind};
use super::docket::OpenLie;
use super::lie::{LASTS, growth, is_growing};
use super::rows::ALL;
use super::verdict::{Ruling, lie_of_gnss};
use super::{Alternative, Judge, Separation};
use crate::error_state::{Effects, POSITION, VELOCITY};

/// Suspicions are kept for so long, s: a leap is found within some seconds, or not.
const KEPT: f64 = 20.0;
/// What is less likely is no suspicion.
const SUSPECTED: f64 = 1e-3;
/// Leaps are between these, m.
const LEAPS: [f64; 2] = [3.0, 1e3];
/// What the levels allow for with less than this is of no account.
const ALLOWED: f64 = 1e-8;
/// Cause of a level: beyond all others of the judge.
const RETURNED: usize = 999;
/// Odds, as a logarithm, from which on one of the two is taken to be so.
const SURE: f64 = 6.9;
/// What was made of a lie is known no better than this, 1-sigma, m and m/s, some seconds after it has ended.
const UNTIDY: [f64; 2] = [3.0, 0.3];

/// A lie that was likely at a look.
#[derive(Clone, Debug)]
pub(super) struct Suspicion {
    at: Time,
    chance: f64,
    charge: Charge,
    /// What a unit of each of its components had done to the estimate.
    effects: Effects,
}

/// What the levels allow for of a receiver's growing lies.
#[derive(Clone, Debug, Default)]
pub(super) struct Allowed {
    looks: Vec<(Time, Vec<Separation>)>,
    /// Before the leap for which it is left out.
    before: Option<Vec<Separation>>,
    /// Chance that the leap ended one of them, once it is weighed.
    ended: Option<f64>,
}

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

    /// The IMU is convicted: what the receiver may have done instead, by what the levels allowed for at the last look, is left open.
    pub(super) fn leave_lie_open(&mut self, now: Time) {
        let look = self.allowed.looks.last();
        let likeliest =
            look.and_then(|(_, all)| all.iter().max_by(|a, b| a.chance.total_cmp(&b.chance)));
        let Some(Separation { cause, chance, .. }) = likeliest.copied() else { return };
        let is_it =
            |charge: &&Charge| matches!(charge.kind, Kind::Shaped { group, .. } if group == cause);
        let Some(charge) = self.assessment.charges.iter().find(is_it) else { return };
        let Kind::Shaped { since, sized, .. } = charge.kind else { return };
        self.docket.leave_lie_open(OpenLie {
            fault: charge.fault,
            since,
            value: sized.value.xy(),
            covariance: sized.covariance().fixed_view::<2, 2>(0, 0).into(),
            left: (now, chance),
        });
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

/// The chance that a leap which took a receiver to a place off the estimate ended one of its lies: of each cause the likeliest, as far as it would have led
/// so far.
fn chance_of_end(lies: &[Separation], off: &Vector3<f64>) -> f64 {
    let chance = |own: &Separation| {
        let wide = own.covariance + Matrix3::from_diagonal_element(UNTIDY[0] * UNTIDY[0]);
        let left = off - own.apart;
        let square = wide.try_inverse().map_or(0.0, |inverse| left.dot(&(inverse * left)));
        own.chance * (-0.5 * square).exp()
    };
    let of_cause = |lies: &[Separation]| lies.iter().map(chance).fold(0.0, f64::max);
    let mut lies = lies.to_vec();
    lies.sort_by_key(|own| own.cause);
    lies.chunk_by(|a, b| a.cause == b.cause).map(of_cause).sum::<f64>().min(1.0)
}

impl Suspicion {
    /// The logarithm of R.
    fn odds(&self, leap: &Vector2<f64>, of_leap: &Matrix2<f64>, since: Time) -> Option<f64> {
        let Kind::Shaped { since: begun, sized, group } = self.charge.kind else { return None };
        let age = (since - begun).as_seconds();
        let (off, _) = lie_of_gnss(&self.charge, age);
        let (grown, _) = growth(self.charge.fault, age)?;
        let size: Matrix2<f64> = sized.covariance().fixed_view::<2, 2>(0, 0).into();
        let untidy = Matrix2::from_diagonal_element(UNTIDY[0] * UNTIDY[0]);
        let covariance = size * (grown * grown) + of_leap + untidy;
        let left = leap + off;
        let square = left.dot(&(covariance.try_inverse()? * left));
        let returned =
            self.chance.ln() - LASTS.ln() - 0.5 * (square + covariance.determinant().ln());
        let [least, most] = LEAPS;
        let leapt = ALL[group].log_rate - 2.0 * leap.norm().ln() - (most / least).ln().ln();
        Some(returned - leapt)
    }

    /// An estimate that followed it, without it.
    fn ended(&self, mut followed: Alternative) -> Alternative {
        let Kind::Shaped { sized, .. } = self.charge.kind else { return followed };
        let width = self.effects.causes();
        let size = sized.covariance().view((0, 0), (width, width)).clone_owned();
        followed.covariance.spread_by(&self.effects, &size);
        followed.error += &self.effects.total(&sized.value.as_slice()[..width]);
        let [place, way] = UNTIDY.map(|std| std * std);
        POSITION.inflate(&mut followed.covariance, place);
        VELOCITY.inflate(&mut followed.covariance, way);
        followed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lie(cause: usize, chance: f64, north: f64) -> Separation {
        Separation {
            cause,
            chance,
            apart: Vector3::new(north, 0.0, 0.0),
            growth: Vector3::zeros(),
            covariance: Matrix3::from_diagonal_element(25.0),
            spreading: Matrix3::zeros(),
        }
    }

    #[test]
    fn a_leap_to_where_the_ship_would_be_without_a_lie_is_as_likely_its_end_as_it_was_a_lie() {
        let lies = [lie(2, 1e-3, 60.0), lie(4, 1e-4, 60.0), lie(2, 1e-3, 20.0)];
        let chance = chance_of_end(&lies, &Vector3::new(60.0, 0.0, 0.0));
        assert!((chance - 1.1e-3).abs() < 1e-9, "{chance}");
    }

    #[test]
    fn a_leap_elsewhere_ends_no_lie() {
        let chance = chance_of_end(&[lie(2, 1e-3, 60.0)], &Vector3::new(0.0, 60.0, 0.0));
        assert!(chance < 1e-30, "{chance}");
    }
}
