//! What no craft of her kind does speaks against the IMU.

use insd_base::Mode;

use super::Filter;
use crate::error_state::VELOCITY;
use crate::judge::{Aid, Judge};

/// Who has not been heard for so long is no witness of the heading, s.
const ALONE: f64 = 60.0;

impl Filter {
    /// Without GNSS the estimate does what no craft of its kind can, and this one never did: the IMU is not believed.
    pub(super) fn look_at_pace(&mut self) {
        if !self.conduct.pace.is_due(self.state.time) {
            return;
        }
        let (now, kind) = (self.state.time, self.vessel());
        let athwart = (self.state.nominal.attitude.inverse() * self.state.nominal.velocity).y;
        let change = self.conduct.pace.see(now, self.state.nominal.velocity.norm());
        let lurch = self.conduct.lurch.see(now, athwart);
        if self.mode() == Mode::Aided {
            self.conduct.pace.learn(change);
            self.conduct.lurch.learn(lurch);
            self.look_for_wheels();
            return;
        }
        let farthest = self.conduct.lurch.limit(kind.greatest_lurch())
            + 3.0 * VELOCITY.std(&self.state.covariance);
        // at first a lever arm may be configured wrongly
        let is_beyond = change > self.conduct.pace.limit(kind.greatest_spurt())
            || (lurch > farthest && !self.is_early());
        if is_beyond && !self.court.is_restless() {
            self.disbelieve_imu();
        }
    }

    /// The estimate is not that of before: how it moved since is of no account.
    pub(super) fn forget_motion(&mut self) {
        self.conduct.restart();
        self.receiver.echo.restart();
    }

    /// With nothing but a receiver the heading turns as no craft does: the IMU is not believed.
    pub(super) fn look_at_slip(&mut self) {
        let now = self.state.time;
        let is_alone = |judge: &Judge| {
            [Aid::Heading, Aid::Log].iter().all(|aid| !judge.has_heard(*aid, now, ALONE))
        };
        let is_judged = self.court.judge.as_deref().is_some_and(is_alone) && !self.is_early();
        if !is_judged || !self.conduct.slip.is_due(now) {
            return;
        }
        if !matches!(self.mode(), Mode::Aided | Mode::Inertial) || self.court.is_restless() {
            self.conduct.slip.restart();
            return;
        }
        let view = self.view();
        let velocity = (view.c_ne * self.state.nominal.velocity).xy();
        let bow = view.c_nb().column(0).xy();
        // of her course without a receiver
        let unsure = self
            .heading_std()
            .hypot(VELOCITY.std(&self.state.covariance) / velocity.norm().max(1.0));
        if self.conduct.slip.see(now, velocity, bow.y.atan2(bow.x), unsure) {
            self.disbelieve_imu();
        }
    }
}
