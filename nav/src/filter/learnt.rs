//! What is learnt of a log over hours, and what the filter makes of it.

use insd_base::LogVelocity;
use nalgebra::{Matrix2, Matrix5, Vector2, Vector5};

use super::Filter;
use crate::config::LogShape;
use crate::declaration::Carried;
use crate::error_state::{
    ATTITUDE, Covariance, LOG_BY_SPEED, LOG_BY_TURN, LOG_MISALIGNMENT, LOG_SCALE, VELOCITY,
};

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

    /// Scale factor of the log and its shape as they are estimated: scale factor, ratio, its change with the speed and that of the turn,
    /// 1/(m/s), and what is added forward and to starboard by the rate of turn, m; with their covariance. `None` where they are not.
    #[must_use]
    pub fn found_log(&self) -> Option<(Vector5<f64>, Matrix5<f64>)> {
        let (nominal, p) = (&self.state.nominal, &self.state.covariance);
        if !p.has(LOG_BY_TURN) {
            return None;
        }
        let (by_speed, by_turn) = (nominal.log_by_speed, nominal.log_by_turn);
        let found = Vector5::new(nominal.log_scale, by_speed.x, by_speed.y, by_turn.x, by_turn.y);
        let mut own = Matrix5::zeros();
        own.fixed_view_mut::<1, 1>(0, 0).copy_from(&LOG_SCALE.covariance(p));
        own.fixed_view_mut::<1, 2>(0, 1).copy_from(&LOG_SCALE.covariance_with(LOG_BY_SPEED, p));
        own.fixed_view_mut::<1, 2>(0, 3).copy_from(&LOG_SCALE.covariance_with(LOG_BY_TURN, p));
        own.fixed_view_mut::<2, 2>(1, 1).copy_from(&LOG_BY_SPEED.covariance(p));
        own.fixed_view_mut::<2, 2>(1, 3).copy_from(&LOG_BY_SPEED.covariance_with(LOG_BY_TURN, p));
        own.fixed_view_mut::<2, 2>(3, 3).copy_from(&LOG_BY_TURN.covariance(p));
        own.fill_lower_triangle_with_upper_triangle();
        Some((found, own))
    }

    /// A log speaks: what is known of its shape is carried from now on. Scale factor and misalignment make up for it at this speed, so that
    /// nothing steps.
    pub(super) fn begin_to_learn(&mut self) {
        let Some(shape) = self.config.log.shape else { return };
        if self.state.covariance.has(LOG_BY_SPEED) {
            return;
        }
        self.begin_to_carry(Carried::WithLearning);
        let speed = self.speed_through_water();
        let nominal = &mut self.state.nominal;
        nominal.log_by_speed = shape.by_speed.map(|own| own.value).into();
        nominal.log_by_turn = shape.by_turn.map(|own| own.value).into();
        nominal.log_scale -= nominal.log_by_speed.x * speed;
        nominal.log_misalignment.y += nominal.log_by_speed.y * speed;
        // that at this speed is as well known as before: what its change with the speed is not known by is the scale factor's at none
        tie_shape(&mut self.state.covariance, -speed);
        if let Some(judge) = self.judge_now() {
            judge.change(|covariance| tie_shape(covariance, -speed));
        }
    }

    /// What its shape comes to at this speed is the scale factor's and the misalignment's from now on.
    fn end_to_learn(&mut self) {
        let speed = self.speed_through_water();
        tie_shape(&mut self.state.covariance, speed);
        let nominal = &mut self.state.nominal;
        nominal.log_scale += nominal.log_by_speed.x * speed;
        nominal.log_misalignment.y -= nominal.log_by_speed.y * speed;
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

/// Errors of scale factor and misalignment become those at another speed, so much higher, m/s: k <- k + s v, and m <- m - q v, which turns the other way.
fn tie_shape(covariance: &mut Covariance, speed: f64) {
    let start = |key| covariance.layout().start(key);
    let at = (start(LOG_SCALE.key()), start(LOG_MISALIGNMENT.key()), start(LOG_BY_SPEED.key()));
    let (Some(scale), Some(misalignment), Some(by_speed)) = at else { return };
    for (pair, speed) in [((scale, by_speed), speed), ((misalignment + 1, by_speed + 1), -speed)] {
        covariance.carry_pair(pair, &Matrix2::new(1.0, speed, 0.0, 1.0), &Matrix2::zeros());
    }
}
