//! What is known of the rover's place before its epoch.

use nalgebra::{Matrix3, Vector3};

/// Where the rover may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoverPrior {
    /// ECEF, m.
    pub position: Vector3<f64>,
    /// Its covariance, m^2, as an inertial navigator or a carrier-phase prediction has it; `None`: no more than a place to begin at.
    pub covariance: Option<Matrix3<f64>>,
}

impl RoverPrior {
    /// Its information (m^-2) and how far it lies from a place, m.
    pub(super) fn information(&self, near: &Vector3<f64>) -> Option<(Matrix3<f64>, Vector3<f64>)> {
        let information = self.covariance?.try_inverse()?;
        information.iter().all(|x| x.is_finite()).then_some((information, self.position - near))
    }
}
