//! The camera's own geometry: where it is and looks, and where in the image a point is.

use insd_base::Body;
use insd_base::units::DEG;
use nalgebra::{Matrix3, Rotation3, Vector2, Vector3};

use super::axes::QuayAxes;
use crate::scenario::Camera;
use crate::track::Track;

/// The camera on the hull as it is, not as it is told.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rig<'a> {
    camera: &'a Camera,
    axes: &'a QuayAxes,
    track: &'a Track,
}

impl<'a> Rig<'a> {
    /// The camera of a ship on a track, before a quay.
    pub(super) fn new(camera: &'a Camera, axes: &'a QuayAxes, track: &'a Track) -> Self {
        Rig { camera, axes, track }
    }

    /// What the camera sees in the image that is said to be of time `t`, s.
    pub(super) fn view(&self, t: f64) -> View {
        let ship = self.track.at(t + self.camera.time_offset_s);
        let place = ship.at_lever(&Body(Vector3::from(self.camera.lever_arm_m))).0.0;
        let c_qb = self.axes.turn * ship.c_eb;
        View {
            place: self.axes.place(&place),
            c_qc: c_qb * mounting(self.camera, t),
            focal: self.camera.focal_px,
            size: self.camera.size_px.map(f64::from),
        }
    }
}

/// What the camera is said to be turned by: camera axes (right, down, along the optical axis) to body axes.
pub(super) fn told_mounting(camera: &Camera) -> Matrix3<f64> {
    let [bearing, below, roll] =
        [camera.bearing_deg, camera.down_deg, camera.roll_deg].map(|angle| (angle * DEG).sin_cos());
    let ahead = Vector3::new(bearing.1 * below.1, bearing.0 * below.1, below.0);
    let level = Vector3::new(-bearing.0, bearing.1, 0.0);
    let across = ahead.cross(&level);
    let right = level * roll.1 + across * roll.0;
    Matrix3::from_columns(&[right, ahead.cross(&right), ahead])
}

/// What it truly is at time `t`, s: with the installer's error, and the knocks that it has had.
pub(crate) fn mounting(camera: &Camera, t: f64) -> Matrix3<f64> {
    let knocks = camera.fault.iter().filter(|fault| fault.holds(t));
    let turns = [camera.mounting_error_deg].into_iter();
    let turns = turns.chain(knocks.filter_map(|fault| fault.mounting_knocked_deg));
    turns.fold(told_mounting(camera), |mounting, turn| {
        Rotation3::new(Vector3::from(turn) * DEG) * mounting
    })
}

/// The camera at one instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    /// Where it is, axes of the quay, m.
    pub(super) place: Vector3<f64>,
    /// Camera axes to those of the quay: its columns are right, down and along the optical axis.
    pub(super) c_qc: Matrix3<f64>,
    focal: f64,
    size: [f64; 2],
}

impl View {
    /// Where a point (axes of the quay, m) is seen, px from the corner, if it is within the image.
    pub(super) fn sees(&self, point: &Vector3<f64>) -> Option<Vector2<f64>> {
        let way = point - self.place;
        let depth = self.c_qc.column(2).dot(&way);
        if depth <= 0.1 {
            return None;
        }
        let along = |axis: usize| {
            self.size[axis] / 2.0 + self.focal * self.c_qc.column(axis).dot(&way) / depth
        };
        let at = Vector2::new(along(0), along(1));
        self.is_within(&at).then_some(at)
    }

    /// Whether a place is in the image.
    pub(super) fn is_within(&self, at: &Vector2<f64>) -> bool {
        (0.0..self.size[0]).contains(&at.x) && (0.0..self.size[1]).contains(&at.y)
    }

    /// The direction of a place in the image, axes of the quay; as long as it is one along the optical axis.
    pub(super) fn direction(&self, at: &Vector2<f64>) -> Vector3<f64> {
        let [right, down] = [0, 1].map(|axis| (at[axis] - self.size[axis] / 2.0) / self.focal);
        self.c_qc * Vector3::new(right, down, 1.0)
    }

    /// Width and height of the image, px.
    pub(super) fn size(&self) -> [f64; 2] {
        self.size
    }
}
