//! Who tells one number, a heading or a distance, and is left out: when he is heard again.
//!
//! Agreement is worth nothing where the lie would not show, as with a navigator that has grown vaguer than it. So what he was off by is remembered: he is heard
//! again after he has agreed with somebody who would see it, or went back by as much as he had come.

use insd_base::{Fault, Party, Span, Standing, Time};
use serde::{Deserialize, Serialize};

use super::{Docket, FORGOTTEN, LONGEST, QUARANTINE, STRAINED, UNDONE};
use crate::judge::Aid;
use crate::judge::rows::DOCKING_AIDS;

/// A lie shows that is so many times what the navigator is unsure of.
const SHOWS: f64 = 3.0;
/// Who goes back by what he was off by, to this share of it and so many sigmas of his noise, is back, within so long, s.
const BACK: f64 = 0.3;
const NOISE: f64 = 4.0;
const SUCCESSIVE: f64 = 3.0;

/// What he was off by, and how he has agreed since.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Amends {
    is_out: bool,
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
    fn leave_out(&mut self, off: f64, now: Time) {
        let is_relapse =
            self.convicted.is_some_and(|at| !self.is_out && (now - at).as_seconds() < FORGOTTEN);
        let needed = if is_relapse { (2.0 * self.needed).min(LONGEST) } else { QUARANTINE };
        *self = Amends { is_out: true, convicted: Some(now), off, needed, ..Amends::default() };
    }

    /// Sees what he is off by now, the mean square of it if he agrees, the sigmas of that and of his noise; tells whether he is heard again.
    fn see(
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
    antennas: Amends,
    docking: [Amends; DOCKING_AIDS],
    /// What each measures to, by its place.
    marks: [Option<u8>; DOCKING_AIDS],
    /// Antennas were heard.
    has_antennas: bool,
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

impl Docket {
    /// Antennas that are a compass are heard.
    pub fn note_antennas(&mut self) {
        self.numbers.has_antennas = true;
    }

    /// A docking aid, by its number, measures to a line or point, by its place.
    pub fn note_mark(&mut self, number: usize, place: usize) {
        if let Some(mark) = self.numbers.marks.get_mut(number) {
            *mark = u8::try_from(place).ok();
        }
    }

    /// Whether a fault is one of a docking aid.
    fn concerns(&self, fault: Option<Fault>, number: usize) -> bool {
        let is_it = |own: u8| usize::from(own) == number;
        match fault {
            Some(Fault::DockingJump(own) | Fault::DockingDrift(own)) => is_it(own),
            Some(Fault::DockingMark(place)) => self.numbers.marks[number] == Some(place),
            _ => true,
        }
    }

    /// Whether somebody is suspected, so that what he says with an aid is not used.
    #[must_use]
    pub fn doubts(&self, aid: Aid) -> bool {
        let Some(party) = aid.party() else { return false };
        let fault = self.entries[self.place(party)].fault;
        let is_it = aid.number_of_docking().is_none_or(|number| self.concerns(fault, number));
        self.standing(party) == Standing::Doubtful && is_it
    }

    /// Whether a docking aid is heard, though another one is left out.
    pub(super) fn hears_docking(&self, aid: Aid) -> bool {
        aid.number_of_docking().is_some_and(|number| !self.numbers.docking[number].is_out)
    }

    /// Somebody who tells one number is left out for a fault, as he is off by so much.
    pub(super) fn leave_number_out(&mut self, fault: Fault, off: f64, now: Time) {
        if fault.party() == Party::Antennas {
            self.numbers.antennas.leave_out(off, now);
        }
        let concerned = |number: &usize| self.concerns(Some(fault), *number);
        let all: Vec<usize> = (0..DOCKING_AIDS).filter(concerned).collect();
        for number in all.into_iter().filter(|_| fault.party() == Party::Docking) {
            self.numbers.docking[number].leave_out(off, now);
        }
    }

    /// Which of those are left out, a bit for each.
    #[must_use]
    pub fn numbers_out(&self) -> u8 {
        let Numbers { antennas, docking, .. } = &self.numbers;
        let all = std::iter::once(antennas).chain(docking).enumerate();
        all.filter(|(_, own)| own.is_out).map(|(bit, _)| 1 << bit).sum()
    }

    /// Sees what somebody who tells one number, and is left out, is off by, with the mean square of it if he agrees, and the sigmas of that and of his noise.
    pub fn follow_number(
        &mut self,
        aid: Aid,
        now: Time,
        told: (f64, Option<f64>),
        sigmas: [f64; 2],
    ) {
        let Some(party) = aid.party() else { return };
        let own = match aid.number_of_docking() {
            Some(number) => &mut self.numbers.docking[number],
            None => &mut self.numbers.antennas,
        };
        let is_heard = own.is_out && own.see(now, told, sigmas);
        if is_heard && (party == Party::Antennas || self.numbers_out() & !1 == 0) {
            self.enter(party, Standing::Trusted, now);
        }
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
