//! A GNSS fix: velocity first, then position, each through its gates.

use insd_base::{FixQuality, GnssFix, Rejection, Source};
use nalgebra::{Matrix3, Vector3};

use super::{Filter, Judged, NO_INNOVATION, enter, imu_position};
use crate::aids::gnss_position::{self, PositionFix};
use crate::aids::gnss_velocity::{self, VelocityFix};
use crate::error_state::{GNSS_POSITION_ERROR, GNSS_VELOCITY_ERROR, POSITION};
use crate::floors;
use crate::gate::dop_limit;
use crate::innovation::Innovation;
use crate::report::{Outcome, Report};

const POSITION_AID: &str = "gnss_position";
const VELOCITY_AID: &str = "gnss_velocity";

impl Filter {
    pub(super) fn apply_gnss(&mut self, fix: &GnssFix, source: Source, report: &mut Report) {
        if !fix.quality.is_measured() {
            let outcome = Outcome::Rejected(Rejection::NoFix);
            let none = Judged { outcome, log_likelihood: 0.0, innovation: NO_INNOVATION };
            enter(report, fix.time, source, POSITION_AID, &none);
            return;
        }
        self.note_quality(fix.quality);
        let velocity = self.apply_velocity(fix, source, report);
        self.apply_position(fix, source, velocity, report);
    }

    /// The slow errors of code and carrier solutions have nothing to do with each other.
    fn note_quality(&mut self, quality: FixQuality) {
        let rtk = quality == FixQuality::RtkFixed;
        if self.rtk.is_some_and(|before| before != rtk) {
            GNSS_POSITION_ERROR.renew(&mut self.covariance, &Matrix3::identity());
            GNSS_VELOCITY_ERROR.renew(&mut self.covariance, &Matrix3::identity());
            self.nominal.gnss_position_error = Vector3::zeros();
            self.nominal.gnss_velocity_error = Vector3::zeros();
        }
        self.rtk = Some(rtk);
    }

    fn apply_velocity(
        &mut self,
        fix: &GnssFix,
        source: Source,
        report: &mut Report,
    ) -> Option<Outcome> {
        let velocity = fix.velocity?;
        let std = floors::vector(fix.velocity_std, &floors::gnss_velocity());
        if std.replaced {
            report.floored.push(VELOCITY_AID);
        }
        let share = self.config.gnss.velocity_slow_share;
        let measured = VelocityFix {
            velocity: velocity.0,
            white: std.value * (1.0 - share).sqrt(),
            slow: std.value * share.sqrt(),
        };
        let lever = self.config.lever_arms.gnss.0;
        let innovation = gnss_velocity::innovation(&self.view(), &measured, &lever);
        if let Some(whitened) = self.componentwise(&innovation) {
            self.trust.learn_velocity(&whitened);
        }
        let suspect = self.trust.is_suspect(self.time).then_some(Rejection::SourceSuspect);
        let judged = self.judge(&innovation, suspect);
        let outcome = enter(report, fix.time, source, VELOCITY_AID, &judged);
        if outcome == Outcome::Rejected(Rejection::ChiSquare) {
            self.trust.suspect(self.time, self.config.gate.suspect_time);
        }
        Some(outcome)
    }

    fn apply_position(
        &mut self,
        fix: &GnssFix,
        source: Source,
        velocity: Option<Outcome>,
        report: &mut Report,
    ) {
        let Some(position) = fix.position else { return };
        let std = floors::vector(fix.position_std, &floors::gnss_position(fix.quality));
        if std.replaced {
            report.floored.push(POSITION_AID);
        }
        let gnss = &self.config.gnss;
        let rtk = self.rtk == Some(true);
        let share = if rtk { gnss.rtk_slow_share } else { gnss.position_slow_share };
        let measured = PositionFix {
            position,
            white: std.value * (1.0 - share).sqrt(),
            slow: std.value * share.sqrt(),
        };
        let lever = self.config.lever_arms.gnss.0;
        let innovation = gnss_position::innovation(&self.view(), &measured, &lever);
        if let Some(whitened) = self.componentwise(&innovation) {
            self.trust.learn_position(&whitened);
        }
        let refused = if self.trust.is_suspect(self.time) {
            Some(Rejection::SourceSuspect)
        } else {
            self.exceeds_dop_limit(fix, &innovation).then_some(Rejection::DopTest)
        };
        let judged = self.judge(&innovation, refused);
        match enter(report, fix.time, source, POSITION_AID, &judged) {
            Outcome::Accepted => self.trust.used(self.time),
            Outcome::Rejected(_) => self.consider_reset(&measured, velocity, report),
        }
    }

    /// Innovation in units of the sigma expected of each component.
    fn componentwise(&self, innovation: &Innovation<3>) -> Option<Vector3<f64>> {
        let weighed = innovation.weigh(&self.covariance)?;
        Some(innovation.z.component_div(&weighed.sigma()))
    }

    fn exceeds_dop_limit(&self, fix: &GnssFix, innovation: &Innovation<3>) -> bool {
        let p = POSITION.covariance(&self.covariance);
        let predicted = p.diagonal().max().max(0.0).sqrt();
        let hdop = fix.hdop.filter(|hdop| hdop.is_finite() && *hdop > 0.0).unwrap_or(1.0);
        let since = self.trust.since_used(self.time);
        let limit = dop_limit(&self.config.gate, self.rtk == Some(true), hdop, predicted, since);
        innovation.z.xy().norm() > limit
    }

    /// Positions that stay refused while the velocities of the same receiver agree mean that it is
    /// the filter that is lost: it must not be locked out by its own gate.
    fn consider_reset(
        &mut self,
        measured: &PositionFix,
        velocity: Option<Outcome>,
        report: &mut Report,
    ) {
        if velocity == Some(Outcome::Rejected(Rejection::ChiSquare)) {
            return;
        }
        if self.trust.refused(self.time) < self.config.gate.reset_time {
            return;
        }
        let lever = self.config.lever_arms.gnss.0;
        let place = imu_position(&self.view(), &measured.position, &lever);
        let variance = (measured.white + measured.slow).map(|s| s * s).max();
        POSITION.renew(&mut self.covariance, &Matrix3::from_diagonal_element(variance));
        self.nominal.position = place.0;
        self.trust.clear();
        self.trust.used(self.time);
        report.position_reset = true;
    }
}
