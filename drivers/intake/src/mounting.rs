//! How a device sits in the ship.

use insd_base::Body;
use nalgebra::{Matrix3, Rotation3, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A direction of the hull.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Direction {
    /// Towards the bow.
    Forward,
    /// Towards the stern.
    Aft,
    /// To starboard.
    Starboard,
    /// To port.
    Port,
    /// Down.
    Down,
    /// Up.
    Up,
}

/// How a device sits: where its axes point, and by how much that is off.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Mounting {
    /// Where the device's x, y and z axes point, to the nearest right angle.
    pub axes: [Direction; 3],
    /// Roll, pitch and yaw, deg, that turn the hull's axes into the device's so named (yaw-pitch-roll).
    pub rotation_deg: [f64; 3],
}

impl Default for Mounting {
    fn default() -> Self {
        Mounting {
            axes: [Direction::Forward, Direction::Starboard, Direction::Down],
            rotation_deg: [0.0; 3],
        }
    }
}

impl Direction {
    /// The direction in forward, starboard, down.
    #[must_use]
    pub fn vector(self) -> Vector3<f64> {
        match self {
            Direction::Forward => Vector3::x(),
            Direction::Aft => -Vector3::x(),
            Direction::Starboard => Vector3::y(),
            Direction::Port => -Vector3::y(),
            Direction::Down => Vector3::z(),
            Direction::Up => -Vector3::z(),
        }
    }
}

impl Mounting {
    /// How a Doppler log of RDI hangs whose mounting nobody told: looking down, beam 3 forward by
    /// `alignment`, rad, clockwise from the bow (its heading alignment, `EA`). Its x points from beam 1
    /// to beam 2, y from beam 4 to beam 3, z from the sea bed to its face; one that looks up is turned
    /// over about y.
    ///
    /// Source: Teledyne RDI WorkHorse and RiverPro guides, commands `EA` and `PS3` (beam azimuths 270,
    /// 90, 0 and 180 deg from the forward mark).
    #[must_use]
    pub fn rdi(alignment: f64, up: bool) -> Self {
        use Direction::{Down, Forward, Port, Starboard, Up};
        let axes = if up { [Port, Forward, Down] } else { [Starboard, Forward, Up] };
        Mounting { axes, rotation_deg: [0.0, 0.0, alignment.to_degrees()] }
    }

    /// Rotation from the device's axes to forward, starboard, down; `None` if the axes are no
    /// right-handed set.
    #[must_use]
    pub fn c_bd(&self) -> Option<Matrix3<f64>> {
        let [x, y, z] = self.axes.map(Direction::vector);
        let right = Matrix3::from_columns(&[x, y, z]);
        let is_rotation = (right.determinant() - 1.0).abs() < 1e-9
            && self.rotation_deg.iter().all(|angle| angle.is_finite());
        let [roll, pitch, yaw] = self.rotation_deg.map(f64::to_radians);
        let off = Rotation3::from_euler_angles(roll, pitch, yaw).into_inner();
        is_rotation.then(|| off * right)
    }
}

/// A device's vector in the axes of the hull.
#[must_use]
pub fn turned(c_bd: &Matrix3<f64>, vector: [f64; 3]) -> Body {
    Body(c_bd * Vector3::from(vector))
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn a_device_with_z_up_is_turned_over() {
        use Direction::{Forward, Port, Up};
        let mounting = Mounting { axes: [Forward, Port, Up], ..Mounting::default() };
        let gravity = turned(&mounting.c_bd().unwrap(), [0.1, 0.2, 9.8]);
        assert_eq!(gravity, Body::new(0.1, -0.2, -9.8));
    }

    #[test]
    fn a_log_of_rdi_has_beam_3_forward_and_beam_2_to_starboard() {
        for (up, sign) in [(false, 1.0), (true, -1.0)] {
            let c_bd = Mounting::rdi(0.0, up).c_bd().unwrap();
            assert_eq!(turned(&c_bd, [0.0, 1.0, 0.0]), Body::new(1.0, 0.0, 0.0));
            assert_eq!(turned(&c_bd, [1.0, 0.0, 0.0]), Body::new(0.0, sign, 0.0));
            assert_eq!(turned(&c_bd, [0.0, 0.0, 1.0]), Body::new(0.0, 0.0, -sign));
        }
        // beam 3 turned 45 deg clockwise from the bow, as in the maker's example of EA+04500
        let c_bd = Mounting::rdi(std::f64::consts::FRAC_PI_4, false).c_bd().unwrap();
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let ahead = turned(&c_bd, [0.0, 1.0, 0.0]);
        assert_relative_eq!(ahead.0, Vector3::new(half, half, 0.0), epsilon = 1e-12);
    }

    #[test]
    fn axes_that_are_no_right_handed_set_are_refused() {
        use Direction::{Aft, Down, Forward, Starboard};
        for axes in [[Forward, Starboard, Starboard], [Aft, Starboard, Down], [Forward, Aft, Down]]
        {
            assert_eq!(Mounting { axes, ..Mounting::default() }.c_bd(), None);
        }
    }

    #[test]
    fn a_device_yawed_to_starboard_sees_forward_motion_on_its_port_side() {
        let mounting = Mounting { rotation_deg: [0.0, 0.0, 90.0], ..Mounting::default() };
        let forward = turned(&mounting.c_bd().unwrap(), [0.0, -1.0, 0.0]);
        assert_relative_eq!(forward.0, Vector3::x(), epsilon = 1e-12);
    }
}
