//! That a craft hardly moves sideways, as weak knowledge where nothing measures it.

use insd_base::{LogReference, LogVelocity, Sideways, VesselKind};
use nalgebra::Vector3;

use super::Filter;
use crate::aids::log_velocity;
use crate::declaration::Carried;
use crate::error_state::VELOCITY;
use crate::wheels::WheelLook;

/// A car is held to its course so often, s.
const EVERY: f64 = 1.0;
/// A log that gave the component across within this time, s, knows better.
const TOLD: f64 = 5.0;
/// How fast a car bounces on its springs and climbs, 1-sigma, m/s.
const BOUNCE: f64 = 0.2;
/// Longest time for which one look stands, s.
const LONGEST: f64 = 5.0;
/// A velocity that is known to less, m/s, tells nothing of wheels.
const TOLD_TO: f64 = 0.2;

impl Filter {
    /// What kind of craft she is: as configured, or as she is seen to be.
    pub(super) fn vessel(&self) -> VesselKind {
        if self.conduct.wheels.are_proven() { VesselKind::Car } else { self.config.vessel }
    }

    /// A ship does not climb: what does, as it points, and never slides, goes on wheels. Looked at once a second while a
    /// receiver tells her velocity.
    pub(super) fn look_for_wheels(&mut self) {
        let is_asked = self.navigating && !self.config.vessel.has_wheels();
        let is_told = VELOCITY.std(&self.state.covariance) < TOLD_TO && !self.court.is_restless();
        if is_asked && is_told {
            let view = self.view();
            let (velocity, attitude) = (view.v_n(), view.attitude());
            let body = view.c_nb().tr_mul(&velocity);
            let look = WheelLook { velocity: body, rise: -velocity.z, pitch: attitude.pitch };
            self.conduct.wheels.see(self.state.time, &look);
        }
    }

    /// A log without a component across: the ship makes little leeway.
    pub(super) fn hold_leeway(&mut self, log: &LogVelocity) {
        if self.navigating && !self.state.is_moored() {
            let lever = self.config.lever_arms.log.0;
            self.hold_across(log.reference, &lever);
        }
    }

    /// A car goes where its wheels let it, whatever else is heard.
    pub(super) fn hold_to_wheels(&mut self) {
        let since =
            self.heard.held.map_or(f64::INFINITY, |last| (self.state.time - last).as_seconds());
        if !self.vessel().has_wheels() || !self.navigating || since < EVERY {
            return;
        }
        self.settle();
        let at_imu = Vector3::zeros();
        self.keeping_course(|own| {
            own.hold_across(LogReference::Bottom, &at_imu);
            let spacing = since.min(LONGEST);
            own.hold(LogReference::Bottom, &at_imu, 2, BOUNCE, spacing);
        });
    }

    /// Brings in what does not tell the velocity over the Earth, and so cannot see a turn of all that moves.
    pub(super) fn keeping_course(&mut self, bring_in: impl FnOnce(&mut Self)) {
        let before = self.state.course();
        bring_in(self);
        self.state.keep_course_unknown(&before);
    }

    fn hold_across(&mut self, reference: LogReference, lever: &Vector3<f64>) {
        let is_told =
            self.heard.across.is_some_and(|at| (self.state.time - at).as_seconds() < TOLD);
        let since = self.heard.held.replace(self.state.time);
        if is_told {
            return;
        }
        let Sideways { drift, pivot, .. } = self.vessel().sideways();
        let spacing = since.map_or(EVERY, |since| (self.state.time - since).as_seconds());
        let turning = pivot * self.state.rate.z;
        self.hold(reference, lever, 1, drift.hypot(turning), spacing.min(LONGEST));
    }

    /// A component is zero but for an error with a sigma, m/s, that lasts for the time of a drift: what is told of it at
    /// intervals of `spacing` seconds is worth no more than that.
    fn hold(
        &mut self,
        reference: LogReference,
        lever: &Vector3<f64>,
        axis: usize,
        sigma: f64,
        spacing: f64,
    ) {
        self.begin_to_carry(Carried::WithLog);
        let shared = (2.0 * self.vessel().sideways().time / spacing.max(0.05)).max(1.0);
        let prediction = log_velocity::predict(&self.view(), reference, lever, self.state.turn);
        let std = sigma * shared.sqrt();
        let innovation = log_velocity::component(&prediction, axis, 0.0, std);
        if let Some(weighed) = innovation.weigh(&self.state.covariance)
            && weighed.nis() <= self.gate.limit(1)
        {
            self.absorb(&weighed);
        }
    }
}
