//! Constants of the installation that are otherwise than configured: what the filter makes of them.

use nalgebra::Vector3;

use super::Filter;
use crate::config::is_on_board;
use crate::dating::Dating;
use crate::error_state::{
    ATTITUDE, BERTH_OFFSET, Errors, GNSS_LEVER, GNSS_VELOCITY_DELAY, POSITION,
};
use crate::separate_bias::{ConstantsFinding, DELAY, SeparateBias};
use crate::solution_sigma::difference;

/// A correction of the attitude, rad, that is more than linear: whoever found it found it by a wrong lever arm.
const FAR: f64 = 0.03;

/// Velocities that are older than their positions by more, s, and by so many sigmas, are not only smoothed: then the
/// positions are taken to be late by up to so many times as much, 1-sigma.
const SMOOTHED: f64 = 0.05;
/// So are velocities that are younger than theirs by more than stamps of an IMU come late, s.
const EARLY: f64 = -0.1;
const SIGNIFICANT: f64 = 3.0;
const AS_LATE: f64 = 2.0;
/// It is supposed anew when it has grown by this factor.
const GROWN: f64 = 1.5;
/// No log sits higher above an IMU, m, which sits at the keel at best; by so many sigmas.
const HIGHEST_LOG: f64 = -15.0;
const SURELY: f64 = 3.0;
/// So many installations have a constant wrong by metres.
const MISTAKEN: f64 = 0.01;
/// What is less likely than this is of no account.
const CHANCE: f64 = 1e-3;
/// What is likelier than this is a doubt until the configuration is confirmed, or mended: what a sensor that lies meanwhile makes of it is no answer.
const LIKELY: f64 = 0.5;

impl Filter {
    /// Mean square of the latest innovations of GNSS, of which one is expected, each counted as a fault at
    /// most; `None` before enough of them are known.
    #[must_use]
    pub fn strain(&self) -> Option<f64> {
        self.installation.bias.as_ref().and_then(SeparateBias::strain)
    }

    /// The same from the first innovation on, however few there are; zero before.
    #[must_use]
    pub fn early_strain(&self) -> f64 {
        self.installation.bias.as_ref().map_or(0.0, SeparateBias::early_strain)
    }

    /// Whether lever arm or delay of GNSS were found to be otherwise than the filter began with, by so much that its
    /// heading was wrong.
    #[must_use]
    pub fn has_mended_antenna(&self) -> bool {
        self.installation.is_mended
    }

    /// Whether the motion of the ship has confirmed the configured lever arm of the antenna.
    #[must_use]
    pub fn is_lever_confirmed(&self) -> bool {
        self.installation.bias.as_ref().is_some_and(SeparateBias::is_confirmed)
    }

    /// Whether the installation was found to be as none can be: the IMU tells it wrongly, as a mirrored one does.
    #[must_use]
    pub fn finds_the_impossible(&self) -> bool {
        self.installation.is_impossible
    }

    /// Whether the antenna is found where no ship is, however unsure that is.
    #[must_use]
    pub fn puts_antenna_off_board(&self) -> bool {
        let arm = self.antenna_lever();
        if is_on_board(&arm) {
            return false;
        }
        let variance = GNSS_LEVER.covariance(&self.state.covariance).diagonal();
        let unsure = variance.map(|variance| SURELY * variance.max(0.0).sqrt());
        !is_on_board(&arm.zip_map(&unsure, |m, by| m.signum() * (m.abs() - by).max(0.0)))
    }

    /// What a delay between receiver and IMU is put down to.
    pub(super) fn dating(&self) -> Dating {
        let (all, imu) = (self.config.gnss.delay_std, self.config.gnss.stamps_std);
        let receiver = (all * all - imu * imu).max(0.0).sqrt();
        Dating::new(imu, receiver.hypot(self.receiver.lateness))
    }

    /// Waves tell soon how old velocities are, but not whether the positions are as old, as whoever dates fixes by when
    /// they are sent makes them: only turns and changes of speed do. Until then the claims allow for it.
    pub(super) fn suspect_delay(&mut self) {
        let lag = self.state.nominal.gnss_velocity_delay;
        let sigma = GNSS_VELOCITY_DELAY.std(&self.state.covariance);
        let is_off = !(EARLY..=SMOOTHED).contains(&lag) && lag.abs() > SIGNIFICANT * sigma;
        let supposed = AS_LATE * lag.abs();
        let is_new = is_off && supposed > GROWN * self.receiver.lateness;
        if let Some(bias) = self.installation.bias.as_ref().filter(|_| is_new) {
            self.receiver.lateness = supposed;
            bias.suppose_delay(supposed, &mut self.state.covariance);
            self.restart_judge();
        }
    }

    /// Whether somebody's lie explains nearly as much as the installation does, or more: a few seconds later it will not.
    fn may_be_a_lie(&self, bias: &SeparateBias) -> bool {
        let Some(judge) = self.court.judge.as_ref().filter(|_| !self.is_early()) else {
            return false;
        };
        judge.doubts(bias.odds())
    }

    /// Whether a log would sit where no ship has one: rolling against her swing, which no scale or direction of its own makes.
    fn puts_log_off_board(&self, finding: &ConstantsFinding) -> bool {
        let Some((off, sigma)) = finding.log_lever() else { return false };
        self.config.lever_arms.log.0.z + off.z + SURELY * sigma.z < HIGHEST_LOG
    }

    /// What a constant that is likely to be wrong, and not surely enough to be mended, would make of the solution: claims are to cover it. Returns how much
    /// likelier that is than the configuration, as a logarithm; zero if it is not.
    pub(super) fn doubt_installation(&mut self) -> f64 {
        let likeliest = self.installation.bias.as_ref().and_then(SeparateBias::likeliest);
        let Some((score, error)) = likeliest else {
            self.installation.doubt = None;
            return 0.0;
        };
        let odds = MISTAKEN * score.exp();
        let chance = odds / (1.0 + odds);
        let stands = |(known, _): &(f64, _)| *known > chance.max(LIKELY);
        if !self.installation.doubt.as_ref().is_some_and(stands) {
            let off = difference(&self.dated_view().0, &error).scaled(chance.sqrt());
            self.installation.doubt = (chance > CHANCE).then_some((chance, off));
        }
        score.max(0.0)
    }

    /// What was heard of late is somebody else's fault. Who was in doubt about the installation before has to be told anew that it is as configured.
    pub(super) fn excuse_installation(&mut self) {
        let view = self.view();
        let is_doubted = self.is_installation_doubted();
        if let Some(bias) = &mut self.installation.bias {
            if is_doubted {
                *bias = SeparateBias::new(&view);
            } else {
                bias.excuse(&view);
            }
        }
    }

    /// Takes over what another filter of the same ship doubts of the installation.
    pub(super) fn doubt_with(&mut self, other: &Filter) {
        if other.is_installation_doubted() {
            self.installation.doubt = other.installation.doubt;
            self.excuse_installation();
        }
    }

    /// Whether it is likelier that a constant is wrong than that it is not.
    fn is_installation_doubted(&self) -> bool {
        self.installation.doubt.is_some_and(|(chance, _)| chance > LIKELY)
    }

    /// Where the innovations show that the antenna sits elsewhere than configured, or that its epochs come
    /// later: takes the estimate to be what it would have been with that.
    pub(super) fn mend_installation(&mut self) {
        let Some(finding) = self.installation.bias.as_ref().and_then(SeparateBias::finding) else {
            return;
        };
        let Some(bias) = self.installation.bias.clone() else { return };
        let arm = self.antenna_lever() + finding.gnss_lever();
        if !is_on_board(&arm) || self.may_be_a_lie(&bias) {
            return;
        }
        if !self.receiver.found_lever.note(self.state.time, &arm, &finding) {
            return;
        }
        self.installation.is_impossible |= self.puts_log_off_board(&finding);
        let error = bias.correct(&finding, &mut self.state.covariance);
        let is_far = error.of(ATTITUDE).norm() > FAR;
        if finding.is_of_delay() {
            self.receiver.lateness = self.receiver.lateness.max(DELAY);
        }
        self.installation.is_mended |= finding.is_of_antenna() && is_far;
        self.state.correct(&error);
        if let Some((off, sigma)) = finding.log_lever() {
            self.config.lever_arms.log.0 += off;
            self.installation.log_lever_std = Some(sigma);
        }
        self.suspect_berth(&(finding.gnss_lever() * bias.surveyed()));
        self.installation.bias = Some(SeparateBias::new(&self.view()));
        self.installation.doubt = None;
        self.receiver.trust.clear();
        self.restart_judge();
    }

    /// A receiver and a berth that are apart tell as much of a lever arm that was measured wrongly as of a berth that is not
    /// where it is said to be, until she turns: she may be off by that, her berth with her, and the antenna back where it was
    /// said to be.
    fn suspect_berth(&mut self, off: &Vector3<f64>) {
        if !self.state.is_moored() {
            return;
        }
        let view = self.view();
        let off = (view.c_nb() * off).xy().insert_row(2, 0.0);
        let mut apart = Errors::none();
        apart.set(POSITION, &(view.c_ne.transpose() * off));
        apart.set(BERTH_OFFSET, &off.xy());
        apart.set(GNSS_LEVER, &-(view.c_nb().transpose() * off));
        self.state.covariance.spread(&apart);
    }
}
