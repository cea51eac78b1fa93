//! A camera: images come, poses are cloned, tracks are used when they end or when the oldest pose leaves.
//!
//! Points are taken to be at rest. What contradicts that is refused track by track, and a camera of which most is refused is not used at all.

use std::sync::Arc;

use insd_base::{CameraFrame, CameraModel, CameraTurn, ImagePoint, Rejection, Source};
use nalgebra::{DMatrix, DVector, Matrix3};

use super::Filter;
use super::camera_standing::{Camera, FEWEST_POINTS, Tally};
use super::entry::{CAMERA_AID, Judged, NO_INNOVATION, enter};
use super::odometry_standing::Odometry;
use crate::camera::sight::{Eye, Pose};
use crate::camera::track::{AXES_AT, COLUMNS, DELAY_AT, TrackRows, TrackTold, pose_now, told};
use crate::camera::triangulation::{FEWEST, Unfound};
use crate::camera::window::{Keyframe, Leaving, PoseWindow, Track};
use crate::declaration::Carried;
use crate::error_state::carried;
use crate::error_state::{
    ATTITUDE, CAMERA_AXES, CAMERA_DELAY, CAMERA_POSES, Errors, Innovation, Jacobian, LANDMARKS,
    POSE_STATES, POSES, POSITION, Weighed,
};
use crate::report::{Outcome, Report};
use crate::symmetry::keep_scene_unknown;

/// After so long without an image, s, what was seen before is not linked with what is seen now.
const BROKEN: f64 = 5.0;
/// Looks at tracks again and again at most, and what is worth another look: poses that move so far, m, or a camera that turns so far, rad.
const ITERATIONS: usize = 5;
const FAR: f64 = 0.01;
const FAR_TURNED: f64 = 5e-4;
/// After so long, s, a camera has no states any more.
const SILENT: f64 = 60.0;

impl Filter {
    pub(super) fn apply_camera(
        &mut self,
        frame: &Arc<CameraFrame>,
        source: Source,
        report: &mut Report,
    ) {
        let outcome = match self.look_at(frame, report) {
            Ok(tally) if tally.is_used => Outcome::Accepted,
            Ok(tally) if tally.refused > 0 => Outcome::Rejected(Rejection::ChiSquare),
            // a track tells when it ends
            Ok(_) => return,
            Err(reason) => Outcome::Rejected(reason),
        };
        let judged = Judged { outcome, log_likelihood: 0.0, innovation: NO_INNOVATION };
        enter(report, frame.time, source, CAMERA_AID, &judged);
    }

    fn look_at(
        &mut self,
        frame: &Arc<CameraFrame>,
        report: &mut Report,
    ) -> Result<Tally, Rejection> {
        let aid = self.config.camera.filter(|aid| aid.odometry.is_none());
        let Some(aid) = aid else { return Err(Rejection::NotUsable) };
        if !self.navigating || self.state.is_moored() {
            self.forget_camera();
            return Err(Rejection::NotUsable);
        }
        let points = seen_by(&aid.model, frame)?;
        self.begin_to_see(frame)?;
        let mut tally = Tally::default();
        let is_lit = points.len() >= FEWEST_POINTS;
        self.see_landmarks(&self.eye(&aid.model), &points, &mut tally);
        self.use_tracks(&aid.model, &points, &mut tally);
        let now = self.state.time;
        let turn = self.camera_mut().standing.hear(now, is_lit, &tally);
        if turn == Some(CameraTurn::Doubtful) {
            self.begin_scene_anew();
        }
        report.camera.extend(turn.map(|turn| (now, turn)));
        Ok(tally)
    }

    /// The camera as it is estimated to sit. What a linear filter leaves out of an unsure turn of it is like noise of its points: half the square of
    /// the turn, and all of it, as it is the same for all of them.
    fn eye(&self, model: &CameraModel) -> Eye {
        let (p, nominal) = (&self.state.covariance, &self.state.nominal);
        let c_eb = nominal.c_eb();
        let (axes, attitude) = (CAMERA_AXES.covariance_in(p, &c_eb), ATTITUDE.covariance(p));
        let both = c_eb * CAMERA_AXES.covariance_with(ATTITUDE, p);
        let turn = (axes + attitude + both + both.transpose()).trace().max(0.0);
        let bent = model.focal.max() * turn;
        let model = CameraModel { pixel_std: model.pixel_std.hypot(bent), ..*model };
        Eye::new(&model, &nominal.camera_axes, nominal.camera_delay)
    }

    pub(super) fn camera_mut(&mut self) -> &mut Camera {
        Arc::make_mut(&mut self.camera)
    }

    /// Its states join with the first image; where it was not heard for a while, or the estimate has become another, what it sees is new.
    fn begin_to_see(&mut self, frame: &Arc<CameraFrame>) -> Result<(), Rejection> {
        let last = self.camera_mut().last.replace(Arc::clone(frame));
        let gap = last.as_ref().map(|last| (frame.time - last.time).as_seconds());
        if !self.state.covariance.has(POSES) {
            self.forget_camera();
            self.camera_mut().last = Some(Arc::clone(frame));
            self.carry_camera(Carried::WithTracks);
        } else if gap.is_some_and(|gap| gap > BROKEN) {
            self.begin_scene_anew();
        }
        let is_frozen =
            last.is_some_and(|last| !frame.points.is_empty() && last.points == frame.points);
        if is_frozen { Err(Rejection::Frozen) } else { Ok(()) }
    }

    /// The states of what is made of a camera join, and those of the camera.
    pub(super) fn carry_camera(&mut self, when: Carried) {
        let config = self.config;
        carried(when)
            .chain(carried(Carried::WithCamera))
            .for_each(|own| own.join(&mut self.state.covariance, &config));
    }

    /// Once no camera is heard for a while its states are not carried any longer.
    pub(super) fn forget_silent_camera(&mut self) {
        let heard = self.camera.last.as_ref().map(|frame| frame.time).or(self.odometry.heard);
        if heard.is_some_and(|heard| (self.state.time - heard).as_seconds() > SILENT) {
            self.forget_camera();
        }
    }

    /// Nothing that was seen so far is linked with what will be.
    fn begin_scene_anew(&mut self) {
        if !self.state.covariance.has(POSES) {
            return;
        }
        let camera = self.camera_mut();
        camera.window = PoseWindow::default();
        for slot in 0..LANDMARKS {
            self.drop_landmark(slot);
        }
    }

    /// The place is given up, and as unsure as `covariance` from now on, m^2, ECEF axes.
    pub(super) fn renew_place(&mut self, covariance: &Matrix3<f64>) {
        POSITION.renew(&mut self.state.covariance, covariance);
        self.part_with_past();
    }

    /// Place or attitude are less sure than they were before: through what is seen, poses and points of before would bring back what was given up.
    pub(super) fn part_with_past(&mut self) {
        self.begin_scene_anew();
        self.odometry.give_up_poses();
    }

    pub(super) fn forget_camera(&mut self) {
        if self.camera.last.is_some() || self.state.covariance.has(CAMERA_AXES) {
            self.camera = Arc::default();
            self.odometry = Odometry::default();
            [Carried::WithTracks, Carried::WithCamera, Carried::WithOdometry]
                .into_iter()
                .for_each(|when| self.end_to_carry(when));
        }
    }

    /// Uses tracks that have ended, and those that were seen from a pose that leaves; then the pose of this image joins.
    fn use_tracks(&mut self, model: &CameraModel, points: &[ImagePoint], tally: &mut Tally) {
        let leaving = self.camera.window.gives_way(model);
        let window = &mut self.camera_mut().window;
        for track in &mut window.tracks {
            track.is_in_sight = points.iter().any(|point| point.track == track.id);
        }
        let (due, kept): (Vec<Track>, Vec<Track>) = std::mem::take(&mut window.tracks)
            .into_iter()
            .partition(|track| is_due(track, leaving));
        window.tracks = kept;
        window.tracks.retain(|track| track.is_in_sight);
        let good = self.use_due(&self.eye(model), &due, tally);
        // which may sit otherwise than before
        self.promote(&self.eye(model), &good, &due);
        let landmarks = self.camera.landmarks;
        let is_landmark = |id: u64| landmarks.iter().flatten().any(|own| own.id == id);
        let again = due.into_iter().filter(|own| own.is_in_sight && !is_landmark(own.id));
        let window = &mut self.camera_mut().window;
        window.tracks.extend(again.map(|track| Track { seen: Vec::new(), ..track }));
        if let Some(Leaving::Newest(slot) | Leaving::Oldest(slot)) = leaving {
            window.leave(slot);
        }
        self.keep_pose(points);
    }

    /// Clones the pose of now.
    fn keep_pose(&mut self, points: &[ImagePoint]) {
        let (time, first) = (self.state.time, Pose::of(&self.view()));
        let Some(slot) = self.camera.window.free() else { return };
        let at = POSE_STATES * slot;
        let covariance = &mut self.state.covariance;
        covariance.clone_into(POSITION, POSES.key(), at);
        covariance.clone_into(ATTITUDE, POSES.key(), at + 3);
        self.state.nominal.poses.fixed_rows_mut::<POSE_STATES>(at).fill(0.0);
        let camera = self.camera_mut();
        camera.window.poses.push(Keyframe { slot, time, first });
        let landmarks = camera.landmarks;
        let is_landmark = |id: u64| landmarks.iter().flatten().any(|own| own.id == id);
        camera.window.see(slot, points.iter().filter(|point| !is_landmark(point.track)));
    }

    /// Uses tracks that agree; returns which did.
    fn use_due(&mut self, eye: &Eye, due: &[Track], tally: &mut Tally) -> Vec<u64> {
        let none = Errors::none();
        let all: Vec<_> = due.iter().map(|track| self.told(eye, track, &none)).collect();
        let is_lost = |told: &&Result<TrackTold, Unfound>| **told == Err(Unfound::Contradictory);
        let lost = all.iter().filter(is_lost).count();
        let all: Vec<TrackTold> = all.into_iter().flatten().collect();
        let columns = self.track_covariance();
        let agrees = |told: &&TrackTold| {
            let rows = told.of_poses.z.len();
            let square = told.of_poses.square(&columns);
            square.is_some_and(|square| square < self.gate.limit(rows))
        };
        let good: Vec<&TrackTold> = all.iter().filter(agrees).collect();
        let asked = all.len() + lost;
        tally.asked += asked;
        tally.refused += asked - good.len();
        // where so many contradict, the others agree by chance
        if good.is_empty() || 3 * good.len() <= asked || self.camera.standing.is_doubted() {
            return Vec::new();
        }
        let rows = TrackRows::compressed(good.iter().map(|told| &told.of_poses));
        let good: Vec<u64> = good.iter().map(|told| told.id).collect();
        let due: Vec<&Track> = due.iter().filter(|track| good.contains(&track.id)).collect();
        tally.is_used = self.absorb_tracks(eye, &due, rows).is_some();
        good
    }

    /// Brings in what tracks tell. Where it moves poses and camera so far that they would see their points otherwise, it is looked at from there again:
    /// the iterated filter (Bell and Cathey, IEEE Trans. Automatic Control 38 (1993)).
    fn absorb_tracks(&mut self, eye: &Eye, due: &[&Track], first: TrackRows) -> Option<()> {
        let (mut rows, mut error) = (first, Errors::none());
        let c_eb = self.state.nominal.c_eb();
        for _ in 0..ITERATIONS {
            let mut covariance = self.state.covariance.clone();
            keep_scene_unknown(&mut covariance, &error, &c_eb);
            let found = innovation(&rows).weigh(&covariance)?.update(&mut covariance);
            let mut step = found.clone();
            step -= &error;
            error = found;
            if !is_far(&step) {
                keep_scene_unknown(&mut covariance, &step, &c_eb);
                self.state.covariance = covariance;
                self.state.take_on(&error);
                self.court.owed += &error;
                return Some(());
            }
            let moved = due.iter().map(|track| self.told(eye, track, &error));
            let moved: Vec<TrackTold> = moved.flatten().collect();
            let columns = self.columns_of(&error);
            let all: Vec<TrackRows> =
                moved.into_iter().map(|told| told.of_poses.beyond(&columns)).collect();
            rows = TrackRows::compressed(all.iter());
        }
        None
    }

    fn columns_of(&self, error: &Errors) -> DVector<f64> {
        let states = self.track_states();
        DVector::from_fn(COLUMNS, |column, _| error.values()[states[column]])
    }

    /// What a track tells of the poses as they are estimated now, or after an error was taken on.
    pub(super) fn told(
        &self,
        eye: &Eye,
        track: &Track,
        error: &Errors,
    ) -> Result<TrackTold, Unfound> {
        let corrections = self.state.nominal.poses + error.of(POSES);
        let eye = eye.moved(&error.of(CAMERA_AXES), error.of(CAMERA_DELAY).x);
        let pose =
            |slot: usize| Some(pose_now(self.camera.window.pose(slot)?, corrections.as_slice()));
        told(&eye, track, pose)
    }

    /// Indices of the columns of what tracks tell, among all states.
    pub(super) fn track_states(&self) -> Vec<usize> {
        let layout = self.state.covariance.layout();
        let start = |key| layout.start(key).unwrap_or_default();
        let poses = start(POSES.key());
        let (axes, delay) = (start(CAMERA_AXES.key()), start(CAMERA_DELAY.key()));
        (poses..poses + AXES_AT).chain(axes..axes + 3).chain([delay]).collect()
    }

    fn track_covariance(&self) -> DMatrix<f64> {
        let states = self.track_states();
        let p = self.state.covariance.matrix();
        DMatrix::from_fn(COLUMNS, COLUMNS, |i, j| p[(states[i], states[j])])
    }

    /// Brings in how landmarks are seen. A camera sees no place on the Earth and no north, and where the antenna sits is nothing to it.
    pub(super) fn absorb_sight(&mut self, weighed: &Weighed) {
        let error: Errors = self.state.absorb(weighed);
        let c_eb = self.state.nominal.c_eb();
        keep_scene_unknown(&mut self.state.covariance, &error, &c_eb);
        self.court.owed += &error;
    }
}

/// The points of an image that a camera can have seen, each track once; most of another camera's are not.
fn seen_by(model: &CameraModel, frame: &CameraFrame) -> Result<Vec<ImagePoint>, Rejection> {
    let sound = frame.points.iter().filter(|point| model.sees(&point.at));
    let mut points: Vec<ImagePoint> = sound.copied().collect();
    if 2 * points.len() < frame.points.len() {
        return Err(Rejection::OutOfRange);
    }
    points.sort_by_key(|point| point.track);
    points.dedup_by_key(|point| point.track);
    Ok(points)
}

/// Whether a track is to be used now.
fn is_due(track: &Track, leaving: Option<Leaving>) -> bool {
    let is_leaving = match leaving {
        Some(Leaving::Oldest(oldest)) => track.seen.iter().any(|(slot, _)| *slot == oldest),
        _ => false,
    };
    track.seen.len() >= FEWEST && (!track.is_in_sight || is_leaving)
}

/// Whether points would be seen otherwise after such an error was taken on.
fn is_far(error: &Errors) -> bool {
    let poses = error.of(POSES);
    let own = |slot: usize| poses.fixed_rows::<3>(POSE_STATES * slot).into_owned();
    let moved = (1..CAMERA_POSES).map(|slot| (own(slot) - own(0)).norm());
    moved.fold(0.0, f64::max) > FAR || error.of(CAMERA_AXES).norm() > FAR_TURNED
}

fn innovation(rows: &TrackRows) -> Innovation {
    let count = rows.z.len();
    let mut h = Jacobian::none(count);
    h.set_columns(POSES.key(), &rows.h.columns(0, AXES_AT).into_owned());
    h.set_columns(CAMERA_AXES.key(), &rows.h.columns(AXES_AT, 3).into_owned());
    h.set_columns(CAMERA_DELAY.key(), &rows.h.columns(DELAY_AT, 1).into_owned());
    Innovation { z: rows.z.clone(), h, r: DMatrix::identity(count, count) }
}
