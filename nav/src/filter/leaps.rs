//! A receiver that leaps while there is no judge, as at the berth.

use insd_base::{Fault, GnssFix};

use super::Filter;
use crate::error_state::VELOCITY;
use crate::floors;
use crate::leap::Told;

impl Filter {
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
