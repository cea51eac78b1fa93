//! A receiver that leaps while there is no judge, as at the berth, that contradicts itself, or that tells the past.

use insd_base::{Fault, GnssFix};

use super::Filter;
use crate::error_state::{POSITION, VELOCITY};
use crate::judge::Aid;
use crate::leap::ToldMotion;

impl Filter {
    /// Notes where the antenna is and how it moves.
    pub(super) fn note_antenna_motion(&mut self) {
        let velocity = self.antenna_velocity();
        self.receiver.antenna.note(self.state.time, &velocity);
        let lever = self.state.nominal.attitude.transform_vector(&self.antenna_lever());
        self.receiver.echo.note(self.state.time, &(self.state.nominal.position + lever), &velocity);
    }

    /// Tells the judge of a receiver of which the position does not go where its velocity says, or that tells what was seconds ago.
    pub(super) fn watch_for_contradictions(&mut self, fix: &GnssFix) {
        let Some((place, velocity)) = fix.position.zip(fix.velocity) else { return };
        let noise = self.noise_of(Aid::GnssPosition).sqrt();
        let place_std = self.config.floors.gnss_position(fix.position_std, fix.quality).value;
        let velocity_std = self.config.floors.gnss_velocity(fix.velocity_std).value;
        let told = ToldMotion {
            time: self.state.time,
            place,
            place_std: place_std.xy().max() * noise,
            velocity: velocity.0.xy(),
            velocity_std: velocity_std.xy().max(),
        };
        let beside_own = ToldMotion {
            place_std: told.place_std.hypot(POSITION.std(&self.state.covariance)),
            velocity_std: told.velocity_std.hypot(VELOCITY.std(&self.state.covariance)),
            ..told
        };
        let is_blamed = self.receiver.own_word.see(&told) | self.receiver.echo.see(&beside_own);
        let now = self.state.time;
        if let Some(judge) = self.judge_now().filter(|_| is_blamed) {
            judge.note_contradiction(now);
        }
    }

    /// Watches for leaps where there is no judge: who leaps is left out.
    pub(super) fn watch_for_leaps(&mut self, fix: &GnssFix) {
        let Some(place) = fix.position else { return };
        if self.court.judge.is_some() || self.docket().leaves_out_gnss() {
            return;
        }
        let std = self.config.floors.gnss_position(fix.position_std, fix.quality);
        let velocity = self.view().c_ne * self.antenna_velocity();
        let velocity_std =
            VELOCITY.covariance(&self.state.covariance).diagonal().max().max(0.0).sqrt();
        let (time, place_std) = (self.state.time, std.value.xy().max());
        let told = ToldMotion { time, place, place_std, velocity: velocity.xy(), velocity_std };
        if let Some(leap) = self.court.leap.see(&told) {
            let mut docket = self.config.docket;
            docket.convict(Fault::Jump, self.state.time, (leap, 0.0));
            self.config = self.config.with_docket(docket);
        }
    }
}
