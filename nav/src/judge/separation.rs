//! What may be so, for protection levels.

use nalgebra::{Matrix3, Vector3};

/// Something that may be so, and what it makes of the place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Separation {
    /// What it is: the same fault that began at other instants is one cause.
    pub cause: usize,
    /// Chance that it is so within the exposure, by what is said.
    pub chance: f64,
    /// What the navigator's estimate lacks to what that would be, ECEF, m; and how fast that grows, m/s.
    pub apart: Vector3<f64>,
    /// Its growth, m/s.
    pub growth: Vector3<f64>,
    /// Covariance of the error of that estimate, ECEF, m^2.
    pub covariance: Matrix3<f64>,
    /// Of the error of its velocity, (m/s)^2.
    pub spreading: Matrix3<f64>,
}
