//! Which of several receivers is used, and what becomes of the others.
//!
//! The intake ranks them: 0 is the one that it would use. The engine uses that one unless it was found to lie and another
//! was not. Fixes of the others go to the judge, who compares them with the navigator; nothing else hears them.

use insd_base::{
    Ecef, Event, Geodetic, GnssFix, Message, Ned, Parties, Party, Received, ReceiverChange,
    Rejection, Source, Standing, Time, earth,
};
use insd_nav::judge::Docket;
use insd_nav::timeline::HISTORY;
use nalgebra::Vector3;

use crate::ship::Ship;
use crate::{Engine, Stage, checks};

/// A receiver that is not the intake's choice can be used if it was heard within this, s.
const FRESH: f64 = 5.0;
/// One that was the intake's choice and has said nothing for so long while another is, is so no more, s.
const LEFT: f64 = 1.5;
/// A receiver is compared no more often than this, s.
const SPACING: f64 = 0.95;
/// Acceleration of a ship between the time of a fix and its receipt, 1-sigma, m/s^2.
const UNSEEN: f64 = 0.5;

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

fn index(number: u8) -> usize {
    usize::from(number).min(Party::RECEIVERS.len() - 1)
}

impl Receivers {
    fn hear(&mut self, own: usize, fix: &GnssFix, receipt: Time) {
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

    /// Whether it is time to compare one, with a fix that was valid then; takes note of it.
    fn is_compared(&mut self, own: usize, time: Time) -> bool {
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

impl Engine {
    /// A message as it is to be used. The fix of a receiver that is not in use is compared, and goes no further.
    pub(crate) fn as_used(&mut self, received: &Received) -> Option<Received> {
        if self.is_of_liar(received) {
            let is_rtk = matches!(received.message, Message::Rtk(_));
            let aid = if is_rtk { "rtk_position" } else { "satellite_code" };
            self.reject(received, aid, Rejection::SourceSuspect);
            return None;
        }
        let (Message::Gnss(fix), Source::Gnss(number)) = (&received.message, received.source)
        else {
            return Some(received.clone());
        };
        let own = index(number);
        self.receivers.hear(own, fix, received.receipt);
        self.choose_receiver(received.receipt);
        let is_used = self.receivers.in_use == Some(own);
        let rank = if is_used { 0 } else { fix.rank.max(1) };
        let marked = Received { message: Message::Gnss(GnssFix { rank, ..*fix }), ..*received };
        if is_used {
            return Some(marked);
        }
        if self.receivers.is_compared(own, fix.time) {
            self.compare(&marked);
        }
        None
    }

    /// Whether these are ranges of the receiver of the intake's choice, while another is used for its lies.
    fn is_of_liar(&self, received: &Received) -> bool {
        let (Message::Ranges(_) | Message::Rtk(_), Source::Gnss(number)) =
            (&received.message, received.source)
        else {
            return false;
        };
        self.receivers.is_own_choice && self.receivers.in_use != Some(index(number))
    }

    /// Uses another receiver if another is better, and tells it where the intake does not.
    fn choose_receiver(&mut self, now: Time) {
        if let Some(own) = self.receivers.in_use.filter(|_| self.surveyor.is_fix_frozen())
            && let Some(heard) = &mut self.receivers.heard[own]
        {
            heard.frozen = heard.place;
        }
        let docket = self.docket();
        let Some(to) = self.receivers.best(&docket, now) else { return };
        let before = self.receivers.in_use.replace(to);
        let is_own = self.receivers.heard[to].is_some_and(|heard| heard.rank > 0);
        let was_own = std::mem::replace(&mut self.receivers.is_own_choice, is_own);
        let Some(from) = before.filter(|from| *from != to) else { return };
        let is_for_lie = self.receivers.class(from, &docket) == 2;
        self.surveyor.forget_receiver();
        if is_own || was_own {
            let [from, to] = [from, to].map(|own| Party::RECEIVERS[own]);
            let change = ReceiverChange { from, to, is_for_lie };
            self.tell(Event::ReceiverUsed { time: now, change });
        }
    }

    /// How far everybody is believed.
    pub(crate) fn docket(&self) -> Docket {
        self.ship().and_then(Ship::docket).unwrap_or(self.nav.docket)
    }

    /// Lets the judge compare a fix, carried on to the newest sample of the IMU: what it is compared with to metres need
    /// not send the ship back on her time line.
    fn compare(&mut self, received: &Received) {
        let (checked, _) = checks::checked(received, self.config.vessel);
        let checked = self.surveyor.completed(&checked);
        let Stage::Running(line) = &mut self.stage else { return };
        let Message::Gnss(fix) = checked.message else { return };
        let late = line.now() - fix.time;
        if line.estimator().has_one_heading() && late < HISTORY {
            let fix = if late.as_seconds() > 0.0 { carried(&fix, line.now()) } else { fix };
            // nothing comes of it that would have to be told: the judge looks at it once a second
            line.measure(&Received { message: Message::Gnss(fix), ..checked });
        }
    }
}

/// A fix as it would be at a later instant.
fn carried(fix: &GnssFix, to: Time) -> GnssFix {
    let late = (to - fix.time).as_seconds();
    let v_n = fix.velocity.map_or_else(Vector3::zeros, |velocity| velocity.0);
    let way = v_n.map(|v| if v.is_finite() { v * late } else { 0.0 });
    let moved = |place: Geodetic| {
        earth::geodetic(&Ecef(earth::ecef(&place).0 + earth::c_ne(&place).tr_mul(&way)))
    };
    let unsure = |std: Ned| Ned(std.0.map(|std| std.hypot(UNSEEN * late)));
    GnssFix {
        time: to,
        position: fix.position.map(moved),
        velocity_std: fix.velocity_std.map(unsure),
        ..*fix
    }
}
