//! What is known of an array before its epoch.

use nalgebra::{Matrix3, Vector3};

/// Where antennas are, how they move and point. Nothing of it goes into what is found but the choice of integers.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct CompassPrior {
    /// Where the antennas are, ECEF, m, to ten metres; without it codes tell.
    pub antenna: Option<Vector3<f64>>,
    /// How they move, ECEF axes, m/s: what receivers on clocks of their own moved by between the instants at which they sampled. 1 m/s is 1 mm for a millisecond.
    pub velocity: Option<Vector3<f64>>,
    /// How the hull stands.
    pub attitude: Option<AttitudePrior>,
    /// The turn since the epoch before as gyros tell it: from axes of the hull now to those then.
    pub turn: Option<Matrix3<f64>>,
}

/// An attitude and how well it is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AttitudePrior {
    /// Rotation from the hull's axes to north, east, down.
    pub c_nb: Matrix3<f64>,
    /// 1-sigma of the small rotations about north, east and down, rad: of a levelled IMU without a heading the last is infinite.
    pub std: Vector3<f64>,
}
