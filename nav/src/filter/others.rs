//! Log and external reference.

use insd_base::{ExternalReference, LogReference, LogVelocity, Rejection, Source};
use nalgebra::{DMatrix, Matrix3, Vector2};

use super::Filter;
use super::entry::enter;
use crate::aids::log_velocity::Prediction;
use crate::aids::{log_velocity, reference_heading, reference_position, reference_velocity};
use crate::declaration::Carried;
use crate::error_state::Weighed;
use crate::floors::{self, Believable, Floored};
use crate::judge::{Aid, rows};
use crate::report::{Outcome, Report};

/// Time of the slow errors of another reference's position, s.
const SHARED: f64 = 60.0;

impl Filter {
    pub(super) fn apply_log(&mut self, log: &LogVelocity, source: Source, report: &mut Report) {
        let aid = match log.reference {
            LogReference::Bottom => "log_bottom",
            LogReference::Water => "log_water",
        };
        let range = self.config.floors.log;
        let stated = floored(log.std, &range, aid, report);
        self.begin_to_carry(Carried::WithLog);
        self.begin_to_learn();
        let prediction = self.predict_log(log);
        if let Some(measured) = log_velocity::all_components(log) {
            let mut innovation = log_velocity::complete(&prediction, &measured, stated);
            innovation.r *= self.noise_of(Aid::Log);
            let by_lever = by_rows(&prediction.by_lever, &[0, 1, 2]);
            let weighed = innovation.weigh(&self.state.covariance);
            let is_heard = self.hear_log(weighed.as_ref(), &by_lever);
            let direct = rows::of_log(&prediction.velocity, &self.view().c_nb());
            self.consult(Aid::Log, &innovation, |_| direct.clone());
            let judged = self.gated_as(weighed.as_ref(), self.withheld(Aid::Log));
            let outcome = enter(report, log.time, source, aid, &judged);
            self.note_log(log, outcome, weighed.as_ref().filter(|_| is_heard), &by_lever);
            self.heard.across = Some(self.state.time);
            return;
        }
        if log.v.is_some() {
            self.heard.across = Some(self.state.time);
        } else if log.u.is_some() && !self.withholds(Aid::Log) {
            self.hold_leeway(log);
        }
        for (axis, measured) in [log.u, log.v, log.w].into_iter().enumerate() {
            let Some(measured) = measured else { continue };
            let prediction = self.predict_log(log);
            let aid_heard = [Aid::Log, Aid::LogStarboard, Aid::LogDown][axis];
            let mut innovation = log_velocity::component(&prediction, axis, measured, stated);
            innovation.r *= self.noise_of(aid_heard);
            let by_lever = by_rows(&prediction.by_lever, &[axis]);
            let weighed = innovation.weigh(&self.state.covariance);
            let is_heard = self.hear_log(weighed.as_ref(), &by_lever);
            let direct = rows::of_log(&prediction.velocity, &self.view().c_nb());
            let own = direct.select_columns(&[axis]);
            self.consult(aid_heard, &innovation, |_| own.clone());
            let judged = self.gated_as(weighed.as_ref(), self.withheld(Aid::Log));
            let outcome = enter(report, log.time, source, aid, &judged);
            self.note_log(log, outcome, weighed.as_ref().filter(|_| is_heard), &by_lever);
        }
    }

    pub(super) fn apply_reference(
        &mut self,
        reference: &ExternalReference,
        source: Source,
        report: &mut Report,
    ) {
        if let Some(velocity) = reference.velocity() {
            let range = &self.config.floors.reference_velocity;
            let stated = floored(reference.velocity_std, range, "reference_velocity", report);
            let std = stated * self.noise_of(Aid::ReferenceVelocity).sqrt();
            let v_ne = Vector2::new(velocity.0.x, velocity.0.y);
            let innovation = reference_velocity::innovation(&self.view(), &v_ne, std);
            let direct = rows::of_reference_velocity();
            let aid = Aid::ReferenceVelocity;
            self.consult(aid, &innovation, |_| direct.clone());
            let judged = self.gated(&innovation, self.withheld(aid));
            self.note(enter(report, reference.time, source, "reference_velocity", &judged));
        }
        if let Some(position) = reference.position {
            let range = &self.config.floors.reference_position;
            let stated = floored(reference.position_std, range, "reference_position", report);
            let std =
                stated * self.noise_of(Aid::ReferencePosition).sqrt() * self.repeats(reference);
            let innovation = match reference.position_lasting_std {
                Some(lasting) => {
                    self.begin_to_carry(Carried::WithPosition);
                    let view = self.view();
                    reference_position::with_lasting_error(&view, &position, std, lasting)
                }
                None => reference_position::innovation(&self.view(), &position, std),
            };
            let aid = Aid::ReferencePosition;
            self.consult(aid, &innovation, rows::of_reference_position);
            let judged = self.gated(&innovation, self.withheld(aid));
            self.note(enter(report, reference.time, source, "reference_position", &judged));
        }
        if let Some(heading) = reference.heading {
            self.begin_to_carry(Carried::WithHeading);
            self.note_noise();
            let range = &self.config.floors.reference_heading;
            let stated = floored(reference.heading_std, range, "reference_heading", report);
            let std = stated * self.noise_of(Aid::Heading).sqrt();
            let innovation = reference_heading::innovation(&self.view(), heading, std);
            self.consult(Aid::Heading, &innovation, rows::of_heading);
            let judged = self.gated(&innovation, self.withheld(Aid::Heading));
            if enter(report, reference.time, source, "reference_heading", &judged)
                == Outcome::Accepted
            {
                self.heard.relative = Some(self.state.time);
            }
        }
    }

    /// By how much the sigma of a position is larger for what it shares with the ones before it: n positions within
    /// the time of their slow errors are worth one. That of the one before is taken note of.
    fn repeats(&mut self, reference: &ExternalReference) -> f64 {
        let before = self.heard.position.replace(reference.time);
        let apart = before.map_or(SHARED, |before| (reference.time - before).as_seconds());
        (2.0 * SHARED / apart.clamp(0.1, 2.0 * SHARED)).sqrt()
    }

    /// Why somebody is not used, if he is not.
    fn withheld(&self, aid: Aid) -> Option<Rejection> {
        self.withholds(aid).then_some(Rejection::SourceSuspect)
    }

    /// A lever arm that was found here, and not measured, makes noise as the ship turns.
    fn predict_log(&self, log: &LogVelocity) -> Prediction {
        let lever = self.config.lever_arms.log.0;
        let mut prediction =
            log_velocity::predict(&self.view(), log.reference, &lever, self.state.turn);
        if let Some(std) = self.installation.log_lever_std {
            let by_std = prediction.by_lever * Matrix3::from_diagonal(&std);
            prediction.swing_noise += by_std * by_std.transpose();
        }
        prediction
    }

    /// What a log that is not left out says of the lever arms, whether it is used or not; tells whether it is heard.
    fn hear_log(&mut self, weighed: Option<&Weighed>, by_lever: &DMatrix<f64>) -> bool {
        let is_left_out = self.docket().leaves_out(Aid::Log);
        let heard = self.installation.bias.as_mut().zip(weighed).filter(|_| !is_left_out);
        heard.map(|(bias, weighed)| bias.hear_log(weighed, by_lever)).is_some()
    }

    fn note_log(
        &mut self,
        log: &LogVelocity,
        outcome: Outcome,
        heard: Option<&Weighed>,
        by_lever: &DMatrix<f64>,
    ) {
        let used = heard.filter(|_| outcome == Outcome::Accepted);
        if let Some((bias, weighed)) = self.installation.bias.as_mut().zip(used) {
            bias.absorb_log(weighed, by_lever);
        }
        if outcome == Outcome::Accepted && log.reference == LogReference::Water {
            self.heard.water = Some(self.state.time);
        }
        self.note(outcome);
    }

    pub(super) fn note(&mut self, outcome: Outcome) {
        if outcome == Outcome::Accepted {
            self.heard.relative = Some(self.state.time);
            self.heard.motion = self.heard.relative;
        }
    }
}

/// Some rows of the effect of a lever arm.
fn by_rows(by_lever: &Matrix3<f64>, rows: &[usize]) -> DMatrix<f64> {
    DMatrix::from_fn(rows.len(), 3, |row, column| by_lever[(rows[row], column)])
}

fn floored(stated: Option<f64>, range: &Believable, aid: &'static str, report: &mut Report) -> f64 {
    let Floored { value, replaced } = floors::scalar(stated, range);
    if replaced {
        report.floored.push(aid);
    }
    value
}
