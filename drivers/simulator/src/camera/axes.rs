//! Axes of the quay.

use insd_base::earth::{c_ne, ecef};
use nalgebra::{Matrix3, Vector3};

use crate::scenario::ScenarioBerth;

/// Axes of the quay: along its edge with the water on the right, landward and up, from the first point of the edge at the water.
#[derive(Clone, Copy, Debug)]
pub(super) struct QuayAxes {
    origin: Vector3<f64>,
    /// ECEF axes to those of the quay.
    pub(super) turn: Matrix3<f64>,
    /// How long the edge is, m.
    pub(super) length: f64,
}

impl QuayAxes {
    /// Those of a berth, the water being so far above the ellipsoid, m.
    pub(super) fn new(berth: &ScenarioBerth, water: f64) -> Self {
        let [from, to] = berth.edge(water);
        let origin = ecef(&from).0;
        let way = ecef(&to).0 - origin;
        let up = -c_ne(&from).row(2).transpose();
        let along = (way - up * up.dot(&way)).normalize();
        let rows = [along, up.cross(&along), up].map(|axis| axis.transpose());
        QuayAxes { origin, turn: Matrix3::from_rows(&rows), length: way.norm() }
    }

    /// An ECEF position, m, in these axes.
    pub(super) fn place(&self, position: &Vector3<f64>) -> Vector3<f64> {
        self.turn * (position - self.origin)
    }

    /// Where a place in these axes, m, is in ECEF.
    pub(super) fn ecef(&self, place: &Vector3<f64>) -> Vector3<f64> {
        self.turn.tr_mul(place) + self.origin
    }
}
