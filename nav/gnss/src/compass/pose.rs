//! How antennas stand to each other in the axes of north, east and down, and how that changes with what is sought.

use insd_base::attitude::skew;
use nalgebra::{Matrix3, Rotation3, Vector3};

use super::settings::CompassShape;

/// What is sought of an array.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CompassPose {
    /// Rotation from the hull's axes to north, east, down.
    Attitude(Matrix3<f64>),
    /// From the first antenna to the second: north, east, down, m.
    Baseline(Vector3<f64>),
}

impl CompassPose {
    /// Where an antenna stands, north, east, down, m, from a point that all share.
    pub(super) fn offset(&self, shape: &CompassShape, antenna: usize) -> Vector3<f64> {
        match (self, shape) {
            (Self::Attitude(c_nb), CompassShape::Body(levers)) => {
                // near the first, so that long arms to the point that they are counted from cost no digits
                levers.get(antenna).map_or_else(Vector3::zeros, |own| c_nb * (own - levers[0]))
            }
            (Self::Baseline(vector), _) if antenna == 1 => *vector,
            _ => Vector3::zeros(),
        }
    }

    /// How that changes: with a small rotation psi of true axes against assumed ones, `C = (I - [psi x]) C_assumed`, by `[C b x]`; with a baseline by itself.
    pub(super) fn jacobian(&self, shape: &CompassShape, antenna: usize) -> Matrix3<f64> {
        match self {
            Self::Attitude(_) => skew(&self.offset(shape, antenna)),
            Self::Baseline(_) if antenna == 1 => Matrix3::identity(),
            Self::Baseline(_) => Matrix3::zeros(),
        }
    }

    /// The pose that is off by an error that has been found.
    pub(super) fn corrected(&self, error: &Vector3<f64>) -> Self {
        match self {
            Self::Attitude(c_nb) => {
                Self::Attitude(Rotation3::from_scaled_axis(-error).into_inner() * c_nb)
            }
            Self::Baseline(vector) => Self::Baseline(vector + error),
        }
    }

    /// What has to be found of another to come to this: inverse of [`Self::corrected`].
    pub(super) fn error_of(&self, other: &Self) -> Vector3<f64> {
        match (self, other) {
            (Self::Attitude(own), Self::Attitude(other)) => {
                -Rotation3::from_matrix_unchecked(own * other.transpose()).scaled_axis()
            }
            (Self::Baseline(own), Self::Baseline(other)) => own - other,
            _ => Vector3::zeros(),
        }
    }

    /// How far the antennas of an array are from where they are in another pose, at the most, m.
    pub(super) fn apart(&self, other: &Self, shape: &CompassShape) -> f64 {
        let count = match shape {
            CompassShape::Body(levers) => levers.len(),
            CompassShape::Baseline { .. } => 2,
        };
        let off = |antenna| (self.offset(shape, antenna) - other.offset(shape, antenna)).norm();
        (0..count).map(off).fold(0.0, f64::max)
    }

    /// The array after it has turned: `turn` takes axes of the hull now to those before.
    pub(super) fn turned(&self, turn: &Matrix3<f64>) -> Self {
        match self {
            Self::Attitude(c_nb) => Self::Attitude(c_nb * turn),
            Self::Baseline(_) => *self,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::Attitude;

    fn square() -> CompassShape {
        let corner = |x: f64, y: f64| Vector3::new(-6.0 + x, -0.8 + y, -14.0);
        CompassShape::Body(vec![corner(0.05, -0.05), corner(0.05, 0.05), corner(-0.05, 0.05)])
    }

    #[test]
    fn what_antennas_move_by_is_what_the_jacobian_says() {
        let c_nb = Attitude { roll: 0.1, pitch: -0.2, heading: 4.0 }.c_nb();
        for pose in
            [CompassPose::Attitude(c_nb), CompassPose::Baseline(Vector3::new(0.3, -1.5, 0.1))]
        {
            for antenna in 0..3 {
                for axis in 0..3 {
                    let step = Vector3::ith(axis, 1e-6);
                    let moved = pose.corrected(&step).offset(&square(), antenna)
                        - pose.corrected(&-step).offset(&square(), antenna);
                    let expected = pose.jacobian(&square(), antenna) * step * 2.0;
                    assert!((moved - expected).norm() < 1e-11, "{moved} {expected}");
                }
            }
        }
    }

    #[test]
    fn an_error_that_is_corrected_is_found_again() {
        let pose = CompassPose::Attitude(Attitude { roll: 0.1, pitch: -0.2, heading: 4.0 }.c_nb());
        let error = Vector3::new(0.3, -0.2, 0.5);
        assert!((pose.corrected(&error).error_of(&pose) - error).norm() < 1e-12);
    }
}
