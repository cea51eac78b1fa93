//! What the heave filter is told.

use insd_base::Time;
use nalgebra::Vector3;

/// A step of the IMU's vertical motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VerticalStep {
    /// Its end.
    pub to: Time,
    /// Its length, s.
    pub duration: f64,
    /// Increment of the IMU's upward velocity, m/s: gravity, Coriolis and the estimated errors of the
    /// accelerometers removed, free of the filter's corrections.
    pub velocity: f64,
    /// Direction of down in body axes at the end of the step: the third row of C_nb.
    pub down_b: Vector3<f64>,
}
