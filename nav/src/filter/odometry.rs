//! A visual odometry of another's making: the loose way of the berthing source (docs/systems.md, S4), beside which tracks are shown.
//!
//! Its errors of attitude and trajectory are random walks from keyframe to keyframe, so that they need no states over more than one of them: the pose at a keyframe
//! is cloned (Roumeliotis and Burdick, Stochastic cloning, ICRA 2002), and a step is measured from it. What several steps from one keyframe share is a state as long as that is the
//! keyframe. The scale is a state, and another one with each map.

use insd_base::{CameraTurn, Rejection, Source, VisualOdometry};
use nalgebra::{Matrix1, Matrix6, Matrix6x3, SMatrix};

use super::Filter;
use super::camera_standing::Tally;
use super::entry::{Judged, NO_INNOVATION, ODOMETRY_AID, detail, enter};
use super::odometry_standing::Odometry;
use crate::camera::sight::{Eye, Pose};
use crate::camera::step::{STEP_ROWS, StepTold, is_step, told};
use crate::camera::track::pose_now;
use crate::camera::window::Keyframe;
use crate::config::CameraAid;
use crate::declaration::Carried;
use crate::error_state::{
    ATTITUDE, CAMERA_AXES, CAMERA_DELAY, Innovation, Jacobian, ODOMETRY_POSES, POSE_STATES,
    POSITION, VO_ATTITUDE_DRIFT, VO_POSES, VO_SCALE, VO_TRAJECTORY_DRIFT,
};
use crate::report::{Outcome, Report};

/// Share of the variance of a step that all steps from one keyframe have in common: both images of a step are as good.
const KEYFRAME_SHARE: f64 = 0.5;
/// A scale below this is none.
const SMALLEST: f64 = 1e-3;

impl Filter {
    pub(super) fn apply_odometry(
        &mut self,
        step: &VisualOdometry,
        source: Source,
        report: &mut Report,
    ) {
        let judged = self.hear_step(step, report).unwrap_or_else(|reason| Judged {
            outcome: Outcome::Rejected(reason),
            log_likelihood: 0.0,
            innovation: NO_INNOVATION,
        });
        enter(report, step.time, source, ODOMETRY_AID, &judged);
    }

    fn hear_step(
        &mut self,
        step: &VisualOdometry,
        report: &mut Report,
    ) -> Result<Judged, Rejection> {
        let aid = self.config.camera.filter(|aid| aid.odometry.is_some());
        let Some(aid) = aid else { return Err(Rejection::NotUsable) };
        if !self.navigating || self.state.is_moored() {
            self.forget_camera();
            return Err(Rejection::NotUsable);
        }
        if !is_step(step) {
            return Err(Rejection::OutOfRange);
        }
        self.begin_to_follow(step, &aid)?;
        let keyframe = self.odometry.begin_of(step);
        let judged = keyframe.and_then(|from| self.take_step(&aid, &from, step));
        let slot = self.odometry.make_room(keyframe.as_ref());
        self.hold_pose(slot, step);
        let Some(judged) = judged else { return Err(Rejection::NotUsable) };
        self.note_standing(&judged, report);
        Ok(judged)
    }

    /// Its states join with the first step; another map has another scale.
    fn begin_to_follow(&mut self, step: &VisualOdometry, aid: &CameraAid) -> Result<(), Rejection> {
        if !self.state.covariance.has(VO_POSES) {
            self.forget_camera();
            self.carry_camera(Carried::WithOdometry);
        }
        let odometry = &mut self.odometry;
        odometry.heard = Some(self.state.time);
        let last = odometry.last.replace(*step);
        if odometry.map.replace(step.map) != Some(step.map) {
            self.begin_scale_anew(aid);
        }
        let same = |last: &VisualOdometry| {
            last.rotation == step.rotation && last.translation == step.translation
        };
        // an image that is shown again has no pose of its own
        let is_shown_again = step.translation.norm() == 0.0 && step.rotation.angle() == 0.0;
        let is_frozen = is_shown_again || last.is_some_and(|last| same(&last));
        if is_frozen { Err(Rejection::Frozen) } else { Ok(()) }
    }

    fn begin_scale_anew(&mut self, aid: &CameraAid) {
        let std = aid.odometry.unwrap_or_default().scale_std;
        self.state.nominal.vo_scale = 0.0;
        VO_SCALE.renew(&mut self.state.covariance, &Matrix1::new(std * std));
    }

    /// What all steps from one keyframe share is new with another one.
    fn begin_drift_anew(&mut self) {
        for block in [VO_ATTITUDE_DRIFT, VO_TRAJECTORY_DRIFT] {
            block.renew(&mut self.state.covariance, &SMatrix::identity());
        }
        self.state.nominal.vo_attitude_drift.fill(0.0);
        self.state.nominal.vo_trajectory_drift.fill(0.0);
    }

    /// Uses a step if it agrees; `None` if it cannot be weighed.
    fn take_step(
        &mut self,
        aid: &CameraAid,
        from: &Keyframe,
        step: &VisualOdometry,
    ) -> Option<Judged> {
        if self.odometry.keyframe != Some(from.slot) {
            self.begin_drift_anew();
        }
        let scale = 1.0 + self.state.nominal.vo_scale;
        // how far the poses matter is by the scale as this step itself has it
        let first = self.step_innovation(aid, from, step, scale).weigh(&self.state.covariance)?;
        let found = first.update(&mut self.state.covariance.clone()).of(VO_SCALE).x;
        let about = (scale + found).max(SMALLEST);
        let innovation = self.step_innovation(aid, from, step, about);
        let weighed = innovation.weigh(&self.state.covariance)?;
        let agrees = weighed.nis() <= self.gate.limit(weighed.rows()) && scale + found > SMALLEST;
        let log_likelihood = self.bounded_likelihood(&weighed);
        let outcome = match (agrees, self.odometry.standing.is_doubted()) {
            (true, false) => {
                self.absorb_sight(&weighed);
                Outcome::Accepted
            }
            (true, true) => Outcome::Rejected(Rejection::SourceSuspect),
            (false, _) => Outcome::Rejected(Rejection::ChiSquare),
        };
        Some(Judged { outcome, log_likelihood, innovation: detail(&weighed) })
    }

    fn step_innovation(
        &self,
        aid: &CameraAid,
        from: &Keyframe,
        step: &VisualOdometry,
        about: f64,
    ) -> Innovation {
        let nominal = &self.state.nominal;
        let eye = Eye::new(&aid.model, &nominal.camera_axes, nominal.camera_delay);
        let before = pose_now(from, nominal.vo_poses.as_slice());
        let now = Pose::of(&self.view());
        let mut told = told(&eye, [&before, &now], step, [1.0 + nominal.vo_scale, about]);
        let [way, turn] = shared(&told);
        told.z -= way * nominal.vo_trajectory_drift + turn * nominal.vo_attitude_drift;
        innovation(&told, from.slot)
    }

    /// Clones the pose of now.
    fn hold_pose(&mut self, slot: usize, step: &VisualOdometry) {
        let at = POSE_STATES * slot;
        let covariance = &mut self.state.covariance;
        covariance.clone_into(POSITION, VO_POSES.key(), at);
        covariance.clone_into(ATTITUDE, VO_POSES.key(), at + 3);
        self.state.nominal.vo_poses.fixed_rows_mut::<POSE_STATES>(at).fill(0.0);
        let first = Pose::of(&self.view());
        self.odometry.hold(slot, step.time, first);
    }

    fn note_standing(&mut self, judged: &Judged, report: &mut Report) {
        let contradicts = judged.outcome == Outcome::Rejected(Rejection::ChiSquare);
        let is_used = judged.outcome == Outcome::Accepted;
        let tally = Tally { asked: 1, refused: usize::from(contradicts), is_used };
        let now = self.state.time;
        let turn = self.odometry.standing.hear(now, true, &tally);
        if let Some(aid) = self.config.camera.filter(|_| turn == Some(CameraTurn::Doubtful)) {
            let Odometry { map, last, heard, standing, .. } = self.odometry;
            self.odometry = Odometry { map, last, heard, standing, ..Odometry::default() };
            self.begin_scale_anew(&aid);
        }
        report.camera.extend(turn.map(|turn| (now, turn)));
    }
}

/// What way and turn are off by in common with all others from their keyframe, by the drift of trajectory and attitude.
fn shared(told: &StepTold) -> [Matrix6x3<f64>; 2] {
    let share = told.sigma * KEYFRAME_SHARE.sqrt();
    [0, 3].map(|first| {
        Matrix6x3::from_fn(|row, axis| if row == first + axis { share[row] } else { 0.0 })
    })
}

fn innovation(told: &StepTold, slot: usize) -> Innovation {
    let mut by_poses = SMatrix::<f64, STEP_ROWS, { POSE_STATES * ODOMETRY_POSES }>::zeros();
    by_poses.fixed_columns_mut::<POSE_STATES>(POSE_STATES * slot).copy_from(&told.by_before);
    let [way, turn] = shared(told);
    let h = Jacobian::none(STEP_ROWS)
        .with(POSITION, &told.by_now.fixed_columns::<3>(0).into_owned())
        .with(ATTITUDE, &told.by_now.fixed_columns::<3>(3).into_owned())
        .with(CAMERA_AXES, &told.by_axes)
        .with(CAMERA_DELAY, &told.by_delay)
        .with(VO_POSES, &by_poses)
        .with(VO_SCALE, &told.by_scale)
        .with(VO_TRAJECTORY_DRIFT, &way)
        .with(VO_ATTITUDE_DRIFT, &turn);
    let own = told.sigma.component_mul(&told.sigma) * (1.0 - KEYFRAME_SHARE);
    Innovation::new(&told.z, h, &Matrix6::from_diagonal(&own))
}
