//! Who tells one number, a heading or a distance, and is left out: when he is heard again.
//!
//! Agreement is worth nothing where the lie would not show, as with a navigator that has grown vaguer than it. So what he was off by is remembered: he is heard
//! again after he has agreed with somebody who would see it, or went back by as much as he had come.

use insd_base::{Party, Span, Time};
use serde::{Deserialize, Serialize};

use super::aid::DOCKING_AIDS;

/// Who agrees for so long is heard again, s; each time he relapses for twice as long, up to this.
pub(super) const QUARANTINE: f64 = 60.0;
pub(super) const LONGEST: f64 = 3600.0;
/// Relapses later than this are no relapses, s.
pub(super) const FORGOTTEN: f64 = 3600.0;
/// Who agrees for so long after his lie was undone is heard again, s.
pub(super) const UNDONE: f64 = 5.0;
/// Mean square of the innovations, of which one is expected, beyond which they do not agree, taken together.
pub(super) const STRAINED: f64 = 4.0;
/// A lie shows that is so many times what the navigator is unsure of.
const SHOWS: f64 = 3.0;
/// Who goes back by what he was off by, to this share of it and so many sigmas of his noise, is back, within so long, s.
const BACK: f64 = 0.3;
const NOISE: f64 = 4.0;
const SUCCESSIVE: f64 = 3.0;

/// What he was off by, and how he has agreed since.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Amends {
    pub(super) is_out: bool,
    convicted: Option<Time>,
    off: f64,
    last: Option<(Time, f64)>,
    since: Option<Time>,
    agreed: u32,
    strain: f64,
    needed: f64,
}

impl Amends {
    /// He is left out, as he is off by so much, or nobody knows by how much.
    pub(super) fn leave_out(&mut self, off: f64, now: Time) {
        let is_relapse =
            self.convicted.is_some_and(|at| !self.is_out && (now - at).as_seconds() < FORGOTTEN);
        let needed = if is_relapse { (2.0 * self.needed).min(LONGEST) } else { QUARANTINE };
        *self = Amends { is_out: true, convicted: Some(now), off, needed, ..Amends::default() };
    }

    /// Sees what he is off by now, the mean square of it if he agrees, the sigmas of that and of his noise; tells whether he is heard again.
    pub(super) fn see(
        &mut self,
        now: Time,
        (z, square): (f64, Option<f64>),
        [sigma, noise]: [f64; 2],
    ) -> bool {
        let before = self.last.replace((now, z));
        let step = before.filter(|(at, _)| (now - *at).as_seconds() < SUCCESSIVE);
        let step = step.map_or(0.0, |(_, before)| z - before);
        let is_back = (step + self.off).abs() < BACK * self.off.abs() + NOISE * noise;
        if is_back && step.abs() > NOISE * noise && square.is_some() {
            (self.off, self.needed) = (0.0, UNDONE);
        }
        let would_show = self.off.abs() >= SHOWS * sigma || self.off == 0.0;
        let Some(square) = square.filter(|_| would_show) else {
            self.since = None;
            return false;
        };
        if self.since.is_none() {
            (self.agreed, self.strain) = (0, 0.0);
        }
        let since = *self.since.get_or_insert(now);
        self.agreed += 1;
        self.strain += (square - self.strain) / f64::from(self.agreed);
        if (now - since).as_seconds() < self.needed {
            return false;
        }
        self.since = None;
        self.is_out = self.strain > STRAINED;
        !self.is_out
    }

    fn shifted(self, by: Span) -> Self {
        let convicted = self.convicted.map(|at| at + by);
        Amends { convicted, last: None, since: None, ..self }
    }
}

/// The compass of antennas, and each docking aid with its mark.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Numbers {
    pub(super) antennas: Amends,
    pub(super) docking: [Amends; DOCKING_AIDS],
    /// What each measures to, by its place.
    pub(super) marks: [Option<u8>; DOCKING_AIDS],
    /// Antennas were heard.
    pub(super) has_antennas: bool,
}

impl Numbers {
    pub(super) fn shifted(self, by: Span) -> Self {
        let docking = self.docking.map(|own| own.shifted(by));
        Numbers { antennas: self.antennas.shifted(by), docking, ..self }
    }

    /// Whether anything has been heard of somebody.
    pub(super) fn were_heard(&self, party: Party) -> bool {
        if party == Party::Antennas {
            return self.has_antennas;
        }
        self.marks.iter().any(Option::is_some)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// When one who was found off by so much is heard again, s, who tells this each second to a navigator that is as unsure as this.
    fn heard_again(off: f64, told: fn(u32) -> f64, sigma: fn(u32) -> f64) -> Option<u32> {
        let mut own = Amends::default();
        own.leave_out(off, Time::START);
        (1..2000).find(|second| {
            let (z, sigma) = (told(*second), sigma(*second));
            let square = Some((z / sigma).powi(2)).filter(|square| *square < 15.0);
            own.see(Time::from_seconds(f64::from(*second)), (z, square), [sigma, 0.03])
        })
    }

    #[test]
    fn nobody_is_heard_again_because_the_navigator_has_grown_vague() {
        assert_eq!(heard_again(2.0, |_| 2.0, |second| 0.1 + 0.01 * f64::from(second)), None);
    }

    #[test]
    fn who_agrees_with_somebody_who_would_see_it_is_heard_again() {
        let told = |second| if second < 100 { 2.0 } else { 0.05 };
        assert!(heard_again(2.0, told, |_| 0.1).is_some_and(|second| (100..170).contains(&second)));
    }

    #[test]
    fn who_goes_back_by_what_he_had_come_is_heard_again_at_once() {
        let told = |second| if second < 100 { 2.0 } else { 0.4 };
        let heard = heard_again(1.6, told, |_| 0.9);
        assert!(heard.is_some_and(|second| (100..110).contains(&second)), "{heard:?}");
    }
}
