//! What is learnt of a log over hours, and what the filter makes of it.

use insd_base::LogVelocity;
use nalgebra::{Matrix3, Vector2, Vector3};

use super::Filter;
use crate::config::LogShape;
use crate::declaration::Carried;
use crate::error_state::{ATTITUDE, LOG_BY_SPEED, LOG_BY_TURN, LOG_SCALE, VELOCITY};

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
    /// 1-sigma that the log states, or is taken to have, m/s.
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

    /// Which errors of the log that depend on speed and rate of turn are estimated, and how the current goes on, 1-sigma, m/s, and
    /// time constant, s.
    pub fn learn_log(&mut self, shape: Option<LogShape>, current: (f64, f64)) {
        (self.config.log.current_std, self.config.log.current_time) = current;
        if shape.is_none() && self.state.covariance.has(LOG_BY_SPEED) {
            self.end_to_learn();
        }
        self.config.log.shape = shape;
    }

    /// What [`Self::learn_log`] was told.
    #[must_use]
    pub fn log_as_learnt(&self) -> (Option<LogShape>, (f64, f64)) {
        let log = &self.config.log;
        (log.shape, (log.current_std, log.current_time))
    }

    /// Scale factor of the log and its shape as they are estimated, and the covariance of scale factor, ratio, change with the speed, 1/(m/s), and of
    /// what is added by the rate of turn, m; `None` where they are not.
    #[must_use]
    pub fn found_log(&self) -> Option<(Vector3<f64>, Matrix3<f64>)> {
        let (nominal, p) = (&self.state.nominal, &self.state.covariance);
        if !p.has(LOG_BY_TURN) {
            return None;
        }
        let found = Vector3::new(nominal.log_scale, nominal.log_by_speed, nominal.log_by_turn);
        let mut own = Matrix3::zeros();
        let tied = [
            LOG_SCALE.covariance_with(LOG_BY_SPEED, p).x,
            LOG_SCALE.covariance_with(LOG_BY_TURN, p).x,
            LOG_BY_SPEED.covariance_with(LOG_BY_TURN, p).x,
        ];
        for (at, tied) in [(0, 1), (0, 2), (1, 2)].into_iter().zip(tied) {
            (own[at], own[(at.1, at.0)]) = (tied, tied);
        }
        for (i, block) in [LOG_SCALE, LOG_BY_SPEED, LOG_BY_TURN].into_iter().enumerate() {
            own[(i, i)] = block.covariance(p).x;
        }
        Some((found, own))
    }

    /// A log speaks: what is known of its shape is carried from now on. The scale factor makes up for it at this speed, so that nothing
    /// steps.
    pub(super) fn begin_to_learn(&mut self) {
        let Some(shape) = self.config.log.shape else { return };
        if self.state.covariance.has(LOG_BY_SPEED) {
            return;
        }
        self.begin_to_carry(Carried::WithLearning);
        let speed = self.speed_through_water();
        self.state.nominal.log_by_speed = shape.by_speed.value;
        self.state.nominal.log_by_turn = shape.by_turn.value;
        self.state.nominal.log_scale -= shape.by_speed.value * speed;
    }

    /// What its shape comes to at this speed is the scale factor's from now on.
    fn end_to_learn(&mut self) {
        let speed = self.speed_through_water();
        let variance = LOG_BY_SPEED.covariance(&self.state.covariance).x * speed * speed;
        LOG_SCALE.inflate(&mut self.state.covariance, variance.max(0.0));
        self.state.nominal.log_scale += self.state.nominal.log_by_speed * speed;
        self.end_to_carry(Carried::WithLearning);
        self.restart_judge();
    }

    /// Speed through the water as the estimate has it, m/s.
    fn speed_through_water(&self) -> f64 {
        let view = self.view();
        let (velocity, current) = (view.v_n(), self.state.nominal.current);
        (velocity.xy() - current).norm()
    }
}
