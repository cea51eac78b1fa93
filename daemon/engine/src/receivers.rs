//! Which of several receivers is used, and what becomes of the others.
//!
//! The intake ranks them: 0 is the one that it would use. The engine uses that one unless it was found to lie and another
//! was not. Fixes of the others go to the judge, who compares them with the navigator; nothing else hears them.

use insd_base::{Geodetic, GnssFix, Parties, Party, ReceiverChange, Standing, Time};
use insd_nav::judge::Docket;

/// A receiver that is not the intake's choice can be used if it was heard within this, s.
const FRESH: f64 = 5.0;
/// One that was the intake's choice and has said nothing for so long while another is, is so no more, s.
const LEFT: f64 = 1.5;
/// A receiver is compared no more often than this, s.
const SPACING: f64 = 0.95;

/// What was heard last of one.
#[derive(Clone, Copy, Debug)]
struct Heard {
    receipt: Time,
    rank: u8,
    place: Option<Geodetic>,
    /// Where it stands still though the ship does not, while it does.
    frozen: Option<Geodetic>,
    /// Time of validity of the fix that was compared last.
    compared: Option<Time>,
}

/// All of them, by their numbers.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Receivers {
    heard: [Option<Heard>; Party::RECEIVERS.len()],
    in_use: Option<usize>,
    /// The one in use is not the intake's choice.
    is_own_choice: bool,
}

/// Of a receiver by its number.
pub(crate) fn index(number: u8) -> usize {
    usize::from(number).min(Party::RECEIVERS.len() - 1)
}

impl Receivers {
    pub(crate) fn hear(&mut self, own: usize, fix: &GnssFix, receipt: Time) {
        let before = self.heard[own];
        let frozen = before.and_then(|before| before.frozen);
        let heard = Heard {
            receipt,
            rank: fix.rank,
            place: fix.position,
            frozen: frozen.filter(|place| fix.position == Some(*place)),
            compared: before.and_then(|before| before.compared),
        };
        for other in self.heard.iter_mut().flatten().filter(|_| fix.rank == 0) {
            if (receipt - other.receipt).as_seconds() > LEFT {
                other.rank = other.rank.max(1);
            }
        }
        self.heard[own] = Some(heard);
    }

    /// How little is to be said for using one: nothing speaks against it; it is doubted, or was found to lie once; it
    /// lies.
    fn class(&self, own: usize, docket: &Docket) -> u8 {
        let is_frozen = self.heard[own].is_some_and(|heard| heard.frozen.is_some());
        match docket.receiver_stands(Party::RECEIVERS[own]) {
            _ if is_frozen => 2,
            Standing::Trusted => 0,
            Standing::Doubtful if self.in_use == Some(own) => 0,
            Standing::Doubtful | Standing::Probation => 1,
            Standing::Excluded => 2,
        }
    }

    /// The best that is heard; the one in use if none is.
    fn best(&self, docket: &Docket, now: Time) -> Option<usize> {
        let is_fresh =
            |heard: &Heard| heard.rank == 0 || (now - heard.receipt).as_seconds() <= FRESH;
        let all = self.heard.iter().enumerate();
        let fresh = all.filter_map(|(own, heard)| Some((own, (*heard).filter(is_fresh)?)));
        let best = fresh.min_by_key(|(own, heard)| (self.class(*own, docket), heard.rank, *own));
        best.map(|(own, _)| own).or(self.in_use)
    }

    /// Uses another if another is better: gives the change, and whether it is to be told, as the intake tells its own.
    pub(crate) fn choose(&mut self, docket: &Docket, now: Time) -> Option<(ReceiverChange, bool)> {
        let to = self.best(docket, now)?;
        let before = self.in_use.replace(to);
        let is_own = self.heard[to].is_some_and(|heard| heard.rank > 0);
        let was_own = std::mem::replace(&mut self.is_own_choice, is_own);
        let from = before.filter(|from| *from != to)?;
        let is_for_lie = self.class(from, docket) == 2;
        let [from, to] = [from, to].map(|own| Party::RECEIVERS[own]);
        Some((ReceiverChange { from, to, is_for_lie }, is_own || was_own))
    }

    pub(crate) fn is_used(&self, own: usize) -> bool {
        self.in_use == Some(own)
    }

    /// Whether another is used than one that the intake has chosen, which is not to be believed then.
    pub(crate) fn is_passed_over(&self, own: usize) -> bool {
        self.is_own_choice && !self.is_used(own)
    }

    /// The one in use stands still where she does not.
    pub(crate) fn note_frozen(&mut self) {
        let in_use = self.in_use.and_then(|own| self.heard[own].as_mut());
        in_use.into_iter().for_each(|heard| heard.frozen = heard.place);
    }

    /// Whether it is time to compare one, with a fix that was valid then; takes note of it.
    pub(crate) fn is_compared(&mut self, own: usize, time: Time) -> bool {
        let Some(heard) = &mut self.heard[own] else { return false };
        let is_due = heard.compared.is_none_or(|last| (time - last).as_seconds() >= SPACING);
        if is_due {
            heard.compared = Some(time);
        }
        is_due
    }

    /// Those of a set, in which the receiver in use goes by [`Party::Gnss`], and others that stand still, by their names.
    pub(crate) fn named(&self, parties: Parties) -> Parties {
        let own = self.in_use.map_or(Party::Gnss, |own| Party::RECEIVERS[own]);
        let named = parties.iter().map(|party| if party == Party::Gnss { own } else { party });
        let is_frozen = |heard: &Heard| heard.frozen.is_some();
        let others =
            Party::RECEIVERS.into_iter().zip(self.heard).filter(|(party, _)| *party != own);
        let frozen = others.filter(|(_, heard)| heard.as_ref().is_some_and(is_frozen));
        named.chain(frozen.map(|(party, _)| party)).collect()
    }
}
