//! A second filter beside one that has ranges, which has none: the same ship by fixes and everybody else, before a judge.
//!
//! A receiver that is led astray has consistent ranges: nothing among its satellites contradicts them, and they are so many and so exact that no log
//! holds against them in one filter. What fixes are worth is judged by all who can tell (docs/integrity.md). So the filter without ranges sails along
//! and its judge sits for both. When he leaves somebody out, and the two filters are farther apart than both claim, the one with ranges has been misled and is given up for the other: a receiver that is
//! left out for reflections has satellites that are not, and a filter that goes by those stays with its companion. So it is where the companion has found that
//! the antenna is elsewhere than configured. While they are apart, or the judge doubts somebody,
//! what is claimed covers it.

use std::sync::Arc;

use insd_base::units::wrap_pi;
use insd_base::{Message, Party, Received, SolutionSigma};

use super::antennas_followed::Antennas;
use super::rtk_standing::RtkStanding;
use super::satellites::Satellites;
use super::{Filter, imu_position};
use crate::declaration::Carried;
use crate::error_state::POSITION;
use crate::report::Report;
use crate::solution_sigma::difference;
use crate::timeline::Estimator;

/// Filters that are apart by more than so many sigmas are not of one ship: where the receiver is left out, of whose satellites some may yet be honest, and
/// where somebody else is, who counts for little beside ranges.
const PARTED_BY_GNSS: f64 = 3.0;
const PARTED: f64 = 4.5;
/// Ranges that have gone on without a break for so long, s, have not leapt when a receiver is found to have.
const STEADY: f64 = 30.0;
/// Beyond so many what is claimed covers both.
const APART: f64 = 2.0;

impl Filter {
    /// Is accompanied from now on, as it is now.
    pub(super) fn be_accompanied(&mut self) {
        if self.companion.is_some() || self.state.is_moored() {
            return;
        }
        let mut companion = self.clone();
        companion.keep_nothing();
        companion.end_to_carry(Carried::WithRanges);
        companion.end_to_carry(Carried::WithAntennas);
        companion.forget_camera();
        companion.satellites = Satellites::default();
        companion.antennas = Antennas::default();
        companion.rtk = RtkStanding::default();
        if companion.court.judge.is_none() {
            companion.be_judged();
        }
        self.companion = Some(Arc::new(companion));
    }

    /// The filter that has no ranges.
    pub(super) fn companion_mut(&mut self) -> Option<&mut Filter> {
        self.companion.as_mut().map(Arc::make_mut)
    }

    /// Lets the companion hear what is neither range nor phase. Gives what he makes of it if he goes on alone.
    pub(super) fn accompany(&mut self, received: &Received) -> Option<Report> {
        let is_unheard = matches!(
            received.message,
            Message::Ranges(_) | Message::Rtk(_) | Message::Camera(_) | Message::Odometry(_)
        );
        let before = self.companion.as_deref().map(|own| own.docket().numbers_out());
        if let Message::Compass(reading) = &received.message {
            let told = reading.told.as_ref().ok()?;
            self.companion_mut()?.hear_antennas(told);
            let mut report = Report::default();
            if self.are_new_out(before) {
                self.go_on_without_ranges(&mut report);
                return Some(report);
            }
            return None;
        }
        if is_unheard {
            return None;
        }
        let mut report = self.companion_mut()?.apply(received);
        if self.are_new_out(before) {
            self.go_on_without_ranges(&mut report);
            return Some(report);
        }
        let companion = self.companion.as_deref()?;
        let sigmas = self.apart_from(companion);
        let has_found_antenna = companion.has_mended_antenna() && !self.has_mended_antenna();
        let somebody_lies = companion.judgement().excluded.iter().next().is_some();
        if companion.docket().has_leapt() && self.satellites.went_on(self.state.time, STEADY) {
            match self.is_borne_out_by(received) {
                // the next fix tells
                None => {
                    self.claim_both();
                    return None;
                }
                Some(true) => {
                    self.be_accompanied_anew();
                    return None;
                }
                Some(false) => {}
            }
        }
        let parted = if companion.docket().leaves_out_gnss() { PARTED_BY_GNSS } else { PARTED };
        if has_found_antenna || somebody_lies && sigmas > parted {
            self.go_on_without_ranges(&mut report);
            return Some(report);
        }
        self.claim_both();
        None
    }

    /// Whether antennas or a docking aid that this filter has followed are found to lie.
    fn are_new_out(&self, before: Option<u8>) -> bool {
        let now = self.companion.as_deref().map(|own| own.docket().numbers_out());
        now.zip(before).is_some_and(|(now, before)| now & !before != 0)
    }

    /// While the two are apart, or the judge is in doubt, what is claimed covers it.
    pub(super) fn claim_both(&mut self) {
        let Some(companion) = self.companion.as_deref() else { return };
        let (was_apart, docket) = (self.court.beside.is_some(), companion.docket());
        // who has no antennas finds his heading by himself, and by chance elsewhere more often than the two are apart in place
        let turned = if self.antennas.is_followed() { PARTED_BY_GNSS } else { APART };
        let is_apart = self.apart_from(companion) > APART
            || self.turned_from(companion) > turned
            // who sails on without the receiver knows less and less, which takes nothing back
            || was_apart && docket.leaves_out_gnss()
            // no reflection does that, and the ranges are of the same receiver
            || docket.has_gone_astray();
        let beside = is_apart.then(|| self.difference_to(companion));
        let is_new = is_apart && !was_apart;
        (self.court.covered, self.court.beside) = (companion.court.covered, beside);
        if is_new {
            self.protect();
        }
    }

    /// Whether a fix says that she is where ranges have her; `None` of what is no fix.
    fn is_borne_out_by(&self, received: &Received) -> Option<bool> {
        let Message::Gnss(fix) = &received.message else { return None };
        let position = fix.position.filter(|_| fix.rank == 0)?;
        let (view, own) = (self.view(), &self.state.nominal.position);
        let place = imu_position(&view, &position, &self.antenna_lever());
        let off = (view.c_ne * (place.0 - own)).xy();
        let std = self.config.floors.gnss_position(fix.position_std, fix.quality).value.xy();
        let level = view.c_ne.fixed_rows::<2>(0).into_owned();
        let variance = POSITION.covariance_in(&self.state.covariance, &level).trace();
        Some(off.norm_squared() < PARTED_BY_GNSS.powi(2) * (variance + std.norm_squared()))
    }

    /// A receiver that is found to have leapt is back where its ranges have been all the while, which went on without a break: its fixes had gone astray, and who
    /// lives by them.
    fn be_accompanied_anew(&mut self) {
        let mut docket = self.docket();
        docket.recall(Party::Gnss, self.state.time, |_| true);
        let before = self.companion.take();
        self.config = self.config.with_docket(docket);
        (self.court.covered, self.court.beside) = (None, None);
        self.be_accompanied();
        if let Some((companion, before)) = self.companion_mut().zip(before) {
            companion.doubt_with(&before);
        }
    }

    /// The companion goes on in its place; who was left out among the satellites is not any more.
    pub(super) fn go_on_without_ranges(&mut self, report: &mut Report) {
        if let Some(companion) = self.companion.take() {
            let now = self.state.time;
            report.satellites.extend(self.satellites.left_out().map(|own| (now, own, false)));
            let mut alone = Arc::unwrap_or_clone(companion);
            self.hand_past_to(&mut alone);
            *self = alone;
        }
    }

    /// How far apart the two are on the level, in what they claim together.
    fn apart_from(&self, companion: &Filter) -> f64 {
        let (view, other) = (self.view(), companion.view());
        let apart = (view.c_ne * (other.nominal.position - view.nominal.position)).xy();
        let level = view.c_ne.fixed_rows::<2>(0).into_owned();
        let variance = |own: &Filter| POSITION.covariance_in(&own.state.covariance, &level).trace();
        apart.norm() / (variance(self) + variance(companion)).sqrt()
    }

    /// The same of the headings.
    fn turned_from(&self, companion: &Filter) -> f64 {
        let apart = self.view().attitude().heading - companion.view().attitude().heading;
        wrap_pi(apart).abs() / self.own_heading_std().hypot(companion.own_heading_std())
    }

    fn difference_to(&self, companion: &Filter) -> SolutionSigma {
        difference(&self.view(), &self.state.nominal.error_to(&companion.state.nominal))
    }
}
