//! A lie of the receiver that a verdict against the IMU has left open.
//!
//! A receiver that begins to drag and an IMU that tells one push wrongly look alike to a ship that has nothing else. One of the two is convicted, and the judge
//! begins anew, or the alignment does; what the receiver may have been doing instead goes on, and the levels go on to allow for it.

use insd_base::{Fault, Party, Span, Standing, Time};
use nalgebra::{Matrix2, Vector2};
use serde::{Deserialize, Serialize};

use super::super::lie::{LASTS, growth, is_growing};
use super::Docket;

/// What the receiver may be doing, of an estimate that follows it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct OpenLie {
    /// How it grows.
    pub fault: Fault,
    /// Since when it would.
    pub since: Time,
    /// Its size, north and east, in units of its fault.
    pub value: Vector2<f64>,
    /// How well that is known, the same squared.
    pub covariance: Matrix2<f64>,
    /// When it was left open, and how likely it was.
    pub left: (Time, f64),
}

impl OpenLie {
    /// What the receiver would be off by now, north and east, m, and how fast that grows, m/s, each with its covariance.
    #[must_use]
    pub fn grown(&self, now: Time) -> Option<[(Vector2<f64>, Matrix2<f64>); 2]> {
        let (size, rate) = growth(self.fault, (now - self.since).as_seconds())?;
        Some([size, rate].map(|times| (self.value * times, self.covariance * (times * times))))
    }

    /// The same on a time line that is later by a span.
    pub(super) fn shifted(self, by: Span) -> Self {
        let (left, chance) = self.left;
        OpenLie { since: self.since + by, left: (left + by, chance), ..self }
    }

    /// How likely it still is.
    #[must_use]
    pub fn chance(&self, now: Time) -> f64 {
        let (since, chance) = self.left;
        chance * (-(now - since).as_seconds() / LASTS).exp()
    }
}

impl Docket {
    /// What the receiver may be doing is not known, nor will be; what it was likelier to be doing stays open.
    pub(in crate::judge) fn leave_lie_open(&mut self, lie: OpenLie) {
        let (now, chance) = lie.left;
        if self.open.is_none_or(|own| own.chance(now) <= chance) {
            self.open = Some(lie);
        }
    }

    /// What was left open is so likely by what was heard since, or is none any more.
    pub(in crate::judge) fn weigh_open_lie(&mut self, chance: Option<f64>) {
        let weighed = |lie: OpenLie, chance| OpenLie { left: (lie.left.0, chance), ..lie };
        self.open = self.open.zip(chance).map(|(lie, chance)| weighed(lie, chance));
    }

    /// The receiver in use is followed though it contradicts the others, as nobody can tell who is right: the position may be off by so much, m.
    pub(in crate::judge) fn follow_contradicted(&mut self, off: f64, now: Time) {
        let grown = self.open.and_then(|lie| lie.grown(now));
        let rate = grown.map_or(0.0, |[_, (rate, _)]| rate.norm());
        let own = self.lie_of(Party::Gnss);
        self.lies[own].unproven = Some((off, rate, now));
        self.enter(Party::Gnss, Standing::Probation, now);
    }

    /// Whether the receiver in use is left out for going astray by and by, as all of its satellites do together.
    #[must_use]
    pub fn has_gone_astray(&self) -> bool {
        let gnss = &self.entries[self.place(Party::Gnss)];
        gnss.standing == Standing::Excluded && gnss.fault.is_some_and(is_growing)
    }

    /// What was left open.
    #[must_use]
    pub fn open_lie(&self) -> Option<&OpenLie> {
        self.open.as_ref()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lie_that_is_left_open_goes_on_to_grow_and_is_forgotten_slowly() {
        let own = OpenLie {
            fault: Fault::Drag,
            since: Time::START,
            value: Vector2::new(0.6, 0.0),
            covariance: Matrix2::identity() * 0.01,
            left: (Time::from_seconds(10.0), 0.5),
        };
        let now = Time::from_seconds(310.0);
        let [(off, unsure), (rate, _)] = own.grown(now).unwrap();
        assert!((off.x - 186.0).abs() < 1e-9 && (rate.x - 0.6).abs() < 1e-12);
        assert!((unsure[(0, 0)] - 961.0).abs() < 1e-9);
        assert!((own.chance(now) - 0.5 * (-0.5_f64).exp()).abs() < 1e-12);
    }
}
