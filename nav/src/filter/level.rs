//! The mean sea level holds the height.

use super::Filter;
use crate::aids::sea_level;
use crate::error_state::{Errors, Innovation, POSITION, SEA_LEVEL, VELOCITY, Weighed};
use crate::judge::{Aid, rows};

impl Filter {
    /// Holds the mean height over a window of waves against the sea level.
    pub(super) fn hold_sea_level(&mut self) {
        let (mean, length) = self.state.level.take_mean();
        let innovation =
            sea_level::innovation(&self.view(), mean, length, self.state.level.heave.std());
        let Some(weighed) = innovation.weigh(&self.state.covariance) else { return };
        let excess = (weighed.nis() / self.gate.limit(1)).max(1.0);
        let is_alone = self.is_carried_by_imu();
        if !is_alone {
            // who is not at sea, in a lock or on a hill, has a level that tells against nobody more than once
            let r = innovation.r.add_scalar((excess - 1.0) * weighed.sigma()[0].powi(2));
            self.consult(Aid::SeaLevel, &Innovation { r, ..innovation.clone() }, |_| {
                rows::untouched(1)
            });
        }
        let expected = weighed.sigma()[0].powi(2) - innovation.r[0];
        self.state.level.heave.learn(innovation.z[0], expected);
        if excess > 1.0 {
            return;
        }
        if is_alone {
            self.absorb_vertically(&weighed);
        } else {
            self.absorb(&weighed);
        }
    }

    /// Lets a height move the vertical channel only. Without any other aid tilt and heading errors
    /// grow until their squares matter to the height, and the linear filter would take them for
    /// knowledge of the horizontal.
    fn absorb_vertically(&mut self, weighed: &Weighed) {
        let up = self.state.nominal.position.normalize();
        let optimal = weighed.gain_of(0);
        let mut gain = Errors::zeros(weighed.layout());
        for block in [POSITION, VELOCITY] {
            let along = optimal.of(block).dot(&up);
            gain.set(block, &(up * along));
        }
        gain.set(SEA_LEVEL, &optimal.of(SEA_LEVEL));
        let gain = gain.to_column();
        if let Some(bias) = &mut self.installation.bias {
            bias.absorb_by(weighed, &gain);
        }
        let error = weighed.update_with(&mut self.state.covariance, &gain);
        self.state.correct(&error);
        self.court.owed += &error;
    }
}
