//! What a track tells of the poses from which it was seen.
//!
//! r = H_x dx + H_f df + n. With the left null space N of H_f, N^T r = N^T H_x dx + N^T n tells of the poses alone (Mourikis and Roumeliotis 2007,
//! eqs. (20)-(24)); the three other rows tell where the point is. Rows of many tracks are as good as R of their QR (eqs. (26)-(29)).

use nalgebra::{DMatrix, DVector, Matrix3, Vector2, Vector3};

use super::sight::{Eye, PointSight, Pose};
use super::triangulation::{Placed, Triangulated, Unfound, triangulate};
use super::window::{Keyframe, Track};
use crate::error_state::{CAMERA_POSES, POSE_STATES};

/// Columns of what tracks tell: poses, how the camera sits, its delay.
pub const COLUMNS: usize = POSE_STATES * CAMERA_POSES + 4;
/// Where how the camera sits, and its delay, stand among them.
pub const AXES_AT: usize = POSE_STATES * CAMERA_POSES;
/// The delay.
pub const DELAY_AT: usize = AXES_AT + 3;

/// Rows in units of the sigma of an image point.
#[derive(Clone, Debug, PartialEq)]
pub struct TrackRows {
    /// Measured less predicted.
    pub z: DVector<f64>,
    /// By [`COLUMNS`].
    pub h: DMatrix<f64>,
}

/// What a track tells.
#[derive(Clone, Debug, PartialEq)]
pub struct TrackTold {
    /// Which track.
    pub id: u64,
    /// Where its point is.
    pub found: Triangulated,
    /// Of the poses alone.
    pub of_poses: TrackRows,
    /// Of the point, three rows: `of_point.z = of_point.h x + by_point df`.
    pub of_point: TrackRows,
    /// Upper triangular.
    pub by_point: Matrix3<f64>,
}

/// What a track tells whose poses, as they are estimated now, `pose` gives.
///
/// # Errors
/// Why that is nothing.
pub fn told(
    eye: &Eye,
    track: &Track,
    pose: impl Fn(usize) -> Option<Pose>,
) -> Result<TrackTold, Unfound> {
    let poses: Vec<(usize, Pose)> =
        track.seen.iter().filter_map(|(slot, _)| Some((*slot, pose(*slot)?))).collect();
    if poses.len() != track.seen.len() {
        return Err(Unfound::Untold);
    }
    let placed = poses.iter().zip(&track.seen).map(|((_, pose), (_, at))| {
        let (centre, c_ce) = eye.placed(pose);
        (centre, c_ce, *at)
    });
    let placed: Vec<Placed> = placed.collect();
    let found = triangulate(eye.model(), &placed)?;
    let sights = found.by.iter().map(|index| {
        let (slot, pose) = &poses[*index];
        Some((*slot, track.seen[*index].1, eye.sight(pose, &found.point)?))
    });
    let sights: Option<Vec<Sighting>> = sights.collect();
    let sights = sights.ok_or(Unfound::Untold)?;
    Ok(projected(eye, track.id, &sights, found))
}

/// From which pose a point was seen where, and what was expected.
type Sighting = (usize, Vector2<f64>, PointSight);

fn projected(eye: &Eye, id: u64, sights: &[Sighting], found: Triangulated) -> TrackTold {
    let rows = 2 * sights.len();
    let by = 1.0 / eye.model().pixel_std;
    let mut by_point = DMatrix::zeros(rows, 3);
    // the innovation stands behind the columns
    let mut all = DMatrix::zeros(rows, COLUMNS + 1);
    for (index, (slot, at, sight)) in sights.iter().enumerate() {
        let row = 2 * index;
        by_point.fixed_view_mut::<2, 3>(row, 0).copy_from(&(sight.by_point * by));
        let at_pose = POSE_STATES * slot;
        all.fixed_view_mut::<2, POSE_STATES>(row, at_pose).copy_from(&(sight.by_pose * by));
        all.fixed_view_mut::<2, 3>(row, AXES_AT).copy_from(&(sight.by_axes * by));
        all.fixed_view_mut::<2, 1>(row, DELAY_AT).copy_from(&(sight.by_delay * by));
        all.fixed_view_mut::<2, 1>(row, COLUMNS).copy_from(&((at - sight.at) * by));
    }
    let qr = by_point.qr();
    qr.q_tr_mul(&mut all);
    let part = |first: usize, count: usize| TrackRows {
        z: all.view((first, COLUMNS), (count, 1)).column(0).into_owned(),
        h: all.view((first, 0), (count, COLUMNS)).into_owned(),
    };
    let r = qr.r();
    TrackTold {
        id,
        found,
        of_poses: part(3, rows - 3),
        of_point: part(0, 3),
        by_point: Matrix3::from_fn(|i, j| r[(i, j)]),
    }
}

impl TrackRows {
    /// The same as an innovation of an estimate that is off from it by errors of the columns.
    #[must_use]
    pub fn beyond(mut self, errors: &DVector<f64>) -> Self {
        self.z += &self.h * errors;
        self
    }

    /// Normalised square of the innovation, with this covariance of the columns.
    #[must_use]
    pub fn square(&self, covariance: &DMatrix<f64>) -> Option<f64> {
        let rows = self.z.len();
        let s = &self.h * covariance * self.h.transpose() + DMatrix::identity(rows, rows);
        let factor = ((&s + s.transpose()) * 0.5).cholesky()?;
        let mut white = self.z.clone();
        factor.l_dirty().solve_lower_triangular_mut(&mut white);
        Some(white.norm_squared())
    }

    /// All below each other, and no more of them than columns.
    #[must_use]
    pub fn compressed<'a>(all: impl Iterator<Item = &'a TrackRows> + Clone) -> Self {
        let rows = all.clone().map(|own| own.z.len()).sum();
        let mut stack = DMatrix::zeros(rows, COLUMNS);
        let mut z = DVector::zeros(rows);
        let mut first = 0;
        for own in all {
            let count = own.z.len();
            stack.rows_mut(first, count).copy_from(&own.h);
            z.rows_mut(first, count).copy_from(&own.z);
            first += count;
        }
        if rows <= COLUMNS {
            return TrackRows { z, h: stack };
        }
        let qr = stack.qr();
        qr.q_tr_mul(&mut z);
        TrackRows { z: z.rows(0, COLUMNS).into_owned(), h: qr.r() }
    }
}

/// A pose as it is estimated now.
#[must_use]
pub fn pose_now(own: &Keyframe, corrections: &[f64]) -> Pose {
    let at = POSE_STATES * own.slot;
    own.first.corrected(&nalgebra::SVector::from_column_slice(&corrections[at..at + POSE_STATES]))
}

/// Where a landmark is that was first estimated there, after its correction.
#[must_use]
pub fn landmark_now(first: &Vector3<f64>, slot: usize, corrections: &[f64]) -> Vector3<f64> {
    first + Vector3::from_column_slice(&corrections[3 * slot..3 * slot + 3])
}
