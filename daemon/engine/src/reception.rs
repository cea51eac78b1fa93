//! The fixes of several receivers: one is used, the others go to the judge.

use insd_base::{
    Ecef, Event, Geodetic, GnssFix, Message, Ned, Received, Rejection, Source, Time, earth,
};
use insd_nav::judge::Docket;
use insd_nav::timeline::HISTORY;
use nalgebra::Vector3;

use crate::receivers::index;
use crate::ship::Ship;
use crate::{Engine, Stage, checks};

/// Acceleration of a ship between the time of a fix and its receipt, 1-sigma, m/s^2.
const UNSEEN: f64 = 0.5;

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
        let is_used = self.receivers.is_used(own);
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
        self.receivers.is_passed_over(index(number))
    }

    /// Uses another receiver if another is better, and tells it where the intake does not.
    fn choose_receiver(&mut self, now: Time) {
        if self.surveyor.is_fix_frozen() {
            self.receivers.note_frozen();
        }
        let docket = self.docket();
        let Some((change, is_told)) = self.receivers.choose(&docket, now) else { return };
        self.surveyor.forget_receiver();
        if is_told {
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
