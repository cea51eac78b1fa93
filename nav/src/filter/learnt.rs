//! What is learnt of a log over hours, and what the filter makes of it.

use insd_base::LogVelocity;
use nalgebra::{Vector2, Vector3};

use super::Filter;
use crate::aids::log_velocity;
use crate::declaration::Carried;
use crate::error_state::{ATTITUDE, LOG_BY_SPEED, LOG_SCALE, VELOCITY};

/// A log beside the estimate, horizontal, body axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LogLook {
    /// Velocity over the Earth at the log, forward and starboard, m/s.
    pub velocity: Vector2<f64>,
    /// 1-sigma of the horizontal velocity, each component, m/s.
    pub velocity_std: f64,
    /// Heading, rad.
    pub heading: f64,
    /// Its 1-sigma, rad.
    pub heading_std: f64,
    /// Rate of turn without that of the waves, rad/s.
    pub turn: f64,
    /// By what the log measures.
    pub stated_std: f64,
}

impl Filter {
    /// The estimate as a log of this reference would measure it, its own errors and the current left out.
    #[must_use]
    pub fn look_at_log(&self, log: &LogVelocity) -> LogLook {
        let view = self.view();
        let lever = self.config.lever_arms.log.0;
        let v_b = view.c_eb.tr_mul(&view.nominal.velocity) + view.rate.cross(&lever);
        let own = VELOCITY.covariance_in(&self.state.covariance, &view.c_ne);
        let turned = ATTITUDE.covariance_in(&self.state.covariance, &view.c_ne);
        LogLook {
            velocity: v_b.xy(),
            velocity_std: own[(0, 0)].max(own[(1, 1)]).max(0.0).sqrt(),
            heading: view.attitude().heading,
            heading_std: turned[(2, 2)].max(0.0).sqrt(),
            turn: self.state.turn,
            stated_std: log.std.unwrap_or(self.config.floors.log.default),
        }
    }

    /// Whether errors of the log that depend on speed and rate of turn are estimated, and how the current goes on, 1-sigma, m/s,
    /// and time constant, s. Where they are not any more, what they come to at this speed is the scale
    /// factor's, so that nothing steps.
    pub fn learn_log(&mut self, is_learnt: bool, current: (f64, f64)) {
        (self.config.log.current_std, self.config.log.current_time) = current;
        if self.config.log.is_learnt && !is_learnt && self.state.covariance.has(LOG_BY_SPEED) {
            let speed = self.speed_through_water();
            let variance = LOG_BY_SPEED.covariance(&self.state.covariance).x * speed * speed;
            LOG_SCALE.inflate(&mut self.state.covariance, variance.max(0.0));
            self.state.nominal.log_scale += self.state.nominal.log_by_speed * speed;
            self.end_to_carry(Carried::WithLearning);
            self.restart_judge();
        }
        self.config.log.is_learnt = is_learnt;
    }

    /// What [`Self::learn_log`] was told.
    #[must_use]
    pub fn log_as_learnt(&self) -> (bool, (f64, f64)) {
        let log = &self.config.log;
        (log.is_learnt, (log.current_std, log.current_time))
    }

    fn speed_through_water(&self) -> f64 {
        let own = log_velocity::predict(
            &self.view(),
            insd_base::LogReference::Water,
            &Vector3::zeros(),
            0.0,
        );
        own.velocity.x.abs()
    }
}
