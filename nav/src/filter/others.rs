//! Log and external reference.

use insd_base::{ExternalReference, LogReference, LogVelocity, Source};
use nalgebra::{Matrix3, SMatrix, Vector2};

use super::{Filter, enter};
use crate::aids::log_velocity::Prediction;
use crate::aids::{log_velocity, reference_heading, reference_position, reference_velocity};
use crate::floors::{self, Believable, Floored};
use crate::innovation::Innovation;
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
        let prediction = self.predict_log(log);
        if let Some(measured) = log_velocity::all_components(log) {
            let innovation = log_velocity::complete(&prediction, &measured, std);
            self.hear_log(&innovation, &prediction.by_lever);
            let judged = self.judge(&innovation, None);
            self.note_log(log, enter(report, log.time, source, aid, &judged));
            return;
        }
        for (axis, measured) in [log.u, log.v, log.w].into_iter().enumerate() {
            let Some(measured) = measured else { continue };
            let prediction = self.predict_log(log);
            let innovation = log_velocity::component(&prediction, axis, measured, std);
            self.hear_log(&innovation, &prediction.by_lever.fixed_rows::<1>(axis).into_owned());
            let judged = self.judge(&innovation, None);
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

    /// A lever arm that was found here, and not measured, makes noise as the ship turns.
    fn predict_log(&self, log: &LogVelocity) -> Prediction {
        let lever = self.config.lever_arms.log.0;
        let mut prediction = log_velocity::predict(&self.view(), log.reference, &lever);
        if let Some(std) = self.log_lever_std {
            let by_std = prediction.by_lever * Matrix3::from_diagonal(&std);
            prediction.swing_noise += by_std * by_std.transpose();
        }
        prediction
    }

    /// What a log says of the lever arms, whether it is used or not.
    fn hear_log<const M: usize>(
        &mut self,
        innovation: &Innovation<M>,
        by_lever: &SMatrix<f64, M, 3>,
    ) {
        let Some(bias) = &mut self.bias else { return };
        if let Some(weighed) = innovation.weigh(&self.covariance) {
            bias.hear_log(&weighed, by_lever);
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
