//! A receiver that leaps while there is no judge, as at the berth, that contradicts itself, or that tells the past.

use insd_base::{Fault, GnssFix};

use super::Filter;
use crate::error_state::{POSITION, VELOCITY};
use crate::floors;
use crate::judge::Aid;
use crate::leap::Told;

impl Filter {
    /// Notes where the antenna is and how it moves.
    pub(super) fn note_antenna_motion(&mut self) {
        let velocity = self.antenna_velocity();
        self.antenna.note(self.time, &velocity);
        let lever = self.nominal.attitude.transform_vector(&self.antenna_lever());
        self.echo.note(self.time, &(self.nominal.position + lever), &velocity);
    }

    /// Tells the judge of a receiver of which the position does not go where its velocity says, or that tells what was seconds ago.
    pub(super) fn watch_for_contradictions(&mut self, fix: &GnssFix) {
        let Some((place, velocity)) = fix.position.zip(fix.velocity) else { return };
        let noise = self.noise_of(Aid::GnssPosition).sqrt();
        let place_std = floors::vector(fix.position_std, &floors::gnss_position(fix.quality)).value;
        let velocity_std = floors::vector(fix.velocity_std, &floors::gnss_velocity()).value;
        let told = Told {
            time: self.time,
            place,
            place_std: place_std.xy().max() * noise,
            velocity: velocity.0.xy(),
            velocity_std: velocity_std.xy().max(),
        };
        let beside_own = Told {
            place_std: told.place_std.hypot(POSITION.std(&self.covariance)),
            velocity_std: told.velocity_std.hypot(VELOCITY.std(&self.covariance)),
            ..told
        };
        let is_blamed = self.own_word.see(&told) | self.echo.see(&beside_own);
        let now = self.time;
        if let Some(judge) = self.judge_now().filter(|_| is_blamed) {
            judge.note_contradiction(now);
        }
    }

    /// Watches for leaps where there is no judge: who leaps is left out.
    pub(super) fn watch_for_leaps(&mut self, fix: &GnssFix) {
        let Some(place) = fix.position else { return };
        if self.judge.is_some() || self.docket().leaves_out_gnss() {
            return;
        }
        let std = floors::vector(fix.position_std, &floors::gnss_position(fix.quality));
        let velocity = self.view().c_ne * self.antenna_velocity();
        let velocity_std = VELOCITY.covariance(&self.covariance).diagonal().max().max(0.0).sqrt();
        let (time, place_std) = (self.time, std.value.xy().max());
        let told = Told { time, place, place_std, velocity: velocity.xy(), velocity_std };
        if let Some(leap) = self.leap.see(&told) {
            let mut docket = self.config.docket;
            docket.convict(Fault::Jump, self.time, (leap, 0.0));
            self.config = self.config.with_docket(docket);
        }
    }
}
