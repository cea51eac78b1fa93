//! From the attitude of a ship to what it means for her camera.

use insd_base::Attitude;
use nalgebra::{Rotation3, Unit, UnitQuaternion, Vector3};

/// How a camera is held in the world at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraAttitude {
    /// From camera axes to north, east, down.
    c_nc: UnitQuaternion<f64>,
}

impl CameraAttitude {
    /// Of a ship's attitude and the camera's mounting: `c_bc` from camera axes to body axes.
    #[must_use]
    pub fn new(ship: &Attitude, c_bc: &Rotation3<f64>) -> Self {
        let c_nb = Rotation3::from_matrix_unchecked(ship.c_nb());
        CameraAttitude { c_nc: UnitQuaternion::from_rotation_matrix(&(c_nb * c_bc)) }
    }

    /// A share of the way to a later one.
    #[must_use]
    pub fn towards(&self, later: &Self, share: f64) -> Self {
        let slerped = self.c_nc.try_slerp(&later.c_nc, share, 1e-9);
        CameraAttitude { c_nc: slerped.unwrap_or(later.c_nc) }
    }

    /// The vertical, downwards, in camera axes.
    #[must_use]
    pub fn down(&self) -> Unit<Vector3<f64>> {
        self.c_nc.inverse() * Vector3::z_axis()
    }

    /// Turns a vector from camera axes at `earlier` to those now.
    #[must_use]
    pub fn since(&self, earlier: &Self) -> Rotation3<f64> {
        (self.c_nc.inverse() * earlier.c_nc).to_rotation_matrix()
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Matrix3;

    use super::*;

    /// A camera that looks ahead: its z is the ship's x, its x the ship's y.
    fn ahead() -> Rotation3<f64> {
        Rotation3::from_matrix_unchecked(Matrix3::new(0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0))
    }

    fn held(pitch: f64, heading: f64) -> CameraAttitude {
        CameraAttitude::new(&Attitude { roll: 0.0, pitch, heading }, &ahead())
    }

    #[test]
    fn a_bow_that_rises_moves_the_horizon_down_in_the_image() {
        let down = held(0.1, 1.0).down();
        // what is level ahead lies where ray . down = 0: at y / z = -z/y of the vertical
        assert!(-down.z / down.y > 0.09);
    }

    #[test]
    fn a_turn_to_starboard_moves_the_world_to_the_left() {
        let before = held(0.0, 0.0);
        let after = held(0.0, 0.02);
        let seen = after.since(&before) * Vector3::z();
        assert!((seen.x + 0.02).abs() < 1e-4 && seen.y.abs() < 1e-12);
        let halfway = before.towards(&after, 0.5).since(&before) * Vector3::z();
        assert!((halfway.x + 0.01).abs() < 1e-4);
    }
}
