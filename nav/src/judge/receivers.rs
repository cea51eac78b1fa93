//! Several receivers before the judge: which is in use, and which is compared with it.

use insd_base::{Party, Standing, Time};

use super::aid::Hearing;
use super::dissenter::Success;
use super::{Aid, Judge};

/// A receiver that is compared and has been silent for so long gives way to another, s.
const SILENT: f64 = 10.0;

/// What is heard of it.
const SPARE: [Aid; 2] = [Aid::SparePosition, Aid::SpareVelocity];

impl Judge {
    /// Another receiver, by its number, is in use from now on. The noise of either is not that of the other.
    pub fn use_receiver(&mut self, number: u8, now: Time) {
        self.docket.use_receiver(number, now);
        self.forget_noise(&[Aid::GnssPosition, Aid::GnssVelocity]);
        self.forget_noise(&SPARE);
    }

    /// Whether a receiver, by its number, is compared now. One is at a time: another takes the place of one that
    /// is silent, or left out while the other is not.
    pub fn admits_spare(&mut self, number: u8, now: Time) -> bool {
        let (own, docket) = (Party::receiver(number), &self.docket);
        if own == docket.receiver_in_use() {
            return false;
        }
        let is_out = |party| docket.receiver_stands(party) == Standing::Excluded;
        let is_silent = !self.hearings[Aid::SparePosition as usize].was_within(now, SILENT);
        let gives_way = is_silent || (is_out(docket.receiver_compared()) && !is_out(own));
        if own != docket.receiver_compared() && !gives_way {
            return false;
        }
        if self.docket.compare_receiver(number, now) {
            self.forget_noise(&SPARE);
            self.spare = Success::default();
            self.onsets.iter_mut().for_each(|onset| onset.forget(Party::Gnss2));
        }
        true
    }

    /// An aid that is left out speaks.
    pub fn note_word(&mut self, aid: Aid, now: Time) {
        self.hearings[aid as usize].note_word(now);
    }

    /// Whether somebody says something with an aid, believed or not.
    #[must_use]
    pub fn has_spoken(&self, aid: Aid, now: Time, within: f64) -> bool {
        self.hearings[aid as usize].spoke_within(now, within)
    }

    fn forget_noise(&mut self, aids: &[Aid]) {
        aids.iter().for_each(|aid| self.hearings[*aid as usize] = Hearing::default());
    }

    /// Time since an aid was heard, s; infinite if it never was.
    #[must_use]
    pub fn unheard(&self, aid: Aid, now: Time) -> f64 {
        self.hearings[aid as usize].unheard(now)
    }
}
