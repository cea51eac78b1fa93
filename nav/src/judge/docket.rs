//! How far everybody is believed, and when somebody who was left out is believed again.
//!
//! Nobody is believed again because he waited. He has to agree with the others, and be seen to: a receiver whose
//! lie is within what the navigator is unsure of by now agrees with anything. So the lie is followed. While it shows it
//! is what the receiver and the navigator differ by; later only its steps are seen. If it went away, the receiver is
//! trusted again; if it could still be there, the position is claimed to be no better than that.
//!
//! Of several receivers one is in use and one is compared with it. Here, as in all of the judge, these two are
//! [`Party::Gnss`] and [`Party::Gnss2`], whichever they are; each keeps what it did when it takes another part, and is told
//! by its own name.

mod anew;
mod numbers;
mod of_imu;
mod open;

use insd_base::{Fault, Integrity, Judgement, Parties, Party, Standing, Stands, Time};
use insd_estimation::Weighed;
use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use super::aid::{Aid, agreement};
use super::amends::{FORGOTTEN, LONGEST, Numbers, QUARANTINE, STRAINED, UNDONE};
use super::lie::LieOfGnss;
pub(crate) use open::OpenLie;

/// An IMU that was found wrong and mended is doubted for so long, s.
const MENDED: f64 = 600.0;

/// Sigmas of a radius that hold 95 %.
const RADIUS: f64 = 2.448;
/// A receiver that is so near to where it was at first has not leapt, m.
const LEAPT: f64 = 10.0;

/// Of whoever is no receiver that is off by something.
pub(super) const NO_LIE: (Vector2<f64>, f64) = (Vector2::new(0.0, 0.0), 0.0);

/// One of them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Entry {
    standing: Standing,
    since: Time,
    fault: Option<Fault>,
    /// Since when, how often, and the mean square of the innovations of all that.
    agreeing_since: Option<Time>,
    agreed: u32,
    strain: f64,
    quarantine: f64,
    /// By how much the gain of a log was off, along and across.
    gain: Vector2<f64>,
}

impl Default for Entry {
    fn default() -> Self {
        Entry {
            standing: Standing::Trusted,
            since: Time::START,
            fault: None,
            agreeing_since: None,
            agreed: 0,
            strain: 0.0,
            quarantine: QUARANTINE,
            gain: Vector2::zeros(),
        }
    }
}

/// Which receiver has which part, by their numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Parts {
    in_use: u8,
    compared: u8,
    /// How many there are, as far as was heard.
    heard: u8,
}

impl Default for Parts {
    fn default() -> Self {
        Parts { in_use: 0, compared: 1, heard: 1 }
    }
}

/// The standing of all.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Docket {
    entries: [Entry; Party::ALL.len()],
    parts: Parts,
    lies: [LieOfGnss; Party::RECEIVERS.len()],
    /// The IMU is not believed since then, and has last been seen to be wrong then.
    restless: Option<(Time, Time)>,
    /// The IMU is of no use.
    condemned: bool,
    /// By how many steps the IMU was found to be worse than its data sheet.
    worse: u8,
    /// The IMU was found wrong by one witness, who may be so himself, or by two that may lie alike.
    by_one: bool,
    /// Two told another speed at once then, which the IMU did not feel.
    alike: Option<Time>,
    /// What the receiver in use may be doing instead of what the IMU was convicted of.
    open: Option<OpenLie>,
    /// Those who tell one number.
    numbers: Numbers,
}

impl Docket {
    /// Where the entry of somebody is, and of a receiver with a part.
    fn place(&self, party: Party) -> usize {
        let named = match party {
            Party::Gnss => self.receiver_in_use(),
            Party::Gnss2 => Party::receiver(self.parts.compared),
            other => other,
        };
        named as usize
    }

    /// Where the lie of a receiver with a part is.
    fn lie_of(&self, party: Party) -> usize {
        let number = if party == Party::Gnss { self.parts.in_use } else { self.parts.compared };
        usize::from(number).min(self.lies.len() - 1)
    }

    /// The receiver that is in use, by its own name.
    #[must_use]
    pub fn receiver_in_use(&self) -> Party {
        Party::receiver(self.parts.in_use)
    }

    /// The receiver that is compared with it, by its own name.
    #[must_use]
    pub fn receiver_compared(&self) -> Party {
        Party::receiver(self.parts.compared)
    }

    /// How a receiver stands, by its own name.
    #[must_use]
    pub fn receiver_stands(&self, named: Party) -> Standing {
        self.entries[named as usize].standing
    }

    /// Another receiver, by its number, is in use from now on. The one before is compared with it.
    pub fn use_receiver(&mut self, number: u8, now: Time) {
        let number = number.min(Party::RECEIVERS.len() as u8 - 1);
        self.drop_doubt(now);
        let Parts { in_use, heard, .. } = self.parts;
        if number != in_use {
            self.parts = Parts { in_use: number, compared: in_use, heard: heard.max(number + 1) };
        }
    }

    /// A receiver, by its number, is compared with the one in use from now on; tells whether another was.
    pub fn compare_receiver(&mut self, number: u8, now: Time) -> bool {
        let number = number.min(Party::RECEIVERS.len() as u8 - 1);
        self.parts.heard = self.parts.heard.max(number + 1);
        let is_other = number != self.parts.compared && number != self.parts.in_use;
        if is_other {
            self.drop_doubt(now);
            self.parts.compared = number;
        }
        is_other
    }

    /// Who is suspected in one part is not in another.
    fn drop_doubt(&mut self, now: Time) {
        for part in [Party::Gnss, Party::Gnss2] {
            if self.standing(part) == Standing::Doubtful {
                self.enter(part, Standing::Trusted, now);
            }
        }
    }

    /// How far somebody is believed.
    #[must_use]
    pub fn standing(&self, party: Party) -> Standing {
        self.entries[self.place(party)].standing
    }

    /// What is made of all where nobody compares them.
    #[must_use]
    pub fn judgement(&self) -> Judgement {
        let is_out = |stands: &Stands| stands.standing == Standing::Excluded;
        let excluded: Parties = self.all().filter(is_out).map(|stands| stands.party).collect();
        let integrity = if self.standing(Party::Gnss) == Standing::Probation {
            Integrity::Unproven
        } else {
            Integrity::Unwatched
        };
        Judgement { integrity, excluded }
    }

    /// The receiver in use has leapt, m, by all in all, where nobody could tell which of its words was true: it is used, and the
    /// position is claimed to be no better.
    pub fn suspect(&mut self, off: &Vector2<f64>, now: Time) {
        let own = self.lie_of(Party::Gnss);
        let (unproven, standing) = if off.norm() > LEAPT {
            (Some((off.norm(), 0.0, now)), Standing::Probation)
        } else {
            (None, Standing::Trusted)
        };
        self.lies[own].unproven = unproven;
        self.enter(Party::Gnss, standing, now);
        let place = self.place(Party::Gnss);
        self.entries[place].fault = Some(Fault::Jump);
    }

    /// Sees position and velocity of a receiver that is left out together, weighed by a navigator whose position is known to `own`, 1-sigma, m, and
    /// follows what the receiver, by its part, is off by; `alone` where only the navigator speaks against it.
    pub fn see_receiver(
        &mut self,
        (party, now): (Party, Time),
        weighed: &Weighed,
        [noise, own]: [f64; 2],
        alone: bool,
    ) {
        let z = Vector2::new(weighed.z()[0], weighed.z()[1]);
        let (square, sigma) = (agreement(weighed), own.hypot(noise));
        let agrees = square.is_some();
        let lie = self.lie_of(party);
        if alone && !agrees {
            self.lies[lie].suspect(now, &z, sigma);
        }
        let is_undone = self.lies[lie].follow(now, &z, agrees, [sigma, noise]);
        // where another receiver is used instead there is no hurry
        if is_undone && party == Party::Gnss {
            let place = self.place(party);
            self.entries[place].quarantine = UNDONE;
        }
        self.watch(party, now, square);
    }

    /// With somebody left out for what he was found to do before.
    #[must_use]
    pub fn without(mut self, fault: Fault, now: Time) -> Self {
        self.convict(fault, now, NO_LIE);
        self
    }

    /// With a log left out that tells so many times her speed.
    #[must_use]
    pub fn without_gain(mut self, gain: f64, now: Time) -> Self {
        self.convict(Fault::LogGain, now, (Vector2::new(gain - 1.0, 0.0), 0.0));
        self
    }

    /// How all stand, each by its own name.
    pub fn all(&self) -> impl Iterator<Item = Stands> {
        let heard = usize::from(self.parts.heard);
        let is_there = move |(party, entry): &(Party, Entry)| match party {
            Party::Antennas | Party::Docking => {
                entry.standing != Standing::Trusted || self.numbers.were_heard(*party)
            }
            receiver if receiver.is_receiver() => (*receiver as usize) < heard,
            _ => true,
        };
        let all = Party::ALL.into_iter().zip(self.entries);
        all.filter(is_there).map(|(party, entry)| {
            let Entry { standing, since, fault, .. } = entry;
            Stands { party, standing, since, fault }
        })
    }

    /// Whether somebody is left out.
    #[must_use]
    pub fn is_excluded(&self, party: Party) -> bool {
        self.standing(party) == Standing::Excluded
    }

    /// Whether what somebody says with an aid is left out: of a receiver that is found to tell a wrong velocity, only
    /// that is; of one with a wrong height no aid is ([`Docket::tells_wrong_height`]).
    #[must_use]
    pub fn leaves_out(&self, aid: Aid) -> bool {
        let Some(party) = aid.party() else { return false };
        let is_heard = match self.entries[self.place(party)].fault {
            Some(Fault::Velocity) => aid == Aid::GnssPosition,
            Some(Fault::Height) => true,
            _ => self.hears_docking(aid),
        };
        self.is_excluded(party) && !is_heard
    }

    /// Whether the receiver is used but for its height.
    #[must_use]
    pub fn tells_wrong_height(&self) -> bool {
        let gnss = &self.entries[self.place(Party::Gnss)];
        gnss.standing == Standing::Excluded && gnss.fault == Some(Fault::Height)
    }

    /// Whether a receiver is left out wholly.
    #[must_use]
    pub fn leaves_out_gnss(&self) -> bool {
        self.leaves_out(Aid::GnssPosition)
    }

    /// 1-sigma of each component that covers what the position may be off by though no other sigma tells it, m.
    #[must_use]
    pub fn unproven_std(&self, now: Time) -> f64 {
        self.lies[self.lie_of(Party::Gnss)].unproven_at(now) / RADIUS
    }

    fn enter(&mut self, party: Party, standing: Standing, now: Time) {
        let place = self.place(party);
        let entry = &mut self.entries[place];
        if entry.standing != standing {
            (entry.standing, entry.since) = (standing, now);
        }
        entry.agreeing_since = None;
    }

    /// Leaves somebody out; the IMU, which cannot be, is doubted. A receiver is off by so much, m, which grows so
    /// fast, m/s.
    pub fn convict(&mut self, fault: Fault, now: Time, lie: (Vector2<f64>, f64)) {
        let party = fault.party();
        let place = self.place(party);
        let entry = &mut self.entries[place];
        entry.fault = Some(fault);
        entry.gain = if fault == Fault::LogGain { lie.0 } else { Vector2::zeros() };
        let is_relapse = entry.since > Time::START && (now - entry.since).as_seconds() < FORGOTTEN;
        entry.quarantine = if is_relapse && entry.standing != Standing::Doubtful {
            (entry.quarantine * 2.0).min(LONGEST)
        } else if fault == Fault::HeadingDrift {
            10.0 * QUARANTINE // coarse gyros of which little is known follow it for a minute or two
        } else {
            QUARANTINE
        };
        if party == Party::Imu {
            self.enter(party, Standing::Doubtful, now);
            self.entries[place].since = now;
            return;
        }
        self.enter(party, Standing::Excluded, now);
        // a distance that has gone into the estimate stays there, whatever the receiver is left out for now
        self.open = self.open.filter(|lie| party != Party::Gnss || lie.fault == Fault::Jump);
        self.leave_number_out(fault, lie.0.x, now);
        if party.is_receiver() {
            self.lies[self.lie_of(party)].find(lie.0, lie.1, now);
        }
    }

    /// The receiver in use was left out for what may be its return from a lie: the position may be off by so much, m.
    pub fn leave_open(&mut self, off: f64, now: Time) {
        self.lies[self.lie_of(Party::Gnss)].unproven = Some((off, 0.0, now));
    }

    /// What the receiver in use, which is left out, says that she is off by, north and east, m.
    #[must_use]
    pub fn off_by_gnss(&self) -> Vector2<f64> {
        self.lies[self.lie_of(Party::Gnss)].off
    }

    /// By how much the gain of a log that is left out for it was off, along and across.
    #[must_use]
    pub(super) fn gain_of_log(&self) -> Option<Vector2<f64>> {
        let log = &self.entries[self.place(Party::Log)];
        Some(log.gain).filter(|gain| log.standing == Standing::Excluded && gain.norm() > 0.0)
    }

    /// Whether the receiver in use is left out for a leap of its place.
    #[must_use]
    pub fn has_leapt(&self) -> bool {
        let gnss = &self.entries[self.place(Party::Gnss)];
        gnss.standing == Standing::Excluded && gnss.fault == Some(Fault::Jump)
    }

    /// Somebody is not suspected any more.
    pub fn drop_suspicion(&mut self, party: Party, now: Time) {
        if self.standing(party) == Standing::Doubtful {
            self.enter(party, Standing::Trusted, now);
        }
    }

    /// Whoever is doubted, by what the last look gave.
    pub fn doubt(&mut self, fault: Option<Fault>, now: Time) {
        let party = fault.map(Fault::party);
        for each in Party::ALL.into_iter().filter(|each| !matches!(each, Party::Gnss3 | Party::Imu))
        {
            match self.standing(each) {
                Standing::Trusted if party == Some(each) => {
                    self.enter(each, Standing::Doubtful, now);
                    let place = self.place(each);
                    self.entries[place].fault = fault;
                }
                Standing::Doubtful if party != Some(each) => {
                    self.enter(each, Standing::Trusted, now);
                }
                _ => {}
            }
        }
        let imu = &self.entries[Party::Imu as usize];
        if imu.standing == Standing::Doubtful && (now - imu.since).as_seconds() > MENDED {
            self.enter(Party::Imu, Standing::Trusted, now);
        }
    }

    /// Sees whether somebody who is left out agrees with the navigator; who has for long enough is heard again.
    pub fn watch(&mut self, party: Party, now: Time, square: Option<f64>) {
        let place = self.place(party);
        let entry = &mut self.entries[place];
        let Some(square) = square else {
            entry.agreeing_since = None;
            return;
        };
        if entry.agreeing_since.is_none() {
            (entry.agreed, entry.strain) = (0, 0.0);
        }
        let since = *entry.agreeing_since.get_or_insert(now);
        entry.agreed += 1;
        entry.strain += (square - entry.strain) / f64::from(entry.agreed);
        if (now - since).as_seconds() < entry.quarantine {
            return;
        }
        if entry.strain > STRAINED {
            entry.agreeing_since = None;
        } else {
            self.acquit(party, now);
        }
    }

    /// Hears somebody again who was left out for no more than a fault that turns out to be none.
    pub fn recall(&mut self, party: Party, now: Time, is_none: fn(Fault) -> bool) {
        if self.entries[self.place(party)].fault.is_some_and(is_none) {
            self.enter(party, Standing::Trusted, now);
            if party.is_receiver() {
                self.lies[self.lie_of(party)] = LieOfGnss::default();
            }
        }
    }

    fn acquit(&mut self, party: Party, now: Time) {
        let mut standing = Standing::Trusted;
        if party.is_receiver() {
            let lie = &mut self.lies[self.lie_of(party)];
            let left = lie.may_be_off();
            if left > 0.0 {
                let seen = lie.seen.unwrap_or(now);
                lie.unproven = Some((left.max(lie.unproven_at(seen)), lie.rate, seen));
            }
            if lie.unproven.is_some() {
                standing = Standing::Probation;
            }
        }
        self.enter(party, standing, now);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether a log is heard again of which each word for five minutes is off by such a mean square.
    fn is_heard_again(square: fn(u32) -> f64) -> bool {
        let mut docket = Docket::default();
        docket.convict(Fault::LogOffset, Time::START, NO_LIE);
        (1..300).any(|second| {
            docket.watch(Party::Log, Time::from_seconds(second.into()), Some(square(second)));
            docket.standing(Party::Log) == Standing::Trusted
        })
    }

    #[test]
    fn who_agrees_word_by_word_but_not_taken_together_is_not_heard_again() {
        assert!(is_heard_again(|_| 1.0));
        assert!(is_heard_again(|second| f64::from(second % 4) * 2.5));
        assert!(!is_heard_again(|_| 6.0));
    }

    #[test]
    fn who_comes_to_agree_is() {
        assert!(is_heard_again(|second| if second < 130 { 7.0 } else { 1.0 }));
    }
}
