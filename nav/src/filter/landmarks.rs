//! Points that stay in sight for long are states: a hovering ship is held by what she has seen since she came.
//!
//! A track that has just been used and is still in sight has three rows left, which tell where its point is (Geneva et al., OpenVINS, ICRA 2020,
//! section III-D): r = H x + R df + n, so that df = R^-1 (r - H x - n).

use insd_base::ImagePoint;
use nalgebra::{DMatrix, SMatrix, Vector2, Vector3};

use super::Filter;
use super::camera_standing::{Landmark, Tally};
use crate::camera::sight::{Eye, Pose};
use crate::camera::track::landmark_now;
use crate::camera::window::Track;
use crate::error_state::{
    ATTITUDE, CAMERA_AXES, CAMERA_DELAY, Errors, Innovation, Jacobian, LANDMARK_POINTS, LANDMARKS,
    POSITION,
};

/// Rays to a landmark differ by as much at least when it becomes one, rad.
const PARALLAX: f64 = 1.5 * std::f64::consts::PI / 180.0;
/// A camera of which it is less sure how it sits, 1-sigma, rad, has none: a point is held for longer than its first look is right to the first order.
const UNSURE: f64 = 0.004;
/// One that contradicts so often in a row is not at rest.
const MOVES: u8 = 4;

impl Filter {
    /// Uses those that are in sight; the others are not landmarks any longer.
    pub(super) fn see_landmarks(&mut self, eye: &Eye, points: &[ImagePoint], tally: &mut Tally) {
        let (mut slots, mut all) = (Vec::new(), Vec::new());
        let pose = Pose::of(&self.view());
        for slot in 0..LANDMARKS {
            let Some(own) = self.camera.landmarks[slot] else { continue };
            let seen = points.iter().find(|point| point.track == own.id);
            let row = seen.and_then(|point| self.landmark_row(eye, &pose, (slot, &own), &point.at));
            match row {
                Some(row) => {
                    slots.push(slot);
                    all.push(row);
                }
                None => self.drop_landmark(slot),
            }
        }
        if all.is_empty() {
            return;
        }
        let together = Innovation::stacked(all.iter());
        let Some(weighed) = together.weigh(&self.state.covariance) else { return };
        let s = weighed.covariance();
        let agrees = |index: &usize| {
            let own = s.fixed_view::<2, 2>(2 * index, 2 * index).into_owned();
            let z = Vector2::new(together.z[2 * index], together.z[2 * index + 1]);
            own.cholesky().is_some_and(|own| z.dot(&own.solve(&z)) < self.gate.limit(2))
        };
        let good: Vec<usize> = (0..slots.len()).filter(agrees).collect();
        tally.asked += slots.len();
        tally.refused += slots.len() - good.len();
        self.note_contradictions(&slots, &good);
        if 3 * good.len() <= slots.len() || self.camera.standing.is_doubted() {
            return;
        }
        let rows: Vec<usize> = good.iter().flat_map(|index| [2 * index, 2 * index + 1]).collect();
        if let Some(weighed) = together.select(&rows).weigh(&self.state.covariance) {
            self.absorb_sight(&weighed);
            tally.is_used = true;
        }
    }

    fn note_contradictions(&mut self, slots: &[usize], good: &[usize]) {
        for (index, slot) in slots.iter().enumerate() {
            let is_good = good.contains(&index);
            let Some(own) = &mut self.camera_mut().landmarks[*slot] else { continue };
            own.contradicted = if is_good { 0 } else { own.contradicted + 1 };
            if own.contradicted >= MOVES {
                self.drop_landmark(*slot);
            }
        }
    }

    fn landmark_row(
        &self,
        eye: &Eye,
        pose: &Pose,
        (slot, own): (usize, &Landmark),
        at: &Vector2<f64>,
    ) -> Option<Innovation> {
        let point = landmark_now(&own.first, slot, self.state.nominal.landmarks.as_slice());
        let sight = eye.sight(pose, &point)?;
        let mut by_points = SMatrix::<f64, 2, { 3 * LANDMARKS }>::zeros();
        by_points.fixed_columns_mut::<3>(3 * slot).copy_from(&sight.by_point);
        let h = Jacobian::none(2)
            .with(POSITION, &sight.by_pose.fixed_columns::<3>(0).into_owned())
            .with(ATTITUDE, &sight.by_pose.fixed_columns::<3>(3).into_owned())
            .with(CAMERA_AXES, &sight.by_axes)
            .with(CAMERA_DELAY, &sight.by_delay)
            .with(LANDMARK_POINTS, &by_points);
        let variance = eye.model().pixel_std * eye.model().pixel_std;
        Some(Innovation::new(
            &(at - sight.at),
            h,
            &SMatrix::<f64, 2, 2>::from_diagonal_element(variance),
        ))
    }

    /// What was seen of it is not linked with what is seen later.
    pub(super) fn drop_landmark(&mut self, slot: usize) {
        self.camera_mut().landmarks[slot] = None;
        self.state.nominal.landmarks.fixed_rows_mut::<3>(3 * slot).fill(0.0);
        for state in 3 * slot..3 * slot + 3 {
            self.state.covariance.renew_state(LANDMARK_POINTS.key(), state, 0.0);
        }
    }

    /// Points of tracks that agreed and are still in sight become landmarks, as long as there are places.
    pub(super) fn promote(&mut self, eye: &Eye, good: &[u64], due: &[Track]) {
        if CAMERA_AXES.std(&self.state.covariance) > UNSURE {
            return;
        }
        for track in due.iter().filter(|track| track.is_in_sight && good.contains(&track.id)) {
            let Some(slot) = self.camera.landmarks.iter().position(Option::is_none) else { return };
            self.promote_to(eye, track, slot);
        }
    }

    fn promote_to(&mut self, eye: &Eye, track: &Track, slot: usize) {
        // the poses have been corrected since
        let Ok(told) = self.told(eye, track, &Errors::none()) else { return };
        let Some(inverse) = told.by_point.try_inverse() else { return };
        if told.found.parallax < PARALLAX {
            return;
        }
        let states = self.track_states();
        let p = self.state.covariance.matrix();
        let mut carried = DMatrix::zeros(3, p.nrows());
        for (column, state) in states.iter().enumerate() {
            for row in 0..3 {
                let by = told.of_point.h[(row, column)];
                if by != 0.0 {
                    let mut own = carried.row_mut(row);
                    own += p.row(*state) * by;
                }
            }
        }
        let of_columns = DMatrix::from_fn(3, states.len(), |i, j| carried[(i, states[j])]);
        let own = of_columns * told.of_point.h.transpose() + DMatrix::identity(3, 3);
        let solve = DMatrix::from_column_slice(3, 3, inverse.as_slice());
        let cross = -(&solve * carried);
        let own = &solve * own * solve.transpose();
        self.state.covariance.replace(LANDMARK_POINTS.key(), 3 * slot, &cross, &own);
        self.state.nominal.landmarks.fixed_rows_mut::<3>(3 * slot).fill(0.0);
        let z = Vector3::from_column_slice(told.of_point.z.as_slice());
        let first = told.found.point + inverse * z;
        self.camera_mut().landmarks[slot] = Some(Landmark { id: track.id, first, contradicted: 0 });
    }
}
