//! The mean sea level holds the height.

use insd_base::{Party, Standing};

use super::Filter;
use crate::aids::sea_level;
use crate::error_state::{Errors, Innovation, POSITION, SEA_LEVEL, VELOCITY, Weighed};
use crate::judge::{Aid, Judge, rows};
use crate::sea_window::ASHORE;

/// A height that tells whether she is at sea is known to this, 1-sigma, m.
const KNOWN: f64 = 3.0;

impl Filter {
    /// Holds the mean height over a window of waves against the sea level: firmly at sea, and ashore by next to nothing.
    pub(super) fn hold_sea_level(&mut self) {
        let is_at_sea = self.is_at_sea();
        let (mean, length) = self.state.level.take_mean();
        let is_told = self.is_height_told();
        let std = if is_at_sea { self.state.level.std(is_told) } else { ASHORE };
        let innovation = sea_level::innovation(&self.view(), mean, length, std);
        let Some(weighed) = innovation.weigh(&self.state.covariance) else { return };
        let excess = (weighed.nis() / self.gate.limit(1)).max(1.0);
        let is_alone = self.is_carried_by_imu();
        if !is_alone && is_at_sea {
            // who is not at sea, in a lock or on a hill, has a level that tells against nobody more than once
            let r = innovation.r.add_scalar((excess - 1.0) * weighed.sigma()[0].powi(2));
            self.consult(Aid::SeaLevel, &Innovation { r, ..innovation.clone() }, |_| {
                rows::untouched(1)
            });
        }
        if is_at_sea {
            let expected = weighed.sigma()[0].powi(2) - innovation.r[0];
            self.state.level.heave.learn(innovation.z[0], expected);
            if is_told {
                self.state.level.see(innovation.z[0], excess > 1.0);
            }
        }
        if excess > 1.0 {
            return;
        }
        if is_alone {
            self.absorb_vertically(&weighed);
        } else {
            self.absorb(&weighed);
        }
    }

    /// Whether the mean sea level holds her: not if she goes on wheels, or was seen to climb.
    fn is_at_sea(&self) -> bool {
        !self.vessel().has_wheels() && !self.state.level.is_refuted()
    }

    /// Whether her height is known, as her berth holds her, or a receiver tells it against whom nothing speaks.
    fn is_height_told(&self) -> bool {
        let up = self.state.nominal.position.normalize();
        let variance = up.dot(&(POSITION.covariance(&self.state.covariance) * up));
        if variance > KNOWN * KNOWN {
            return false;
        }
        let is_clear = |judge: &Judge| {
            !judge.is_in_doubt() && judge.docket().standing(Party::Gnss) == Standing::Trusted
        };
        self.state.is_moored() || self.gnss_is_fresh() && self.judge().is_some_and(is_clear)
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
