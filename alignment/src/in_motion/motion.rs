//! The misheaded level frame: the strapdown in it, and how its errors grow.
//!
//! The computed frame p is carried as if it were north-east-down, but it points off in azimuth by
//! dpsi = true minus assumed heading, and is tilted by a small phi = (phi_N, phi_E, 0) *given along
//! true north and east*:
//!
//! C_nb = (I + [phi x]) R(dpsi) C_pb,   R(dpsi) = [1-c, -s; s, 1-c] on the horizontal pair.
//!
//! With that choice of phi every equation is linear in (s, c, phi), whatever dpsi:
//!
//! v_N' = (1-c) f_x - s f_y + phi_E f_z + (gravity, Coriolis)_N,
//! v_E' = s f_x + (1-c) f_y - phi_N f_z + (gravity, Coriolis)_E     (docs/systems.md, eq. (6) with tilt),
//!
//! f the specific force in p. The frame is turned at w = w_ie + w_en, the rate of the true axes, though
//! it is not theirs, so that the Earth tilts it (gyrocompassing):
//!
//! phi_N' = -c w_N - s w_E + w_D phi_E,   phi_E' = s w_N - c w_E - w_D phi_N,
//!
//! from R(dpsi) w - w - w x phi. A frame that points east of north (s > 0: the true heading is greater
//! than the assumed) is tilted towards positive phi_E, north and south of the equator alike; the sign
//! of the latitude enters by w_D only. Held by `the_transition_agrees_with_perturbed_strapdowns` and
//! `gyrocompassing_turns_the_right_way_north_and_south_of_the_equator`.

use insd_base::{Geodetic, earth};
use insd_nav::{Increment, NavConfig};
use nalgebra::{Matrix2, Matrix3, Quaternion, SMatrix, UnitQuaternion, Vector2, Vector3};

use super::belief::{
    Belief, INERTIAL, OwnCovariance, OwnErrors, PerConsidered, STATES, Stretched, considered as k,
    state as x,
};

/// The estimate around which the eight errors are linear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HorizontalMotion {
    /// Position of the IMU; the height is that of the vertical channel.
    pub place: Geodetic,
    /// Velocity north and east, m/s.
    pub velocity: Vector2<f64>,
    /// Tilt phi about true north and east, rad.
    pub tilt: Vector2<f64>,
    /// s = sin(dpsi).
    pub sine: f64,
    /// c = 1 - cos(dpsi).
    pub versine: f64,
    /// Rotation from body axes to the computed frame.
    pub attitude: UnitQuaternion<f64>,
}

/// What changes slowly with place and speed; renewed with every stretch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Local {
    /// Normal gravity, m/s^2.
    pub gravity: f64,
    /// Rate of north-east-down axes against inertial space, in them, rad/s.
    pub turn: Vector3<f64>,
    /// The rate of Coriolis' acceleration, 2 w_ie + w_en, rad/s.
    pub coriolis: Vector3<f64>,
    /// Radii of the meridian and of the prime vertical at this height, m.
    pub radii: (f64, f64),
}

/// One step of the strapdown, for the error model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HorizontalStep {
    /// Specific-force integral, computed frame, m/s.
    pub force: Vector3<f64>,
    /// Bow direction, computed frame, horizontal.
    pub bow: Vector2<f64>,
    /// Rotation about the computed vertical, rad.
    pub turn: f64,
    /// Acceleration downwards, m/s^2.
    pub down: f64,
}

/// Sums over steps since the belief was last carried on.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct HorizontalStretch {
    /// Length, s.
    pub duration: f64,
    force: Vector3<f64>,
    bow: Vector2<f64>,
    turn: f64,
    rate_noise: f64,
    force_noise: f64,
}

/// A quarter turn to starboard of a horizontal pair: down cross it.
pub fn across(v: &Vector2<f64>) -> Vector2<f64> {
    Vector2::new(-v.y, v.x)
}

/// R(angle) with cosine and sine given by a pair.
pub fn rotation(direction: &Vector2<f64>) -> Matrix2<f64> {
    Matrix2::new(direction.x, -direction.y, direction.y, direction.x)
}

/// The rotation by a vector of a few microradians, rad, without sines.
fn slightly(by: &Vector3<f64>) -> UnitQuaternion<f64> {
    UnitQuaternion::new_unchecked(Quaternion::from_parts(1.0, by * 0.5))
}

impl Local {
    /// Around a place and a velocity.
    #[must_use]
    pub fn new(motion: &HorizontalMotion) -> Self {
        let place = &motion.place;
        let (meridian, prime) = earth::radii(place.latitude);
        let earth_rate = earth::rate_n(place.latitude);
        let v_n = Vector3::new(motion.velocity.x, motion.velocity.y, 0.0);
        let transport = earth::transport_rate(place, &v_n);
        Local {
            gravity: earth::normal_gravity(place.latitude, place.height),
            turn: earth_rate + transport,
            coriolis: earth_rate * 2.0 + transport,
            radii: (meridian + place.height, prime + place.height),
        }
    }
}

impl HorizontalMotion {
    /// Estimated R(dpsi). Before the heading is known its columns are shorter than one.
    #[must_use]
    pub fn turn(&self) -> Matrix2<f64> {
        rotation(&Vector2::new(1.0 - self.versine, self.sine))
    }

    /// A vector of the computed frame in north and east, and how that depends on the errors.
    #[must_use]
    pub fn carried(&self, v: &Vector3<f64>) -> (Vector2<f64>, SMatrix<f64, 2, 8>) {
        let level = v.xy();
        let mut h = SMatrix::<f64, 2, 8>::zeros();
        h.fixed_view_mut::<2, 2>(0, x::TILT).copy_from(&Matrix2::new(0.0, v.z, -v.z, 0.0));
        h.set_column(x::SINE, &across(&level));
        h.set_column(x::VERSINE, &-level);
        (self.north_east(v), h)
    }

    /// A vector of the computed frame in north and east: R(dpsi) v + phi x v.
    fn north_east(&self, v: &Vector3<f64>) -> Vector2<f64> {
        self.turn() * v.xy() - across(&self.tilt) * v.z
    }

    /// Rotation from body axes to the computed frame.
    #[must_use]
    pub fn c_pb(&self) -> Matrix3<f64> {
        self.attitude.to_rotation_matrix().into_inner()
    }

    /// Integrates one increment; `down` is the velocity downwards, m/s.
    pub fn advance(&mut self, local: &Local, increment: &Increment, down: f64) -> HorizontalStep {
        let h = increment.duration();
        let rotation = &increment.rotation;
        let half_turn = UnitQuaternion::new(rotation * 0.5);
        let earth_turn = slightly(&(local.turn * (-0.5 * h)));
        let half = earth_turn * self.attitude * half_turn;
        // the mean of the rotation over the step, as in insd_nav::strapdown
        let bent = increment.velocity + rotation.cross(&rotation.cross(&increment.velocity)) / 24.0;
        let force = half * bent;
        let push = self.north_east(&force);
        let v = Vector3::new(self.velocity.x, self.velocity.y, down);
        let pull = -local.coriolis.cross(&v);
        let before = self.velocity;
        self.velocity += push + pull.xy() * h;
        self.shift(local, &((before + self.velocity) * (0.5 * h)));
        let w = local.turn.xy();
        self.tilt += (self.turn() * w - w - across(&self.tilt) * local.turn.z) * h;
        self.attitude = earth_turn * half * half_turn;
        let upright = force.z + self.tilt.x * push.y - self.tilt.y * push.x;
        let bow = half * Vector3::x();
        HorizontalStep {
            force,
            bow: bow.xy(),
            turn: (half * rotation).z,
            down: upright / h.max(1e-9) + local.gravity + pull.z,
        }
    }

    /// Moves the position north and east, m.
    pub fn shift(&mut self, local: &Local, by: &Vector2<f64>) {
        let (meridian, prime) = local.radii;
        let cos = self.place.latitude.cos().max(1e-6);
        self.place.latitude += by.x / meridian;
        self.place.longitude =
            insd_base::units::wrap_pi(self.place.longitude + by.y / (prime * cos));
    }

    /// Moves the estimate by its errors: estimated + error = true.
    pub fn inject(&mut self, local: &Local, errors: &OwnErrors) {
        self.shift(local, &errors.fixed_rows::<2>(x::POSITION).into_owned());
        self.velocity += errors.fixed_rows::<2>(x::VELOCITY);
        self.tilt += errors.fixed_rows::<2>(x::TILT);
        self.sine += errors[x::SINE];
        self.versine += errors[x::VERSINE];
    }
}

impl HorizontalStretch {
    /// Adds a step and the increment it came from.
    pub fn add(&mut self, step: &HorizontalStep, increment: &Increment) {
        let h = increment.duration();
        self.duration += h;
        self.force += step.force;
        self.bow += step.bow * h;
        self.turn += step.turn;
        self.rate_noise += increment.rate_noise.max() * h;
        self.force_noise += increment.force_noise.max() * h;
    }

    /// What the stretch does to the errors, to second order in its length where velocity feeds
    /// position and tilt feeds velocity.
    #[must_use]
    pub fn transition(
        &self,
        motion: &HorizontalMotion,
        local: &Local,
        belief: &Belief,
        config: &NavConfig,
    ) -> Stretched {
        Stretched {
            f: self.own(motion, local),
            g: self.input(motion),
            q: self.noise(motion, belief, config),
            decay: self.decay(config),
        }
    }

    fn own(&self, motion: &HorizontalMotion, local: &Local) -> OwnCovariance {
        let dt = self.duration;
        let (meridian, prime) = local.radii;
        let w = local.turn;
        let mut f = OwnCovariance::identity();
        let (_, by_force) = motion.carried(&self.force);
        let spin = |rate: f64| Matrix2::new(0.0, rate * dt, -rate * dt, 0.0);
        // the Earth's rate, seen misheaded, tilts the frame
        let mut tilt = SMatrix::<f64, 2, 8>::zeros();
        tilt.fixed_view_mut::<2, 2>(0, x::TILT).copy_from(&spin(w.z));
        tilt.set_column(x::SINE, &(across(&w.xy()) * dt));
        tilt.set_column(x::VERSINE, &(-w.xy() * dt));
        tilt[(0, x::VELOCITY + 1)] = -dt / prime;
        tilt[(1, x::VELOCITY)] = dt / meridian;
        // and a tilt that grows evenly gives half of its final acceleration
        let lean = Matrix2::new(0.0, self.force.z, -self.force.z, 0.0);
        let mut velocity = by_force + lean * tilt * 0.5;
        let coriolis = Matrix2::new(0.0, local.coriolis.z * dt, -local.coriolis.z * dt, 0.0);
        let mut vv = velocity.fixed_view_mut::<2, 2>(0, x::VELOCITY);
        vv += coriolis;
        let mut rows = f.fixed_rows_mut::<2>(x::POSITION);
        rows += velocity * (0.5 * dt);
        f.fixed_view_mut::<2, 2>(x::POSITION, x::VELOCITY).fill_diagonal(dt);
        let mut rows = f.fixed_rows_mut::<2>(x::VELOCITY);
        rows += velocity;
        let mut rows = f.fixed_rows_mut::<2>(x::TILT);
        rows += tilt;
        f
    }

    /// A sensor reads true + bias: the estimate runs ahead by it and the error falls behind.
    fn input(&self, motion: &HorizontalMotion) -> SMatrix<f64, STATES, INERTIAL> {
        let dt = self.duration;
        let hull = rotation(&self.bow);
        let lean = Matrix2::new(0.0, self.force.z, -self.force.z, 0.0);
        let mut g = SMatrix::<f64, STATES, INERTIAL>::zeros();
        let mut put = |row: usize, column: usize, m: &Matrix2<f64>| {
            g.fixed_view_mut::<2, 2>(row, column).copy_from(m);
        };
        put(x::TILT, k::GYRO, &-hull);
        put(x::VELOCITY, k::GYRO, &(lean * hull * -0.5));
        put(x::VELOCITY, k::ACCEL, &-hull);
        put(x::POSITION, k::ACCEL, &(hull * (-0.5 * dt)));
        let swing = Vector2::new(1.0 - motion.versine, motion.sine);
        for (column, amount) in [(k::GYRO_DOWN, dt), (k::GYRO_SCALE_DOWN, self.turn)] {
            g[(x::SINE, column)] = -swing.x * amount;
            g[(x::VERSINE, column)] = -swing.y * amount;
        }
        g
    }

    fn noise(
        &self,
        motion: &HorizontalMotion,
        belief: &Belief,
        config: &NavConfig,
    ) -> OwnCovariance {
        let (gyro, accel) = (&config.imu.gyro, &config.imu.accel);
        let angle = gyro.random_walk.powi(2) * self.duration + self.rate_noise;
        let speed = accel.random_walk.powi(2) * self.duration + self.force_noise;
        let mut q = OwnCovariance::zeros();
        for axis in 0..2 {
            q[(x::VELOCITY + axis, x::VELOCITY + axis)] = speed;
            q[(x::TILT + axis, x::TILT + axis)] = angle;
        }
        // s' = cos dpsi dpsi', c' = sin dpsi dpsi': second moments, as neither is known at first
        let p = belief.own();
        let (cos, sin) = (1.0 - motion.versine, motion.sine);
        q[(x::SINE, x::SINE)] = angle * (cos * cos + p[(x::VERSINE, x::VERSINE)]);
        q[(x::VERSINE, x::VERSINE)] = angle * (sin * sin + p[(x::SINE, x::SINE)]);
        let both = angle * (cos * sin - p[(x::SINE, x::VERSINE)]);
        q[(x::SINE, x::VERSINE)] = both;
        q[(x::VERSINE, x::SINE)] = both;
        q
    }

    fn decay(&self, config: &NavConfig) -> PerConsidered {
        let over = |time: f64| (-self.duration / time).exp();
        let mut decay = PerConsidered::repeat(1.0);
        let mut put = |at: usize, time: f64| decay.rows_mut(at, 2).fill(over(time));
        put(k::SLOW_POSITION, config.gnss.position_time);
        put(k::SLOW_VELOCITY, config.gnss.velocity_time);
        put(k::CURRENT, config.log.current_time);
        decay
    }
}
