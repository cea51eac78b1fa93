//! A GNSS fix: velocity first, then position, each through its gates.

use insd_base::{FixQuality, GnssFix, Rejection, Source, earth};
use nalgebra::{Matrix3, Vector2, Vector3};

use super::entry::{Judged, NO_INNOVATION, POSITION_AID, VELOCITY_AID, enter};
use super::found_lever::FoundLever;
use super::{Filter, imu_position};
use crate::aids::View;
use crate::aids::gnss_position::{self, PositionFix};
use crate::aids::gnss_velocity::{self, VelocityFix};
use crate::antenna::AntennaMotion;
use crate::error_state::{
    ATTITUDE, Block, GNSS_LEVER, GNSS_POSITION_ERROR, GNSS_VELOCITY_ERROR, Innovation, POSITION,
    VELOCITY, Weighed,
};
use crate::filter::velocity_epoch::VelocityEpoch;
use crate::floors;
use crate::gate::dop_limit;
use crate::judge::{Aid, rows};
use crate::report::{Outcome, Report};
use crate::separate_bias::SeparateBias;
use crate::solution_sigma::axes_turn;
use crate::strapdown::earth_relative_rate;
use crate::trust::FAULT;

/// A log or reference used within this time vouches for the filter's velocity, s.
const VOUCHED: f64 = 5.0;
/// A receiver that is off on the mean is refused for at least this long, s.
const OFF_HOLD: f64 = 10.0;
/// Fixes that scatter by so much more than they say, as variances, have no carrier ambiguities fixed.
const DISHONEST: f64 = 25.0;
/// Velocity that the product of the errors of velocity and attitude makes, which no linear filter knows of, 1-sigma
/// of a filter that is lost, m/s.
const LOST: f64 = 1.0;
/// Noise of a height that is known to be wrong, 1-sigma, m.
const WORTHLESS: f64 = 1e5;
/// How stiff clocks and masts are taken to be, 1-sigma, m and m/s.
pub(super) const SLACK: f64 = 0.3;
const SLACK_VELOCITY: f64 = 0.05;
/// Attitude that a filter found to be lost is unsure of, 1-sigma, rad.
const LOST_ATTITUDE: f64 = 0.05;
/// A position that is known better than by this share of a receiver's slow errors came from somewhere else.
const OF_GNSS: f64 = 0.5;
/// So long a mistake of the installation that would explain a receiver is given to show, s.
const MISTAKEN: f64 = 15.0;
/// A receiver that was refused for so long, s, disputes where she is.
const DISPUTED: f64 = 2.0;
/// A receiver that was not used for so long, s, comes back.
const UNHEARD: f64 = 30.0;

impl Filter {
    /// Enters that a fix is not used, as the ranges that it is made of are.
    pub(super) fn pass_over(fix: &GnssFix, source: Source, report: &mut Report) {
        let outcome = Outcome::Rejected(Rejection::RangesInUse);
        let unheard = Judged { outcome, log_likelihood: 0.0, innovation: NO_INNOVATION };
        let told = [(VELOCITY_AID, fix.velocity.is_some()), (POSITION_AID, fix.position.is_some())];
        for (aid, _) in told.iter().filter(|(_, is_told)| *is_told) {
            enter(report, fix.time, source, aid, &unheard);
        }
    }

    pub(super) fn apply_gnss(&mut self, fix: &GnssFix, source: Source, report: &mut Report) {
        if !fix.quality.is_measured() {
            let outcome = Outcome::Rejected(Rejection::NoFix);
            let none = Judged { outcome, log_likelihood: 0.0, innovation: NO_INNOVATION };
            enter(report, fix.time, source, POSITION_AID, &none);
            return;
        }
        self.note_noise();
        self.take_up(source);
        self.note_antenna(fix);
        self.note_redating(fix.redated);
        self.note_quality(fix.quality);
        self.mend_installation();
        self.suspect_delay();
        if self.is_lost() {
            self.find(fix, report);
        } else if self.hears_a_liar_again() {
            self.untie_position();
        }
        self.watch_for_contradictions(fix);
        let velocity = self.apply_velocity(fix, source, report);
        self.apply_position(fix, velocity.as_ref(), source, report);
    }

    /// Another receiver has another antenna: what was learnt of the last one's lever arm is not its.
    pub(super) fn note_antenna(&mut self, fix: &GnssFix) {
        if fix.lever.is_some_and(|arm| self.config.hear_antenna(arm)) {
            let variance = self.config.gnss_lever_std().powi(2);
            GNSS_LEVER.renew(&mut self.state.covariance, &Matrix3::from_diagonal_element(variance));
            self.state.nominal.gnss_lever =
                self.config.gnss_lever() - self.config.lever_arms.gnss.0;
            self.receiver.antenna = AntennaMotion::default();
            self.receiver.found_lever = FoundLever::default();
            (self.state.nominal.gnss_delay, self.receiver.redated) = (0.0, None);
            self.receiver.lateness = 0.0;
            let begun = SeparateBias::new(&self.view());
            self.installation.bias = self.installation.bias.take().map(|_| begun);
            self.restart_judge();
        }
    }

    /// What a fix was set back by is no delay any more. It was taken for the receiver's, and may be that of the stamps of the IMU.
    fn note_redating(&mut self, redated: f64) {
        self.receiver.lateness = self.receiver.lateness.max(redated.abs());
        self.state.nominal.gnss_delay -=
            self.receiver.redated.map_or(0.0, |before| redated - before);
        self.receiver.redated = Some(redated);
    }

    /// The slow errors of code and carrier solutions have nothing to do with each other.
    fn note_quality(&mut self, quality: FixQuality) {
        let is_honest = self.noise_of(Aid::GnssPosition) < DISHONEST;
        let rtk = quality == FixQuality::RtkFixed && is_honest;
        if self.receiver.rtk.is_some_and(|before| before != rtk) {
            GNSS_POSITION_ERROR.renew(&mut self.state.covariance, &Matrix3::identity());
            GNSS_VELOCITY_ERROR.renew(&mut self.state.covariance, &Matrix3::identity());
            self.state.nominal.gnss_position_error = Vector3::zeros();
            self.state.nominal.gnss_velocity_error = Vector3::zeros();
            self.renew_judged();
        }
        self.receiver.rtk = Some(rtk);
    }

    /// Returns the velocity as it was offered to the filter, used or not.
    fn apply_velocity(
        &mut self,
        fix: &GnssFix,
        source: Source,
        report: &mut Report,
    ) -> Option<(VelocityFix, Innovation)> {
        let view = self.view();
        let measured = self.velocity_fix(&view, fix, report)?;
        let mut innovation = gnss_velocity::innovation(&view, &measured, &self.antenna_lever());
        innovation.r += self.bent_velocity(&view);
        self.consult(Aid::GnssVelocity, &innovation, rows::of_gnss_velocity);
        let weighed = innovation.weigh(&self.state.covariance);
        let fault = self.agreement(Aid::GnssVelocity, weighed.as_ref());
        if fault && self.can_judge() {
            self.receiver.trust.suspect(self.state.time, self.config.gate.suspect_time);
        }
        let suspect =
            self.is_receiver_refused(Aid::GnssVelocity).then_some(Rejection::SourceSuspect);
        let judged = self.gated_as(weighed.as_ref(), suspect);
        if enter(report, fix.time, source, VELOCITY_AID, &judged) == Outcome::Accepted {
            let before = self.receiver.velocity_epoch;
            self.receiver.velocity_epoch =
                Some(VelocityEpoch::after(before, self.state.time, &measured));
        }
        Some((measured, innovation))
    }

    fn velocity_fix(&self, view: &View, fix: &GnssFix, report: &mut Report) -> Option<VelocityFix> {
        let velocity = fix.velocity?;
        let std = self.config.floors.gnss_velocity(fix.velocity_std);
        if std.replaced {
            report.floored.push(VELOCITY_AID);
        }
        let share = self.config.gnss.velocity_slow_share;
        let noise = self.noise_of(Aid::GnssVelocity);
        let factor = self.receiver.trust.velocity.variance_factor().max(noise);
        // near a pole north at the antenna is not north at the IMU, and is known no better than the fix
        let c_ne = fix.position.map_or(view.c_ne, |antenna| earth::c_ne(&antenna));
        let place = self.config.floors.gnss_position(fix.position_std, fix.quality).value;
        let north_std = place.xy().max() * axes_turn(&view.geodetic).amax();
        let by_north = (velocity.0.xy().norm() * north_std).powi(2);
        Some(VelocityFix {
            velocity: view.c_ne * c_ne.transpose() * velocity.0,
            white: std.value.map(|s| (s * s * (1.0 - share) * factor + by_north).sqrt()),
            slow: floors::slow_part(&(std.value * noise.sqrt()), share),
            acceleration: view.c_ne * self.antenna_acceleration(),
        })
    }

    /// Lever arm from the IMU to the antenna as now known, body axes, m.
    pub(super) fn antenna_lever(&self) -> Vector3<f64> {
        self.config.lever_arms.gnss.0 + self.state.nominal.gnss_lever
    }

    /// Velocity of the antenna, ECEF axes, m/s.
    pub(super) fn antenna_velocity(&self) -> Vector3<f64> {
        let rate = earth_relative_rate(&self.state.nominal, &self.state.rate);
        let swing = rate.cross(&self.antenna_lever());
        self.state.nominal.velocity + self.state.nominal.attitude.transform_vector(&swing)
    }

    /// Its acceleration as it shows in a velocity that is told late, ECEF axes, m/s^2.
    pub(super) fn antenna_acceleration(&self) -> Vector3<f64> {
        let late = self.state.nominal.gnss_velocity_delay;
        self.receiver.antenna.acceleration(self.state.time, &self.antenna_velocity(), late)
    }

    fn apply_position(
        &mut self,
        fix: &GnssFix,
        velocity: Option<&(VelocityFix, Innovation)>,
        source: Source,
        report: &mut Report,
    ) {
        let view = self.view();
        let Some(measured) = self.position_fix(&view, fix, report) else { return };
        let mut innovation = gnss_position::innovation(&view, &measured, &self.antenna_lever());
        innovation.r += self.bent_position(&view);
        let innovation = self.without_wrong_height(innovation);
        self.consult(Aid::GnssPosition, &innovation, rows::of_gnss_position);
        self.watch_for_leaps(fix);
        // who is heard again is used from the next fix on: its velocity was not
        let is_out = self.withholds(Aid::GnssPosition);
        self.follow(&innovation, velocity.map(|(_, innovation)| innovation));
        self.note_origin(&view, &measured);
        let weighed = innovation.weigh(&self.state.covariance);
        self.agreement(Aid::GnssPosition, weighed.as_ref());
        let refused = if is_out || self.is_receiver_refused(Aid::GnssPosition) {
            Some(Rejection::SourceSuspect)
        } else {
            self.exceeds_dop_limit(fix, &innovation).then_some(Rejection::DopTest)
        };
        let judged = self.gated_as(weighed.as_ref(), refused);
        let outcome = enter(report, fix.time, source, POSITION_AID, &judged);
        self.note_dispute(outcome == Outcome::Accepted || is_out, &innovation);
        match outcome {
            Outcome::Accepted => self.receiver.trust.used(self.state.time),
            Outcome::Rejected(_) => {
                self.consider_reset(&measured, velocity.map(|(fix, _)| fix), report);
            }
        }
    }

    /// A filter that goes on to refuse a receiver which nobody has found to lie may be wrong itself.
    fn note_dispute(&mut self, is_settled: bool, innovation: &Innovation) {
        let lasts = !is_settled && self.receiver.trust.refused(self.state.time) >= DISPUTED;
        let apart = Vector2::new(innovation.z[0], innovation.z[1]);
        self.receiver.disputed = if lasts { apart } else { Vector2::zeros() };
    }

    /// Of a receiver with a wrong height that counts for nothing, but is watched.
    fn without_wrong_height(&mut self, mut innovation: Innovation) -> Innovation {
        let now = self.state.time;
        if self.court.judge.as_ref().is_none_or(|judge| !judge.docket().tells_wrong_height()) {
            return innovation;
        }
        let weighed = innovation.select(&[2]).weigh(&self.state.covariance);
        if let Some((weighed, judge)) = weighed.zip(self.judge_now()) {
            judge.watch_height(now, &weighed);
        }
        innovation.r[(2, 2)] = WORTHLESS * WORTHLESS;
        innovation
    }

    fn position_fix(&self, view: &View, fix: &GnssFix, report: &mut Report) -> Option<PositionFix> {
        let position = fix.position?;
        let std = self.config.floors.gnss_position(fix.position_std, fix.quality);
        if std.replaced {
            report.floored.push(POSITION_AID);
        }
        let share = self.config.gnss.position_slow_share_for(self.receiver.is_rtk());
        let noise = self.noise_of(Aid::GnssPosition);
        let factor = self.receiver.trust.position.variance_factor().max(noise);
        Some(PositionFix {
            position,
            white: std.value * ((1.0 - share) * factor).sqrt(),
            slow: floors::slow_part(&(std.value * noise.sqrt()), share),
            velocity: view.c_ne * self.antenna_velocity(),
        })
    }

    /// A filter that has begun does not know where its position came from. One that is known far better than the slow
    /// errors of a receiver let it, as that of a ship at a surveyed berth, did not come by way of the antenna.
    fn note_origin(&mut self, view: &View, measured: &PositionFix) {
        let Some(bias) = self.installation.bias.as_mut().filter(|bias| !bias.knows_origin()) else {
            return;
        };
        let own = POSITION.covariance_in(&self.state.covariance, &view.c_ne);
        let least = (measured.slow * OF_GNSS).map(|std| std * std);
        let share = own.diagonal().zip_map(&least, |own, least| (own / least).clamp(0.0, 1.0));
        bias.came_from(view, &share);
    }

    /// Enters an innovation in the statistics of its quantity; tells whether it is a fault.
    fn agreement(&mut self, aid: Aid, weighed: Option<&Weighed>) -> bool {
        let Some(weighed) = weighed else { return true };
        if !self.is_in_court(aid) {
            let least = if aid == Aid::GnssVelocity { SLACK_VELOCITY } else { SLACK };
            self.installation.bias.iter_mut().for_each(|bias| bias.hear(weighed, least));
        }
        let mean_square = weighed.nis() / 3.0;
        let agreement = match aid {
            Aid::GnssVelocity => &mut self.receiver.trust.velocity,
            _ => &mut self.receiver.trust.position,
        };
        let off = weighed.z().component_div(&weighed.sigma());
        agreement.learn(&off.fixed_rows::<3>(0).into_owned(), mean_square);
        mean_square > FAULT
    }

    /// Whether the filter may find a receiver in fault rather than itself: its velocity is vouched
    /// for by another sensor, or its gyros are good.
    fn can_judge(&self) -> bool {
        let vouched =
            self.heard.relative.is_some_and(|last| (self.state.time - last).as_seconds() < VOUCHED);
        self.navigating && (vouched || !self.config.has_coarse_gyros())
    }

    fn is_receiver_refused(&mut self, aid: Aid) -> bool {
        if self.court.judge.is_some() || self.withholds(aid) {
            return self.withholds(aid);
        }
        self.can_judge() && self.receiver.trust.is_refused(self.state.time, OFF_HOLD)
    }

    fn exceeds_dop_limit(&self, fix: &GnssFix, innovation: &Innovation) -> bool {
        let p = POSITION.covariance(&self.state.covariance);
        let predicted = p.diagonal().max().max(0.0).sqrt();
        let hdop = fix.hdop.filter(|hdop| hdop.is_finite() && *hdop > 0.0).unwrap_or(1.0);
        let since = self.receiver.trust.since_used(self.state.time);
        let limit = dop_limit(&self.config.gate, self.receiver.is_rtk(), hdop, predicted, since);
        innovation.z[0].hypot(innovation.z[1]) > limit
    }

    /// When nothing of a receiver has been used for long, it is the filter that is lost: it must not
    /// be locked out by its own gate. A filter that can judge waits longer.
    fn consider_reset(
        &mut self,
        measured: &PositionFix,
        velocity: Option<&VelocityFix>,
        report: &mut Report,
    ) {
        if self.consider_rejoining() || self.withholds(Aid::GnssPosition) {
            return;
        }
        let gate = &self.config.gate;
        let patience = if self.can_judge() { gate.judged_reset_time } else { gate.reset_time };
        if !self.navigating {
            return;
        }
        let refused = self.receiver.trust.refused(self.state.time);
        let may_be_mistake =
            || self.installation.bias.as_ref().is_some_and(SeparateBias::is_suspicious);
        if refused < patience || (refused < MISTAKEN && may_be_mistake()) {
            return;
        }
        self.place_anew(measured, velocity, report);
    }

    /// Whether velocity and attitude are so vague that nothing is linear in their errors, and a receiver that nothing
    /// speaks against tells where she is.
    fn is_lost(&self) -> bool {
        let sigma =
            |block: Block<3>| block.covariance(&self.state.covariance).trace().max(0.0).sqrt();
        let left_out = sigma(VELOCITY) * sigma(ATTITUDE);
        self.navigating && left_out > LOST && !self.withholds(Aid::GnssPosition)
    }

    /// Whether a receiver that may still lie of where she is was not heard for long.
    fn hears_a_liar_again(&self) -> bool {
        let is_unproven = self.docket().unproven_std(self.state.time) > 0.0;
        is_unproven
            && self.receiver.trust.since_used(self.state.time) > UNHEARD
            && !self.withholds(Aid::GnssPosition)
    }

    /// What is left of a lie about the place must tell nothing of how fast she goes and where her bow points.
    fn untie_position(&mut self) {
        let own = POSITION.covariance(&self.state.covariance);
        self.renew_place(&own);
        self.restart_judge();
    }

    /// Takes position and velocity from a fix that tells both.
    fn find(&mut self, fix: &GnssFix, report: &mut Report) {
        let view = self.view();
        // what is floored is counted when the fix is applied
        let mut uncounted = Report::default();
        let velocity = self.velocity_fix(&view, fix, &mut uncounted);
        let position = self.position_fix(&view, fix, &mut uncounted);
        if let Some((position, velocity)) = position.zip(velocity) {
            self.place_anew(&position, Some(&velocity), report);
        }
    }

    fn place_anew(
        &mut self,
        measured: &PositionFix,
        velocity: Option<&VelocityFix>,
        report: &mut Report,
    ) {
        let lever = self.antenna_lever();
        let view = self.view();
        let place = imu_position(&view, &measured.position, &lever);
        self.follow_contradicted((place.0 - self.state.nominal.position).norm());
        let variance = floors::greatest_told(&(measured.white + measured.slow)).powi(2);
        self.renew_place(&Matrix3::from_diagonal_element(variance));
        self.state.covariance.break_trail();
        self.state.nominal.position = place.0;
        if let Some(velocity) = velocity {
            let swing = view.c_eb * view.rate.cross(&lever);
            let variance = floors::greatest_told(&(velocity.white + velocity.slow)).powi(2);
            VELOCITY.renew(&mut self.state.covariance, &Matrix3::from_diagonal_element(variance));
            self.state.nominal.velocity = view.c_ne.transpose() * velocity.velocity - swing;
        }
        ATTITUDE.inflate(&mut self.state.covariance, LOST_ATTITUDE * LOST_ATTITUDE);
        let acceleration = velocity.map(|fix| view.c_ne.transpose() * fix.acceleration);
        if let Some(bias) = &mut self.installation.bias {
            bias.excuse(&view);
            acceleration.iter().for_each(|acceleration| bias.start(&view, acceleration));
        }
        self.receiver.trust.clear();
        self.receiver.trust.used(self.state.time);
        self.forget_motion();
        self.restart_judge();
        report.position_reset = true;
    }
}
