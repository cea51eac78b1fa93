//! Log, external reference and berth.

use insd_base::{ExternalReference, Geodetic, LogReference, LogVelocity, Source, Span};
use nalgebra::{Matrix2, Vector2};

use super::{Filter, Judged, enter};
use crate::aids::{
    berth, log_velocity, mooring, reference_heading, reference_position, reference_velocity,
};
use crate::error_state::BERTH_OFFSET;
use crate::floors::{self, Believable, Floored};
use crate::report::{Outcome, Report};

/// The berth itself is known to this, 1-sigma of each component, m.
const BERTH_SURVEY: f64 = 0.05;
/// Zero velocities or berth positions that fail their gate one after the other before the ship has left the berth.
const STRAYED: u32 = 4;

impl Filter {
    pub(super) fn apply_log(&mut self, log: &LogVelocity, source: Source, report: &mut Report) {
        let aid = match log.reference {
            LogReference::Bottom => "log_bottom",
            LogReference::Water => "log_water",
        };
        let default = self.config.log.default_std;
        let range = Believable { least: 0.002, greatest: 10.0, default };
        let std = floored(log.std, &range, aid, report);
        let lever = self.config.lever_arms.log.0;
        let prediction = log_velocity::predict(&self.view(), log.reference, &lever);
        if let Some(measured) = log_velocity::all_components(log) {
            let judged = self.judge(&log_velocity::complete(&prediction, &measured, std), None);
            self.note(enter(report, log.time, source, aid, &judged));
            return;
        }
        for (axis, measured) in [log.u, log.v, log.w].into_iter().enumerate() {
            let Some(measured) = measured else { continue };
            let prediction = log_velocity::predict(&self.view(), log.reference, &lever);
            let judged =
                self.judge(&log_velocity::component(&prediction, axis, measured, std), None);
            self.note(enter(report, log.time, source, aid, &judged));
        }
    }

    pub(super) fn apply_reference(
        &mut self,
        reference: &ExternalReference,
        source: Source,
        report: &mut Report,
    ) {
        if let Some(velocity) = reference.velocity() {
            let range = Believable { least: 0.005, greatest: 50.0, default: 0.5 };
            let std = floored(reference.velocity_std, &range, "reference_velocity", report);
            let v_ne = Vector2::new(velocity.0.x, velocity.0.y);
            let judged =
                self.judge(&reference_velocity::innovation(&self.view(), &v_ne, std), None);
            self.note(enter(report, reference.time, source, "reference_velocity", &judged));
        }
        if let Some(position) = reference.position {
            let range = Believable { least: 0.01, greatest: 1e4, default: 20.0 };
            let std = floored(reference.position_std, &range, "reference_position", report);
            let judged = if self.moored {
                self.judge_berth(&position, std)
            } else {
                self.judge(&reference_position::innovation(&self.view(), &position, std), None)
            };
            self.note(enter(report, reference.time, source, "reference_position", &judged));
        }
        if let Some(heading) = reference.heading {
            let degree = insd_base::units::DEG;
            let range =
                Believable { least: 0.01 * degree, greatest: 180.0 * degree, default: degree };
            let std = floored(reference.heading_std, &range, "reference_heading", report);
            let judged =
                self.judge(&reference_heading::innovation(&self.view(), heading, std), None);
            self.note(enter(report, reference.time, source, "reference_heading", &judged));
        }
    }

    fn note(&mut self, outcome: Outcome) {
        if outcome == Outcome::Accepted {
            self.last_relative = Some(self.time);
        }
    }

    /// The reference names the berth, and its sigma is the ship's play on her moorings.
    fn judge_berth(&mut self, berth: &Geodetic, play: f64) -> Judged {
        if self.berth_offset_std != play {
            self.berth_offset_std = play;
            let variance = Matrix2::from_diagonal_element(play * play);
            BERTH_OFFSET.renew(&mut self.covariance, &variance);
            self.nominal.berth_offset = Vector2::zeros();
        }
        let judged = self.judge(&berth::innovation(&self.view(), berth, BERTH_SURVEY), None);
        self.count_straying(judged.outcome == Outcome::Accepted);
        let patience = self.config.sea.berth_offset_time * 2.0;
        self.next_mooring = self.time + Span::from_seconds(patience);
        judged
    }

    /// A ship that is again and again not where she is tied has left.
    fn count_straying(&mut self, agrees: bool) {
        self.strayed = if agrees { 0 } else { self.strayed + 1 };
        self.moored = self.strayed < STRAYED;
    }

    /// Zero velocity at the berth where no reference position comes, spaced by the time over which the sway decorrelates.
    pub(super) fn hold_mooring(&mut self) {
        self.next_mooring = self.time + Span::from_seconds(self.config.sea.mooring_time);
        let innovation = mooring::innovation(&self.view(), self.sway.std());
        let Some(weighed) = innovation.weigh(&self.covariance) else { return };
        let sigma = weighed.sigma();
        for axis in 0..2 {
            let expected = sigma[axis].powi(2) - innovation.r[(axis, axis)];
            self.sway.learn(innovation.z[axis], expected);
        }
        self.internal_likelihood += self.bounded_likelihood(&weighed);
        let agrees = weighed.nis() < self.gate.limit::<2>();
        if agrees {
            self.absorb(&weighed);
        }
        self.count_straying(agrees);
    }
}

fn floored(stated: Option<f64>, range: &Believable, aid: &'static str, report: &mut Report) -> f64 {
    let Floored { value, replaced } = floors::scalar(stated, range);
    if replaced {
        report.floored.push(aid);
    }
    value
}
