//! Several receivers: one is used, the others are compared with what is made of it.
//!
//! The errors of two receivers under the same sky have much in common. Used as if they had not, both together would make
//! the claims too small; so nothing is taken from the one that is compared. The judge hears its position, as noisy as its slow
//! errors and those of the navigator make it: n positions within the time of these are worth one.

use insd_base::{GnssFix, Party, Source, earth};
use nalgebra::{DMatrix, Matrix1, Matrix3, Vector3};

use super::Filter;
use crate::aids::View;
use crate::aids::gnss_position::{self, PositionFix};
use crate::aids::gnss_velocity::{self, VelocityFix};
use crate::error_state::{
    Covariance, GNSS_DELAY, GNSS_POSITION_ERROR, GNSS_VELOCITY_ERROR, Innovation, POSITION,
};
use crate::judge::{Aid, Judge, rows};
use crate::separate_bias::SeparateBias;

/// North and east of three components.
const HORIZONTAL: [usize; 2] = [0, 1];

/// What honest receivers differ by for long, 1-sigma of each component, beside what the one that is compared says of
/// itself, and for how long, s. Position, m: paths of the signal, datum, the slow errors of the other.
const APART: [f64; 2] = [2.0, 30.0];
/// Velocity, m/s: how each averages it over the waves.
const APART_VELOCITY: [f64; 2] = [0.1, 10.0];

/// 1-sigma of the noise of a position, of the worse of north and east, m.
pub(super) fn horizontal_noise(position: &Innovation) -> f64 {
    position.r[(0, 0)].max(position.r[(1, 1)]).sqrt()
}

/// 1-sigma of the worst component of the position, m.
pub(super) fn position_std(p: &Covariance) -> f64 {
    POSITION.covariance(p).diagonal().max().max(0.0).sqrt()
}

impl Filter {
    /// The receiver that sends the fixes to be used: what is known of the slow errors and the delay of the one before is
    /// not its. The position carries on.
    pub(super) fn take_up(&mut self, source: Source) {
        let (Source::Gnss(number), now) = (source, self.state.time) else { return };
        let docket = self.court.judge.as_deref().map_or(&self.config.docket, Judge::docket);
        if docket.receiver_in_use() == Party::receiver(number) {
            return;
        }
        match self.judge_now() {
            Some(judge) => judge.use_receiver(number, now),
            None => self.config.docket.use_receiver(number, now),
        }
        GNSS_POSITION_ERROR.renew(&mut self.state.covariance, &Matrix3::identity());
        GNSS_VELOCITY_ERROR.renew(&mut self.state.covariance, &Matrix3::identity());
        GNSS_DELAY
            .renew(&mut self.state.covariance, &Matrix1::new(self.config.gnss.delay_std.powi(2)));
        self.state.nominal.gnss_position_error = Vector3::zeros();
        self.state.nominal.gnss_velocity_error = Vector3::zeros();
        (self.state.nominal.gnss_delay, self.receiver.redated, self.receiver.rtk) =
            (0.0, None, None);
        self.receiver.lateness = 0.0;
        self.receiver.trust.clear();
        let begun = SeparateBias::new(&self.view());
        self.installation.bias = self.installation.bias.take().map(|_| begun);
        self.restart_judge();
        self.receiver.slow_noise = self.noise_of_slow();
    }

    /// Lets the judge compare a receiver that is not in use.
    pub(super) fn compare(&mut self, fix: &GnssFix, source: Source) {
        let (Source::Gnss(number), now) = (source, self.state.time) else { return };
        let is_due = |judge: &Judge| judge.is_due(Aid::SparePosition, now);
        if !fix.quality.is_measured() || !self.court.judge.as_deref().is_some_and(is_due) {
            return;
        }
        let is_admitted = self.judge_now().is_some_and(|judge| judge.admits_spare(number, now));
        let Some(position) = self.spare_position(fix).filter(|_| is_admitted) else { return };
        let velocity = self.spare_velocity(fix);
        if self.docket().is_excluded(Party::Gnss2) {
            return self.follow_spare(&position, velocity.as_ref());
        }
        if let Some(velocity) = velocity {
            let aid = Aid::SpareVelocity;
            let flat = self.as_slow(aid, &velocity.select(&HORIZONTAL), APART_VELOCITY);
            self.consult(aid, &flat, |_| rows::of_spare_velocity());
        }
        let flat = self.as_slow(Aid::SparePosition, &position.select(&HORIZONTAL), APART);
        self.consult(Aid::SparePosition, &flat, rows::of_spare_position);
    }

    /// Lever arm of a receiver that is compared, body axes, m: what was found of the one in use holds for it if they
    /// share an antenna.
    fn spare_lever(&self, fix: &GnssFix) -> Vector3<f64> {
        let own = fix.lever.filter(|own| *own != self.config.lever_arms.gnss);
        own.map_or_else(|| self.antenna_lever(), |own| own.0)
    }

    /// The position of a receiver that is compared, with all that it says its errors are, white.
    fn spare_position(&self, fix: &GnssFix) -> Option<Innovation> {
        let (view, lever) = (self.view(), self.spare_lever(fix));
        let told = self.config.floors.gnss_position(fix.position_std, fix.quality).value;
        let unmeasured = if lever.norm() > 0.0 { 0.0 } else { self.config.gnss_lever_std() };
        let measured = PositionFix {
            position: fix.position?,
            white: told.map(|std| std.hypot(unmeasured)),
            slow: Vector3::zeros(),
            velocity: view.c_ne * self.antenna_velocity(),
        };
        Some(gnss_position::innovation(&view, &measured, &lever))
    }

    /// What has errors that last, by so much more and for so long: as noisy as if each were new.
    fn as_slow(&self, aid: Aid, told: &Innovation, [by, lasts]: [f64; 2]) -> Innovation {
        let unheard = |judge: &Judge| judge.unheard(aid, self.state.time);
        let since = self.court.judge.as_deref().map_or(lasts, unheard);
        let factor = 2.0 * lasts / since.clamp(0.1, 2.0 * lasts) * self.noise_of(aid);
        let slow = told.r.diagonal().map(|variance| (variance + by * by) * factor);
        Innovation { r: DMatrix::from_diagonal(&slow), ..told.clone() }
    }

    /// Sees whether a receiver that is left out agrees again, with its position and its velocity.
    fn follow_spare(&mut self, position: &Innovation, velocity: Option<&Innovation>) {
        let (now, covariance) = (self.state.time, self.state.covariance.clone());
        let both = position.beside(velocity.unwrap_or(&Innovation::silent(3)));
        let noise = [horizontal_noise(position), position_std(&covariance)];
        if let Some((weighed, judge)) = both.weigh(&covariance).zip(self.judge_now()) {
            judge.follow((Party::Gnss2, now), &weighed, noise);
        }
    }

    fn spare_velocity(&self, fix: &GnssFix) -> Option<Innovation> {
        let (view, lever): (View, _) = (self.view(), self.spare_lever(fix));
        let c_ne = fix.position.map_or(view.c_ne, |antenna| earth::c_ne(&antenna));
        let measured = VelocityFix {
            velocity: view.c_ne * c_ne.transpose() * fix.velocity?.0,
            white: self.config.floors.gnss_velocity(fix.velocity_std).value,
            slow: Vector3::zeros(),
            acceleration: view.c_ne * self.antenna_acceleration(),
        };
        Some(gnss_velocity::innovation(&view, &measured, &lever))
    }
}
