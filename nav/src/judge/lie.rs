//! What a receiver that is left out is off by, followed as long as it is.

use insd_base::{Fault, Span, Time};
use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

/// Whoever leads a receiver astray does so for so long, s.
pub(super) const LASTS: f64 = 600.0;
/// A lie of so many sigmas of the navigator's position would show.
const WOULD_SHOW: f64 = 8.0;
/// A step of a position is one beyond so many sigmas of its noise, and this, m.
const STEP: f64 = 6.0;
const LEAST_STEP: f64 = 3.0;
/// A lie that goes away by a step, as one of the first since it was found, is undone.
const FEW: u32 = 2;
/// What it is off by is foreseen to so many times how it grew, and so many sigmas.
const GREW: f64 = 1.5;
const FORESEEN: f64 = 4.0;
/// The navigator is vague of steps after so long without a fix, s.
const SUCCESSIVE: f64 = 3.0;

/// What it is off by, as far as that is known.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct LieOfGnss {
    pub(super) off: Vector2<f64>,
    /// How fast it grew when it was found, m/s.
    pub(super) rate: f64,
    pub(super) seen: Option<Time>,
    /// When it was found, and what it was off by, m.
    found: Option<(Time, f64)>,
    last: Option<(Time, Vector2<f64>)>,
    /// Steps since it was found, and what they have left of what was found, m, if it does not grow: the navigator, which
    /// drifts meanwhile, is not in it.
    steps: u32,
    left: Vector2<f64>,
    /// The position may be off by so much, though nothing shows it, m, and grow so fast, m/s, since then.
    pub(super) unproven: Option<(f64, f64, Time)>,
}

impl LieOfGnss {
    /// It is found to be off by so much, m, and to grow so fast, m/s.
    pub(super) fn find(&mut self, off: Vector2<f64>, rate: f64, now: Time) {
        let (unproven, seen) = (self.unproven, Some(now));
        let found = Some((now, off.norm()));
        *self = LieOfGnss { off, rate, left: off, seen, found, unproven, ..LieOfGnss::default() };
    }

    /// What it may be off by when it was last seen to be, m: a navigator that has drifted sees it from where it is itself.
    pub(super) fn may_be_off(&self) -> f64 {
        let is_gone = self.off == Vector2::zeros();
        if is_gone { 0.0 } else { self.off.norm().max(self.left.norm()) }
    }

    /// What nothing shows, at a time, m.
    pub(super) fn unproven_at(&self, now: Time) -> f64 {
        let grown = |at: Time| (now - at).as_seconds().max(0.0);
        self.unproven.map_or(0.0, |(off, rate, at)| off + rate * grown(at))
    }

    /// The navigator, whose word is the only one against the receiver's, sees it go away otherwise than it was found to, as one does who
    /// drifts himself: nobody knows which of them it is, and the position may be the receiver's.
    pub(super) fn suspect(&mut self, now: Time, z: &Vector2<f64>, sigma: f64) {
        let Some((at, off)) = self.found else { return };
        let age = (now - at).as_seconds().max(1.0);
        let foreseen = off + GREW * self.rate * age + FORESEEN * sigma + LEAST_STEP;
        if z.norm() > foreseen {
            self.unproven = Some((z.norm(), 2.0 * z.norm() / age, now));
        }
    }

    /// Follows it by the innovation of its position, north and east, whether it agrees with the navigator, the sigma that
    /// the navigator has of it, and that of its noise, m. Tells whether it went away as it had come.
    pub(super) fn follow(
        &mut self,
        now: Time,
        z: &Vector2<f64>,
        agrees: bool,
        [sigma, noise]: [f64; 2],
    ) -> bool {
        let last = self.last.replace((now, *z));
        let before = last.filter(|(at, _)| (now - *at).as_seconds() < SUCCESSIVE);
        let step = before.map_or_else(Vector2::zeros, |(_, before)| z - before);
        let is_step = step.norm() > LEAST_STEP.max(STEP * noise * std::f64::consts::SQRT_2);
        if is_step {
            self.left += step;
            self.steps = self.steps.saturating_add(1);
        }
        if !agrees {
            (self.off, self.seen) = (*z, Some(now));
            return false;
        }
        self.off += if is_step { step } else { Vector2::zeros() };
        let grown = self.seen.map_or(0.0, |seen| self.rate * (now - seen).as_seconds());
        let unsure = LEAST_STEP.max(STEP * noise) + grown;
        let left =
            if self.rate > 0.0 { self.off.norm() } else { self.left.norm().min(self.off.norm()) };
        let is_undone = is_step && left < unsure;
        if is_undone || self.off.norm() > WOULD_SHOW * sigma {
            (self.off, self.rate) = (Vector2::zeros(), 0.0);
        }
        is_undone && self.steps <= FEW
    }

    /// What is left of it when the navigator begins anew: what is unproven stays so.
    pub(super) fn forgotten(self) -> Self {
        LieOfGnss { unproven: self.unproven, ..LieOfGnss::default() }
    }

    /// The same on a time line that is later by a span.
    pub(super) fn shifted(self, by: Span) -> Self {
        let unproven = self.unproven.map(|(off, rate, at)| (off, rate, at + by));
        let found = self.found.map(|(at, off)| (at + by, off));
        LieOfGnss { seen: self.seen.map(|seen| seen + by), found, last: None, unproven, ..self }
    }
}

/// Whether a lie grows, so that a leap may end it.
pub(super) fn is_growing(fault: Fault) -> bool {
    matches!(fault, Fault::Drag | Fault::Slide | Fault::Creep)
}

/// What a unit of a lie of a receiver has grown to after such an age, s, and how fast it grows; `None` of what moves no place.
pub(super) fn growth(fault: Fault, age: f64) -> Option<(f64, f64)> {
    match fault {
        Fault::Jump | Fault::SpareJump => Some((1.0, 0.0)),
        Fault::Drag | Fault::Slide | Fault::SpareDrag => Some((age, 1.0)),
        Fault::Creep => Some((0.5 * age * age, age)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether a jump of 12 m that was found is undone at some time, seen by a navigator that drifts away at a rate, m/s.
    fn is_undone(drift: f64, off: impl Fn(u32) -> f64) -> bool {
        let mut lie = LieOfGnss::default();
        lie.find(Vector2::new(12.0, 0.0), 0.0, Time::START);
        (1..60).any(|second| {
            let t = f64::from(second);
            let z = Vector2::new(off(second) - drift * t, 0.0);
            let agrees = z.norm() < 10.0;
            lie.follow(Time::from_seconds(t), &z, agrees, [1.0 + drift * t, 0.3])
        })
    }

    #[test]
    fn a_jump_that_goes_back_is_undone_even_where_the_navigator_has_drifted() {
        assert!(is_undone(0.0, |t| if t < 30 { 12.0 } else { 0.0 }));
        assert!(is_undone(0.2, |t| if t < 30 { 12.0 } else { 0.0 }));
    }

    #[test]
    fn a_step_does_not_undo_what_grows() {
        let mut lie = LieOfGnss::default();
        lie.find(Vector2::new(12.0, 0.0), 1.0, Time::START);
        let is_undone = (1..300).any(|second| {
            let t = f64::from(second);
            let z = Vector2::new(12.0 + t + if second > 200 { 10.0 } else { 0.0 }, 0.0);
            lie.follow(Time::from_seconds(t), &z, second > 150, [0.003 * t * t, 0.3])
        });
        assert!(!is_undone);
    }

    #[test]
    fn a_navigator_that_drifts_towards_it_takes_nothing_from_it() {
        let mut lie = LieOfGnss::default();
        lie.find(Vector2::new(120.0, 0.0), 0.0, Time::START);
        for second in 1..=100 {
            let t = f64::from(second);
            let z = Vector2::new(120.0 - t, 0.0);
            lie.follow(Time::from_seconds(t), &z, second > 90, [3.0 * t, 1.0]);
        }
        assert!((lie.may_be_off() - 120.0).abs() < 1e-9, "{}", lie.may_be_off());
    }

    /// One that was found to drift by 0.1 m/s, and is seen to go away as the square of time, or as it was found to.
    #[test]
    fn whoever_goes_away_otherwise_than_foreseen_may_be_right() {
        let of = |off: fn(f64) -> f64| {
            let mut lie = LieOfGnss::default();
            lie.find(Vector2::new(2.0, 0.0), 0.1, Time::START);
            (1..=120).map(f64::from).for_each(|t| {
                lie.suspect(Time::from_seconds(t), &Vector2::new(off(t), 0.0), 1.0);
            });
            lie.unproven_at(Time::from_seconds(120.0))
        };
        assert_eq!(of(|t| 0.02 * t * t), 288.0);
        assert_eq!(of(|t| 2.0 + 0.1 * t), 0.0);
    }

    #[test]
    fn one_that_stays_or_wanders_is_not() {
        assert!(!is_undone(0.2, |_| 12.0));
        assert!(!is_undone(0.0, |t| if t % 2 == 0 { 12.0 } else { -8.0 }));
    }
}
