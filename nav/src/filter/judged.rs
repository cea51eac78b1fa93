//! The filter before its judge: who is heard, and what follows.

use std::sync::Arc;

use insd_base::units::DEG;
use insd_base::{Fault, Judgement, Parties, Party, SolutionSigma, Time};
use nalgebra::{DMatrix, Matrix3, Vector3};

use super::Filter;
use super::ahead::heading_std;
use super::receivers::{horizontal_noise, position_std};
use crate::config::WORSE;
use crate::error_state::{
    ATTITUDE, GNSS_POSITION_ERROR, GNSS_VELOCITY_ERROR, GYRO_BIAS, Innovation,
};
use crate::judge::{Aid, Alternative, Docket, Judge};
use crate::propagation::{Passage, Stretch};
use crate::report::Report;
use crate::solution_sigma::{difference, solution_sigma};

/// A receiver that is refused for so long while nothing speaks against it is right, and the filter wrong, s.
const LOCKED_OUT: f64 = 3.0;
/// An IMU that goes on to be wrong for so long, s, is of no use.
const PATIENCE: f64 = 60.0;
/// A heading less sure than this is to be found anew, rad.
const LOST_HEADING: f64 = 5.0 * DEG;
/// Mistakes of the installation show within this, s.
const SETTLED: f64 = 300.0;
/// Who has spoken within this time speaks, s.
const SPEAKS: f64 = 3.0;

/// What is to be done about the IMU.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ImuState {
    /// Nothing.
    Believed,
    /// It was wrong and is not any more, and the heading is lost.
    Disturbed,
    /// It goes on to be wrong.
    Wrong,
}

impl Filter {
    /// Has a judge from now on, if the filter navigates and nothing holds the ship, or a companion who has one.
    pub(super) fn be_judged(&mut self) {
        if self.state.is_moored() {
            self.companion = None;
        }
        let is_free = self.navigating && !self.state.is_moored() && self.satellites.last.is_none();
        let docket = self.docket();
        self.config = self.config.with_docket(docket);
        let judge = is_free.then(|| Judge::new(&self.state.covariance, &self.config, docket));
        self.court.sit(judge, self.state.time);
    }

    /// The judge begins anew with the estimate as it is. Whom that refuses it has not heard yet.
    pub(super) fn restart_judge(&mut self) {
        self.court.forget_unheard();
        self.receiver.trust.count_anew();
        if let Some(judge) = &mut self.court.judge {
            Arc::make_mut(judge).restart(&self.state.covariance, &self.config);
        }
    }

    /// The receiver is followed from now on, which says that she is so far, m, from where she was thought to be.
    pub(super) fn follow_contradicted(&mut self, off: f64) {
        let now = self.state.time;
        if let Some(judge) = self.judge_now() {
            judge.follow_contradicted(off, now);
        }
        self.take_docket();
    }

    /// What the judge has on file is what the filter goes by.
    fn take_docket(&mut self) {
        if let Some(judge) = self.court.judge.as_ref() {
            self.config = self.config.with_docket(*judge.docket());
        }
    }

    /// Brings the judge up to the time of the estimate. It must be settled.
    pub(super) fn judge_now(&mut self) -> Option<&mut Judge> {
        let regime = self.regime();
        let judge = Arc::make_mut(self.court.judge.as_mut()?);
        if self.court.unjudged.duration > 0.0 {
            judge.propagate(&Passage {
                stretch: &self.court.unjudged,
                gradient: self.state.gravity.gradient(),
                config: &self.config,
                regime,
            });
            self.court.unjudged = Stretch::new();
        }
        judge.corrected(&std::mem::take(&mut self.court.owed));
        Some(judge)
    }

    /// The slow errors of the receiver have been forgotten.
    pub(super) fn renew_judged(&mut self) {
        if let Some(judge) = self.judge_now() {
            for block in [GNSS_POSITION_ERROR, GNSS_VELOCITY_ERROR] {
                judge.renew(block, &Matrix3::identity());
            }
        }
    }

    /// Lets the judge hear an innovation before it is absorbed: of somebody who is left out, whether he agrees. What is
    /// said inside a gap of the IMU is no evidence.
    pub(super) fn consult(
        &mut self,
        aid: Aid,
        innovation: &Innovation,
        direct: impl Fn(f64) -> DMatrix<f64>,
    ) {
        let now = self.state.time;
        if self.state.is_in_gap()
            || self.court.judge.as_ref().is_none_or(|judge| !judge.is_due(aid, now))
        {
            return;
        }
        let attitude = self.state.nominal.attitude;
        let is_left_out = self.docket().leaves_out(aid);
        let weighed = is_left_out.then(|| innovation.weigh(&self.state.covariance)).flatten();
        let Some(judge) = self.judge_now() else { return };
        match aid.party().filter(|_| is_left_out) {
            Some(Party::Gnss) if judge.docket().leaves_out_gnss() => judge.note_word(aid, now),
            Some(party) => {
                if let Some(weighed) = &weighed {
                    judge.watch((party, aid), now, (innovation, weighed), &direct(0.0));
                }
            }
            None => judge.hear(aid, now, innovation, &attitude, direct),
        }
    }

    /// Lets the judge follow what a receiver that is left out is off by: its position beside the velocity of the
    /// same epoch.
    pub(super) fn follow(&mut self, position: &Innovation, velocity: Option<&Innovation>) {
        if !self.docket().leaves_out_gnss() {
            return;
        }
        let (now, covariance) = (self.state.time, self.state.covariance.clone());
        let both = position.beside(velocity.unwrap_or(&Innovation::silent(3)));
        let noise = [horizontal_noise(position), position_std(&covariance)];
        let Some(weighed) = both.weigh(&covariance) else { return };
        match self.judge_now() {
            Some(judge) => judge.follow((Party::Gnss, now), &weighed, noise),
            None => {
                let mut docket = self.config.docket;
                docket.see_receiver((Party::Gnss, now), &weighed, noise, false);
                self.config = self.config.with_docket(docket);
                self.court.covered = self.cover();
            }
        }
    }

    /// Whether what a receiver says now may be somebody's lie, and not the installer's mistake, which is there from
    /// the begin.
    pub(super) fn is_in_court(&self, aid: Aid) -> bool {
        let Some(judge) = &self.court.judge else { return self.withholds(aid) };
        let is_suspect = judge.is_in_doubt() || judge.withholds(aid);
        let is_no_mistake = judge.leaps(Party::Gnss) || judge.docket().leaves_out(aid);
        let may_be_mistake = self.is_early() || !self.is_lever_confirmed();
        is_suspect && (is_no_mistake || !may_be_mistake)
    }

    /// By how much the variance of an aid's noise is larger than stated.
    pub(super) fn noise_of(&self, aid: Aid) -> f64 {
        self.court.judge.as_ref().map_or(1.0, |judge| judge.noise(aid))
    }

    /// Whether what somebody says with an aid is not to be used now.
    pub(super) fn withholds(&self, aid: Aid) -> bool {
        if let Some(companion) = &self.companion {
            return companion.withholds(aid);
        }
        let Some(judge) = &self.court.judge else {
            let leapt = aid == Aid::GnssPosition && self.court.leap.is_suspected();
            return leapt || self.config.docket.leaves_out(aid);
        };
        judge.withholds(aid)
    }

    /// The heading was found with a reference that nothing bears out yet, or is borne out now.
    pub fn doubt_heading(&mut self, is_doubted: bool) {
        if let Some(companion) = self.companion_mut() {
            companion.doubt_heading(is_doubted);
        }
        self.court.heading_doubted = is_doubted;
    }

    /// The IMU is of no use.
    pub fn condemn_imu(&mut self) {
        if let Some(companion) = self.companion_mut() {
            companion.condemn_imu();
        }
        let now = self.state.time;
        if let Some(judge) = &mut self.court.judge {
            Arc::make_mut(judge).condemn_imu(now);
        }
    }

    fn excused(&self) -> Parties {
        if self.court.heading_doubted {
            Party::ALL.into_iter().collect()
        } else if self.is_early() {
            Parties::default().with(Party::Gnss).with(Party::Imu)
        } else {
            Parties::default()
        }
    }

    /// Whether it goes on by the IMU alone, against a receiver and a log that both speak: before mistakes of the installation have shown
    /// nobody is named for that, but the heading is one.
    #[must_use]
    pub fn is_forsaken(&self) -> bool {
        let now = self.state.time;
        let speaks = |judge: &Judge| {
            [Aid::GnssPosition, Aid::Log].iter().all(|aid| judge.has_spoken(*aid, now, SPEAKS))
        };
        self.is_early()
            && self.is_carried_by_imu()
            && self.court.judge.as_deref().is_some_and(speaks)
    }

    pub(super) fn is_early(&self) -> bool {
        (self.state.time - self.court.since).as_seconds() < SETTLED
    }

    /// How many times as large in-run biases and scale factors of the IMU are taken to be as its data sheet says.
    #[must_use]
    pub fn imu_is_worse_by(&self) -> f64 {
        WORSE.powi(self.docket().worse().into())
    }

    /// 1-sigma of the heading by the covariance alone, whatever else is claimed, rad.
    pub(super) fn own_heading_std(&self) -> f64 {
        heading_std(&self.view(), &self.state.covariance)
    }

    /// What is to be done about an IMU that was found wrong.
    #[must_use]
    pub fn imu_state(&self) -> ImuState {
        if let Some(companion) = &self.companion {
            return companion.imu_state();
        }
        let Some(judge) = &self.court.judge else { return ImuState::Believed };
        let docket = judge.docket();
        // what two say that lie alike is no reason to find a heading anew
        let is_vague = judge.finds_a_lie_likely() && !docket.may_be_two(self.state.time);
        let std = || if is_vague { self.heading_std() } else { self.own_heading_std() };
        let is_heading_lost = || self.is_settled() && std() > LOST_HEADING;
        let is_doubted = docket.imu_doubted_since().is_some_and(|at| at >= self.court.since);
        if docket.is_imu_condemned() || docket.wrong_imu_for() > PATIENCE {
            ImuState::Wrong
        } else if is_doubted && !docket.is_restless() && is_heading_lost() {
            ImuState::Disturbed
        } else {
            ImuState::Believed
        }
    }

    /// Does as the judge says, after a message.
    pub(super) fn heed(&mut self) {
        let now = self.state.time;
        let excused = self.excused();
        if self.court.judge.as_ref().is_none_or(|judge| !judge.is_look_due(now)) {
            return;
        }
        let mistake = self.doubt_installation();
        let Some(judge) = self.judge_now() else { return };
        if let Some(verdict) = judge.look(now, excused, mistake) {
            if let Some(mended) = &verdict.mended {
                self.become_other(mended);
                if verdict.fault == Fault::HeadingDrift {
                    self.doubt_gyros(mended);
                }
            }
            self.take_docket();
            self.restart_judge();
        }
        self.court.covered = self.cover();
        self.protect();
    }

    /// A compass that drifts and coarse gyros that do are alike, and what was known of their biases came from it: it is known no better than
    /// at first from now on, and the heading than what was made of the compass.
    fn doubt_gyros(&mut self, mended: &Alternative) {
        if self.config.has_coarse_gyros() {
            let turned = mended.error.of(ATTITUDE);
            ATTITUDE.add(&mut self.state.covariance, &(turned * turned.transpose()));
            GYRO_BIAS.inflate(&mut self.state.covariance, self.config.imu.gyro.bias_std.powi(2));
        }
    }

    /// Somebody is seen to lie by what he says alone: the estimate becomes that of who has not believed him.
    pub fn disbelieve(&mut self, whom: Party) {
        self.go_on_without_ranges(&mut Report::default());
        let now = self.state.time;
        self.settle();
        if let Some(verdict) = self.judge_now().and_then(|judge| judge.disbelieve(whom, now)) {
            verdict.mended.iter().for_each(|mended| self.become_other(mended));
            self.restart_judge();
        }
    }

    pub(super) fn disbelieve_imu(&mut self) {
        let now = self.state.time;
        self.settle();
        let verdict = self.judge_now().map(|judge| judge.disbelieve_imu(now));
        if let Some(mended) = verdict.and_then(|verdict| verdict.mended) {
            self.become_other(&mended);
            self.restart_judge();
        }
        self.forget_motion();
    }

    /// A filter that refuses a receiver against whom nothing speaks is wrong itself. Tells whether it has a judge at all.
    pub(super) fn consider_rejoining(&mut self) -> bool {
        let refused = self.receiver.trust.refused(self.state.time);
        let withheld = self.withholds(Aid::GnssPosition);
        let is_early = self.is_early();
        let Some(judge) = self.judge_now() else { return false };
        if is_early && judge.is_in_doubt() && !judge.leaps(Party::Gnss) {
            return false;
        }
        let unbiased = judge.unbiased().filter(|_| refused >= LOCKED_OUT && !withheld);
        if let Some(unbiased) = unbiased {
            self.become_other(&unbiased);
            self.court.owed += &unbiased.error;
        }
        true
    }

    fn become_other(&mut self, other: &Alternative) {
        let Alternative { error, covariance } = other;
        self.state.become_other(error, covariance);
        self.part_with_past();
        self.forget_motion();
        self.excuse_installation();
        self.receiver.trust.clear();
    }

    /// Sigmas that cover all that the estimate may be instead.
    pub(super) fn cover(&self) -> Option<SolutionSigma> {
        let ((view, acceleration), dating) = (self.dated_view(), self.dating());
        let of = |other: &Alternative| {
            let apart = difference(&view, &other.error);
            let own = solution_sigma(&view, &acceleration, &dating, &other.covariance);
            apart.scaled(0.5).plus(&own)
        };
        let judge = self.court.judge.as_deref();
        let claims = judge.map(Judge::claims).unwrap_or_default();
        // the second moment of a mixture: how far each would be off, as often as it may be so
        let share = |(chance, other): &(f64, Alternative)| {
            difference(&view, &other.error).scaled(chance.sqrt())
        };
        let chances = judge.map(Judge::chances).unwrap_or_default();
        let doubt = self.installation.doubt.map(|(_, off)| off);
        let hedge = chances.iter().map(share).chain(doubt).reduce(|a, b| a.hypot(&b));
        let mut all = claims.iter().map(of).chain(hedge).reduce(|a, b| a.greatest(&b));
        let unproven = self.docket().unproven_std(self.state.time);
        if unproven > 0.0 {
            let mut floor = all.unwrap_or_default();
            floor.position.0.x = floor.position.0.x.max(unproven);
            floor.position.0.y = floor.position.0.y.max(unproven);
            all = Some(floor);
        }
        all
    }

    /// How much likelier what was said since an instant is if the gyros have told so much too much since then, rad/s,
    /// body axes, as a logarithm; `None` without a judge.
    pub fn odds_of_gyros(&mut self, since: Time, excess: &Vector3<f64>) -> Option<f64> {
        if let Some(companion) = self.companion_mut() {
            return companion.odds_of_gyros(since, excess);
        }
        let now = self.state.time;
        Some(self.judge_now()?.odds_of_gyros(now, since, excess))
    }

    /// What is made of all that is said.
    pub(super) fn judgement(&self) -> Judgement {
        if let Some(companion) = &self.companion {
            return companion.judgement();
        }
        let alone = || self.config.docket.judgement();
        self.court.judge.as_ref().map_or_else(alone, |judge| judge.judgement())
    }

    /// How far everybody is believed.
    #[must_use]
    pub fn docket(&self) -> Docket {
        if let Some(companion) = &self.companion {
            return companion.docket();
        }
        self.court.judge.as_ref().map_or(self.config.docket, |judge| *judge.docket())
    }

    /// The judge, if there is one.
    #[must_use]
    pub fn judge(&self) -> Option<&Judge> {
        let companion = self.companion.as_deref();
        companion.map_or(self.court.judge.as_deref(), Filter::judge)
    }
}
