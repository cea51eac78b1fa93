//! What is found to be otherwise than configured, and what follows from it.

use insd_base::{Estimates, Event, Finding, GnssFix, Message, Mode, ModeReason, Received, Time};
use insd_nav::Estimator;
use insd_nav::config::LeverFound;
use insd_nav::filter::judged::ImuState;
use insd_nav::judge::{Aid, Docket};

use crate::ship::Ship;
use crate::trial::Misled;
use crate::{Engine, Stage};

/// Alignments that are begun anew because GNSS refutes what they found.
const RETRIES: u8 = 3;
/// An IMU that the judge found to be of no use is not believed again before this, s.
const SENTENCE: f64 = 1800.0;
/// One that told so often what no installation is, is not believed again.
const HOPELESS: u8 = 4;
/// What was found of the lever arm is taken to be so many times as unsure for the next alignment, and by
/// no less than this, m.
const UNSURE: f64 = 2.0;
const LEAST: f64 = 0.5;
/// Once something of the antenna was found wrong its delay is no surer than this, s.
const DELAY: f64 = 0.1;

fn lever_found(estimates: &Estimates) -> LeverFound {
    let std = (UNSURE * estimates.gnss_lever_sigma.0.max()).max(LEAST);
    LeverFound { arm: estimates.gnss_lever.0, std }
}

impl Engine {
    /// An alignment that GNSS refutes is begun anew, with what was found since. Where all are refuted it is
    /// the IMU that is wrong, until one is not.
    pub(crate) fn consider_another(&mut self) {
        let Stage::Running(line) = &self.stage else { return };
        let time = line.now();
        match line.estimator().imu_state() {
            ImuState::Believed => {}
            ImuState::Disturbed => {
                self.surveyor.doubt_headings();
                return self.start_over(time, ModeReason::HeadingRefuted);
            }
            ImuState::Wrong => return self.condemn_imu(time),
        }
        let Some(misled) = line.estimator().refuted_by() else {
            if self.surveyor.is_refuted {
                let condemned = self.surveyor.condemned;
                let is_open = self.surveyor.impossible < HOPELESS;
                let is_over = condemned.is_none_or(|at| (time - at).as_seconds() > SENTENCE);
                let does_well = self.surveyor.impossible > 0 && line.estimator().does_well();
                let is_borne_out = does_well || line.estimator().is_acquitted();
                self.surveyor.is_refuted = !(is_open && is_over && is_borne_out);
            }
            return;
        };
        let knows_nothing = self.nav.gnss.lever_found == Some(LeverFound::UNKNOWN);
        match misled {
            Misled::Found(_) if self.retried >= RETRIES => return,
            Misled::Found(estimates) => self.learn_of(&estimates),
            Misled::Unknown if line.estimator().is_heading_unchecked() => {
                if self.docket().imu_doubted_since().is_some() {
                    return self.condemn_imu(time);
                }
                let fault = line.estimator().fault_of_heading();
                return self.start_over_with(self.nav.docket.without(fault, time), time);
            }
            Misled::Log(gain) => {
                return self.start_over_with(self.nav.docket.without_gain(gain, time), time);
            }
            Misled::Imu => {
                self.surveyor.is_refuted = true;
                self.surveyor.impossible = self.surveyor.impossible.saturating_add(1);
                self.nav.gnss.lever_found = None;
            }
            Misled::Unknown if knows_nothing || self.retried >= RETRIES => {
                self.surveyor.is_refuted = true;
                self.nav.gnss.lever_found = None;
            }
            Misled::Unknown => self.nav.gnss.lever_found = Some(LeverFound::UNKNOWN),
        }
        self.retried = self.retried.saturating_add(1);
        self.start_over(time, ModeReason::HeadingRefuted);
    }

    /// A heading is sought anew by who stands so.
    fn start_over_with(&mut self, docket: Docket, time: Time) {
        self.start_over(time, ModeReason::HeadingRefuted);
        self.nav = self.nav.with_docket(docket);
    }

    /// The IMU is of no use for a while.
    fn condemn_imu(&mut self, time: Time) {
        self.surveyor.doubt_headings();
        self.surveyor.is_refuted = true;
        self.surveyor.is_by_one = self.ship().is_some_and(Ship::is_imu_doubted_by_one);
        self.surveyor.condemned = Some(time);
        self.start_over(time, ModeReason::HeadingRefuted);
    }

    /// Takes what was found of the antenna for the next alignment. A delay goes first, as a lever arm that
    /// is found beside it may stand for it.
    fn learn_of(&mut self, estimates: &Estimates) {
        if !self.surveyor.note_delay(estimates) {
            self.nav.gnss.lever_found = Some(lever_found(estimates));
        }
        self.nav.gnss.delay_std = self.nav.gnss.delay_std.max(DELAY);
    }

    /// What is left of a message without what a sensor is known to tell wrongly.
    pub(crate) fn believed(&mut self, received: &Received, checked: &Received) -> Option<Received> {
        let (left, refused) = self.surveyor.believed(checked);
        if let Some((aid, why)) = refused {
            self.reject(received, aid, why);
        }
        left
    }

    /// Whoever stands still since a moment ago has lied meanwhile, and nobody else.
    pub(crate) fn heed_frozen(&mut self) {
        let Some(whom) = self.surveyor.newly_frozen() else { return };
        if let Stage::Running(line) = &mut self.stage {
            line.amend(|ship| ship.disbelieve(whom));
        }
    }

    /// A message without a velocity that the others refute: nobody is measured by it.
    pub(crate) fn unrefuted(&self, received: &Received) -> Received {
        let is_refuted = self.judge().is_some_and(|judge| judge.withholds(Aid::GnssVelocity));
        let message = match &received.message {
            Message::Gnss(fix) if is_refuted => {
                Message::Gnss(GnssFix { velocity: None, velocity_std: None, ..*fix })
            }
            other => other.clone(),
        };
        Received { message, ..*received }
    }

    pub(crate) fn tell_installation(&mut self, time: Time) {
        let ship = match &self.stage {
            Stage::Running(line) => Some(line.estimator()),
            Stage::Levelling(_) => None,
        };
        for finding in self.surveyor.look(ship, time) {
            // what GNSS has refuted may have been the doing of a log that is not mounted as configured
            if matches!(finding, Finding::LogMounting { .. }) && self.surveyor.condemned.is_none() {
                (self.surveyor.is_refuted, self.surveyor.impossible) = (false, 0);
            }
            self.tell(Event::InstallationFound { time, finding });
        }
        self.judge_imu(time);
    }

    /// A ship whose IMU cannot be believed is as one without: receivers and compass pass through.
    fn judge_imu(&mut self, time: Time) {
        let before = std::mem::replace(&mut self.shunned, self.surveyor.doubt());
        match (before, self.shunned) {
            (None, Some(_)) => {
                self.enter(time, Mode::Standby, self.facts(), Some(ModeReason::ImuDoubted));
            }
            (Some(Finding::MountingTurned { .. }), None) => {
                let ship = self.ship().map(|ship| ship.solution().mode);
                let to = ship.unwrap_or(Mode::CoarseAlignment);
                self.enter(time, to, self.facts(), Some(ModeReason::ImuBelieved));
            }
            (Some(_), None) => self.start_over(time, ModeReason::ImuBelieved),
            _ => {}
        }
    }

    /// What of the installation is found to be otherwise than configured, as it is known now.
    #[must_use]
    pub fn findings(&self) -> &[Finding] {
        self.surveyor.findings()
    }
}
