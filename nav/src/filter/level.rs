//! The mean sea level holds the height.

use nalgebra::SMatrix;

use super::Filter;
use crate::aids::sea_level;
use crate::error_state::{POSITION, SEA_LEVEL, VELOCITY};
use crate::innovation::{Innovation, Weighed};
use crate::judge::{Aid, untouched};

impl Filter {
    /// Holds the mean height over a window of waves against the sea level.
    pub(super) fn hold_sea_level(&mut self) {
        let (mean, length) = self.level.take_mean();
        let innovation = sea_level::innovation(&self.view(), mean, length, self.level.heave.std());
        let Some(weighed) = innovation.weigh(&self.covariance) else { return };
        let excess = (weighed.nis() / self.gate.limit::<1>()).max(1.0);
        let is_alone = self.is_carried_by_imu();
        if !is_alone {
            // who is not at sea, in a lock or on a hill, has a level that tells against nobody more than once
            let r = innovation.r.add_scalar((excess - 1.0) * weighed.sigma().x.powi(2));
            self.consult(Aid::SeaLevel, &Innovation { r, ..innovation }, untouched::<1>);
        }
        let expected = weighed.sigma().x.powi(2) - innovation.r.x;
        self.level.heave.learn(innovation.z.x, expected);
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
    fn absorb_vertically(&mut self, weighed: &Weighed<1>) {
        let up = self.nominal.position.normalize();
        let optimal = weighed.gain();
        let mut gain = SMatrix::zeros();
        for block in [POSITION, VELOCITY] {
            let along = block.of(&optimal).dot(&up);
            block.set(&mut gain, &(up * along));
        }
        SEA_LEVEL.set(&mut gain, &SEA_LEVEL.of(&optimal));
        self.pass_on(weighed, &gain);
        let error = weighed.update_with(&mut self.covariance, &gain);
        self.nominal.inject(&error);
        self.owed += error.transpose();
        self.absorbed += VELOCITY.of(&error);
    }
}
