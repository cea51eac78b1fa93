//! Where the alignment begins.

use insd_base::Geodetic;
use nalgebra::Vector3;

/// Where and how fast the ship is when the bank starts, with 1-sigma errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kinematics {
    /// Position of the IMU.
    pub position: Geodetic,
    /// Of each component of the position, m.
    pub position_std: f64,
    /// Velocity, NED, m/s.
    pub velocity: Vector3<f64>,
    /// Of each component of the velocity, m/s.
    pub velocity_std: f64,
    /// Mean acceleration over the levelling window, NED, m/s^2.
    pub acceleration: Vector3<f64>,
    /// Whether the ship is known to lie at her berth.
    pub moored: bool,
    /// Whether a receiver tells her position.
    pub gnss_position: bool,
    /// Whether it tells her velocity as well.
    pub gnss_velocity: bool,
}
