//! How far the antenna has moved since the epoch before, as the phases of its satellites have it.
//!
//! Velocities that a receiver tells are good to some centimetres a second, the change of a carrier phase to millimetres. But it
//! is of the whole time between two epochs, T, in which the ship may have rolled: with the force f that was felt since,
//! computed frame,
//!
//! dr = v T - R(dpsi) M + phi x M + R(dpsi) (C_pb l - C_pb' l),   M = integral of (t - t') f(t),
//!
//! v the velocity now, l the lever arm, primes at the epoch before: linear in the eight states as all of this.

use insd_base::Time;
use insd_estimation::Innovation;
use nalgebra::{Matrix2, Matrix3, Rotation3, SMatrix, UnitQuaternion, Vector2, Vector3};

use super::aids::Scene;
use super::belief::{Belief, CONSIDERED, considered as k, innovation, state as x};

/// What no satellite's phase is held to, 1-sigma, m: masts bend, and what the atmosphere does is not white.
const FLOOR: f64 = 0.003;

/// What was felt since an epoch, computed frame.
#[derive(Clone, Copy, Debug)]
pub struct Stride {
    /// The instant of the epoch.
    pub since: Time,
    elapsed: f64,
    /// Integral of the force, m/s, and of the force times the time since the epoch, m.
    force: Vector3<f64>,
    moment: Vector3<f64>,
    /// Rotation from body axes at the epoch.
    c_pb: Matrix3<f64>,
}

/// A displacement, north and east, m, with its covariance, m^2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moved {
    /// How far.
    pub by: Vector2<f64>,
    /// Covariance.
    pub covariance: Matrix2<f64>,
}

impl Stride {
    /// Begins at an epoch.
    #[must_use]
    pub fn begin(now: Time, c_pb: Matrix3<f64>) -> Self {
        let (force, moment) = (Vector3::zeros(), Vector3::zeros());
        Stride { since: now, elapsed: 0.0, force, moment, c_pb }
    }

    /// Takes the integral of the force over a step of `h` seconds, m/s.
    pub fn add(&mut self, force: &Vector3<f64>, h: f64) {
        self.moment += force * (self.elapsed + 0.5 * h);
        self.force += force;
        self.elapsed += h;
    }

    /// The computed frame is turned.
    pub fn turn(&mut self, by: &UnitQuaternion<f64>) {
        let c: Rotation3<f64> = by.to_rotation_matrix();
        (self.force, self.moment, self.c_pb) = (c * self.force, c * self.moment, c * self.c_pb);
    }
}

/// Displacement of the antenna since the begin of a stride, as the module's equation has it. What the lever arm is off by turns with
/// the hull and counts as noise; so does what a late clock makes of the change of velocity.
#[must_use]
pub fn gnss_displacement(
    scene: &Scene,
    stride: &Stride,
    moved: &Moved,
    lever: &Vector3<f64>,
    belief: &Belief,
) -> Innovation {
    let swung = scene.c_pb - stride.c_pb;
    let motion = &scene.motion;
    let (by_turning, mut h) = motion.carried(&(swung * lever - stride.moment));
    h.fixed_view_mut::<2, 2>(0, x::VELOCITY).fill_diagonal(stride.elapsed);
    let through = Vector3::new(motion.velocity.x, motion.velocity.y, scene.down.0);
    let pull = -scene.local.coriolis.cross(&through).xy();
    let half_square = 0.5 * stride.elapsed.powi(2);
    let expected = motion.velocity * stride.elapsed + by_turning - pull * half_square;
    let mut hc = SMatrix::<f64, 2, CONSIDERED>::zeros();
    let by_bias = scene.hull * half_square;
    hc.fixed_view_mut::<2, 2>(0, k::ACCEL).copy_from(&by_bias);
    let late = belief.prior[k::DELAY] * stride.force.xy().norm_squared();
    let unknown_arm = swung.fixed_rows::<2>(0).norm_squared() * belief.prior[k::LEVER];
    let noise = FLOOR.powi(2) + late + unknown_arm;
    let r = moved.covariance + Matrix2::from_diagonal_element(noise);
    innovation(&(moved.by - expected), &h, &hc, &r)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::in_motion::belief::OWN;
    use crate::in_motion::motion::HorizontalMotion;
    use crate::in_motion::tests::good_imu;
    use insd_base::units::DEG;
    use insd_base::{Geodetic, LeverArms};
    use insd_nav::NavConfig;

    const LEVER: Vector3<f64> = Vector3::new(-6.0, 1.0, -14.0);

    /// A ship at rest at the equator's latitude of no Coriolis to speak of, that gathers way for a second and turns, assumed heading off by this.
    fn scene(off: f64) -> (Scene, Stride, Moved) {
        let (sin, cos) = off.sin_cos();
        let turn = Matrix2::new(cos, -sin, sin, cos);
        let force = Vector3::new(0.4, -0.2, -9.8);
        let before = UnitQuaternion::from_euler_angles(0.03, -0.02, 0.0);
        let now = UnitQuaternion::from_euler_angles(-0.02, 0.01, 0.05);
        let mut stride = Stride::begin(Time::START, before.to_rotation_matrix().into_inner());
        (0..100).for_each(|_| stride.add(&(force * 0.01), 0.01));
        let motion = HorizontalMotion {
            place: Geodetic::default(),
            velocity: turn * force.xy(),
            tilt: Vector2::zeros(),
            sine: sin,
            versine: 1.0 - cos,
            attitude: now,
        };
        let swung = (now * LEVER - before * LEVER).xy();
        let by = turn * (force.xy() * 0.5 + swung);
        let moved = Moved { by, covariance: Matrix2::from_diagonal_element(1e-6) };
        (Scene::new(&motion, &Vector3::zeros(), 0.0, (0.0, 0.0)), stride, moved)
    }

    fn innovation_of(scene: &Scene, stride: &Stride, moved: &Moved) -> Innovation {
        let belief = Belief::new(&NavConfig::new(good_imu(), LeverArms::default()));
        gnss_displacement(scene, stride, moved, &LEVER, &belief)
    }

    #[test]
    fn a_displacement_is_what_the_forces_and_the_swing_make_of_it_whatever_the_heading() {
        for degrees in [0.0, 40.0, 170.0, -95.0] {
            let (scene, stride, moved) = scene(degrees * DEG);
            let z = innovation_of(&scene, &stride, &moved).z;
            assert!(z.norm() < 1e-4, "{degrees}: {z}");
        }
    }

    #[test]
    fn a_heading_that_is_off_shows_in_a_displacement_as_the_equation_has_it() {
        let (seen, stride, moved) = scene(0.3);
        let by = 1e-4;
        let motion = HorizontalMotion { sine: seen.motion.sine - by, ..seen.motion };
        let other = Scene { motion, ..seen };
        let [was, is] = [&seen, &other].map(|own| innovation_of(own, &stride, &moved));
        let by_sine = was.h.of(OWN).column(x::SINE) * by;
        assert!((is.z - &was.z - by_sine).norm() < 1e-9);
    }
}
