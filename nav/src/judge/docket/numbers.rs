//! Those who tell one number, before the docket: who of them is left out, and who is heard again.

use insd_base::{Fault, Party, Standing, Time};

use super::Docket;
use crate::judge::aid::{Aid, DOCKING_AIDS};
use crate::judge::amends::Numbers;

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
