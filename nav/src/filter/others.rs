//! Log and external reference.

use insd_base::{ExternalReference, LogReference, LogVelocity, Source};
use nalgebra::Vector2;

use super::{Filter, enter};
use crate::aids::{log_velocity, reference_heading, reference_position, reference_velocity};
use crate::floors::{self, Believable, Floored};
use crate::report::{Outcome, Report};

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
            self.note_log(log, enter(report, log.time, source, aid, &judged));
            return;
        }
        for (axis, measured) in [log.u, log.v, log.w].into_iter().enumerate() {
            let Some(measured) = measured else { continue };
            let prediction = log_velocity::predict(&self.view(), log.reference, &lever);
            let judged =
                self.judge(&log_velocity::component(&prediction, axis, measured, std), None);
            self.note_log(log, enter(report, log.time, source, aid, &judged));
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
            let judged =
                self.judge(&reference_position::innovation(&self.view(), &position, std), None);
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

    fn note_log(&mut self, log: &LogVelocity, outcome: Outcome) {
        if outcome == Outcome::Accepted && log.reference == LogReference::Water {
            self.last_water = Some(self.time);
        }
        self.note(outcome);
    }

    pub(super) fn note(&mut self, outcome: Outcome) {
        if outcome == Outcome::Accepted {
            self.last_relative = Some(self.time);
        }
    }
}

fn floored(stated: Option<f64>, range: &Believable, aid: &'static str, report: &mut Report) -> f64 {
    let Floored { value, replaced } = floors::scalar(stated, range);
    if replaced {
        report.floored.push(aid);
    }
    value
}
