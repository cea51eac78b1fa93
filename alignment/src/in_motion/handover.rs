//! The computed frame turned upright and true, and the initial state of the full filter.
//!
//! Turning the frame is a change of coordinates, linear in the errors and exact for any dpsi: with
//! C_pb' = exp([a, 0]) R_z(d) C_pb,
//!
//! phi' = phi - R(dpsi') a,   (1-c', s') = R(-d) (1-c, s),   dpsi' = dpsi - d.

use insd_base::earth;
use insd_nav::antenna::AntennaMotion;
use insd_nav::declaration::Carried;
use insd_nav::error_state::carried;
use insd_nav::error_state::{
    ACCEL_BIAS, ACCEL_DRIFT, ATTITUDE, CURRENT, Effects, GNSS_DELAY, GNSS_LEVER,
    GNSS_POSITION_ERROR, GNSS_VELOCITY_DELAY, GNSS_VELOCITY_ERROR, GYRO_BIAS, GYRO_DRIFT,
    GYRO_SCALE, LOG_MISALIGNMENT, LOG_SCALE, POSITION, VELOCITY,
};
use insd_nav::initial::sensor_covariance;
use insd_nav::{InitialState, Nominal};
use nalgebra::{Matrix1, Matrix2, Matrix3, SMatrix, UnitQuaternion, Vector1, Vector2, Vector3};

use super::belief::{CONSIDERED, OwnCovariance, STATES, considered as k, innovation, state as x};
use super::motion::{across, rotation};
use super::polish::Polish;
use super::{ASTRAY, EightState, GOAL, LEAN};

/// Mean square length of (s, 1-c) that still tells a direction of tilt.
const SHORTEST: f64 = 1e-6;
/// By so much, and so many sigmas, (s, 1-c) must be off the circle for a log to have another gain.
const OFF: f64 = 0.25;
const SURELY: f64 = 7.0;

impl EightState {
    /// Levels the frame: turns it by the a that leaves the least mean square tilt, E|phi - R(dpsi) a|^2,
    ///
    /// a = E[R(dpsi)^T phi] / E|R(dpsi)|^2,   |R|^2 = s^2 + (1-c)^2,
    ///
    /// which is known long before the heading. What is known of (s, 1-c) is what noise has not made of it
    /// ([`blur`](super::blur)). As the regression has it, it shrinks where the measured force is noise, and
    /// its mean square with it: taken as one, as of a point on the circle, it would leave the frame as much too
    /// little levelled, and the sigma of what is left would know nothing of that. Held by
    /// `roll_and_pitch_are_as_sure_as_claimed_where_nothing_tells_the_heading`.
    pub(super) fn level(&mut self) {
        let a = self.lean();
        self.motion.tilt -= self.motion.turn() * a;
        self.turn_frame(&UnitQuaternion::new(Vector3::new(a.x, a.y, 0.0)));
        let mut t = OwnCovariance::identity();
        t.fixed_view_mut::<2, 1>(x::TILT, x::SINE).copy_from(&-across(&a));
        t.fixed_view_mut::<2, 1>(x::TILT, x::VERSINE).copy_from(&a);
        self.belief.transform(&t);
    }

    fn lean(&self) -> Vector2<f64> {
        let (direction, covariance) = self.direction();
        let p = self.belief.own();
        let cross = p.fixed_view::<2, 2>(x::TILT, x::SINE) * Matrix2::new(0.0, 1.0, -1.0, 0.0);
        let found = self.belief.direction_covariance();
        // what goes together with the direction goes with what noise has not made of it
        let response = found.try_inverse().map_or_else(Matrix2::zeros, |inverse| cross * inverse);
        let off = direction - Vector2::new(1.0 - self.motion.versine, self.motion.sine);
        let tilt = self.motion.tilt + response * off;
        let both = response * covariance;
        let spread = Vector2::new(both[(0, 0)] + both[(1, 1)], both[(1, 0)] - both[(0, 1)]);
        let length = direction.norm_squared() + covariance.trace();
        (rotation(&direction).transpose() * tilt + spread) / length.max(SHORTEST)
    }

    pub(super) fn keep_upright(&mut self) {
        if self.lean().norm() > LEAN {
            self.level();
        }
    }

    /// After every update: notes the heading; turns the frame true once it is known.
    pub(super) fn after_update(&mut self) {
        self.note_heading();
        if self.centred && self.heading.0.abs() > ASTRAY {
            self.turn_by(self.heading.0);
            self.note_heading();
        } else if !self.centred {
            let is_known = self.heading.1 < GOAL;
            self.gain_of_log = is_known.then(|| self.off_circle()).flatten();
            if is_known && self.gain_of_log.is_none() {
                self.centre();
                self.polish.get_or_insert(Polish::begin(self.time, self.heading.1));
            }
        }
        if let Some(polish) = &mut self.polish {
            polish.hear(self.time, self.heading.1);
        }
    }

    /// The gain of a log that takes (cos dpsi, sin dpsi) off the circle, if one does: she goes by log the way that she goes by
    /// the receiver, turned, so that where it tells n times her speed the two are found n times too short.
    fn off_circle(&self) -> Option<f64> {
        let direction = Vector2::new(1.0 - self.motion.versine, self.motion.sine);
        let length = direction.norm();
        let along = direction / length.max(SHORTEST);
        let variance = along.dot(&(self.belief.direction_covariance() * along));
        let off = (length - 1.0).abs();
        let is_off = off > OFF && off > SURELY * variance.max(0.0).sqrt();
        (is_off && self.hears_height() && self.has_heard_log()).then(|| 1.0 / length.max(SHORTEST))
    }

    /// Turns the frame by the estimated dpsi; from then on dpsi is a small angle, s = dpsi and c
    /// nothing: the constraint s^2 + (1-c)^2 = 1, linear at last, is applied to the belief.
    fn centre(&mut self) {
        let (turn, sigma) = self.heading;
        self.turn_by(turn);
        let mut h = SMatrix::<f64, 1, STATES>::zeros();
        h[x::VERSINE] = 1.0;
        let variance = sigma * sigma;
        let z = Vector1::new(0.5 * variance - self.motion.versine);
        let noise = Vector1::new((variance * variance).max(1e-10));
        let on_circle = innovation(&z, &h, &SMatrix::zeros(), &noise);
        if let Some(weighed) = self.belief.weigh(&on_circle) {
            let errors = self.belief.absorb(&weighed);
            self.motion.inject(&self.local, &errors);
        }
        // the curvature of the circle, which the tangent leaves out
        self.belief.allow(x::SINE, variance);
        self.centred = true;
        self.note_heading();
        self.level();
    }

    fn turn_frame(&mut self, by: &UnitQuaternion<f64>) {
        self.motion.attitude = by * self.motion.attitude;
        self.stride.iter_mut().for_each(|own| own.turn(by));
    }

    fn turn_by(&mut self, angle: f64) {
        let (sin, cos) = angle.sin_cos();
        self.turn_frame(&UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle));
        let (old_cos, old_sin) = (1.0 - self.motion.versine, self.motion.sine);
        self.motion.versine = 1.0 - (cos * old_cos + sin * old_sin);
        self.motion.sine = cos * old_sin - sin * old_cos;
        let mut t = OwnCovariance::identity();
        t[(x::SINE, x::SINE)] = cos;
        t[(x::SINE, x::VERSINE)] = sin;
        t[(x::VERSINE, x::SINE)] = -sin;
        t[(x::VERSINE, x::VERSINE)] = cos;
        self.belief.transform(&t);
        let back = rotation(&Vector2::new(cos, -sin));
        for pair in [k::GYRO, k::ACCEL, k::LEVER] {
            self.belief.turn_considered_pair(pair, &back);
        }
        let push = back.transpose() * self.push.xy();
        self.push = Vector3::new(push.x, push.y, self.push.z);
        self.antenna = AntennaMotion::default();
    }

    /// What the full filter starts from, once [`EightState::finished`]: the estimate, its covariance,
    /// and its correlations with the sensor errors it has lived with.
    #[must_use]
    pub fn initial_state(&self) -> Option<InitialState> {
        let mut own = self.clone();
        own.settle();
        if !own.finished() {
            return None;
        }
        own.turn_by(own.heading.0);
        own.level();
        let place = insd_base::Geodetic { height: own.vertical.height, ..own.motion.place };
        let v = own.motion.velocity;
        let v_n = Vector3::new(v.x, v.y, own.vertical.down);
        let nominal = Nominal {
            gnss_lever: own.config.gnss_lever() - own.config.lever_arms.gnss.0,
            ..Nominal::at(&place, &v_n, &own.motion.c_pb())
        };
        let c_en = earth::c_ne(&place).transpose();
        let mut covariance = sensor_covariance(&own.config);
        if own.has_heard_log() {
            carried(Carried::WithLog).for_each(|state| state.join(&mut covariance, &own.config));
        }
        covariance.spread_by(&own.errors_in_full(&c_en), &own.belief.joint());
        let (height, down) = own.vertical.variances();
        let up = c_en.column(2) * c_en.column(2).transpose();
        POSITION.add(&mut covariance, &(up * height));
        VELOCITY.add(&mut covariance, &(up * down));
        hang_from_mast(&mut covariance, &c_en, &own.motion.c_pb());
        covariance.symmetrise();
        let initial = InitialState::new(own.time, nominal, covariance, own.rate);
        Some(InitialState { gnss_used: own.gnss_used, ..initial })
    }

    /// Whether the estimate depends on the errors of a log.
    fn has_heard_log(&self) -> bool {
        self.belief.cross().columns(k::LOG_SCALE, CONSIDERED - k::LOG_SCALE).amax() > 0.0
    }

    /// What a unit of each of the eight errors, and of each considered one, is in the full filter; the frame being true, s is
    /// the heading error. Constant and drifting parts of a bias share it by their variances.
    fn errors_in_full(&self, c_en: &Matrix3<f64>) -> Effects {
        let mut into = Effects::none(STATES + CONSIDERED);
        for axis in 0..2 {
            let along = c_en.column(axis).transpose();
            into.set(x::POSITION + axis, POSITION, &along);
            into.set(x::VELOCITY + axis, VELOCITY, &along);
            into.set(x::TILT + axis, ATTITUDE, &along);
        }
        into.set(x::SINE, ATTITUDE, &c_en.column(2).transpose());
        let prior = &self.belief.prior;
        let share = |std: f64, at: usize| std * std / prior[at].max(f64::MIN_POSITIVE);
        let (gyro, accel) = (&self.config.imu.gyro, &self.config.imu.accel);
        for axis in 0..3 {
            let (at, own) = (k::GYRO + axis, Vector3::ith(axis, 1.0).transpose());
            into.set(STATES + at, GYRO_BIAS, &(own * share(gyro.bias_std, at)));
            into.set(STATES + at, GYRO_DRIFT, &(own * share(gyro.instability_std, at)));
        }
        for axis in 0..2 {
            let (at, own) = (k::ACCEL + axis, Vector3::ith(axis, 1.0).transpose());
            into.set(STATES + at, ACCEL_BIAS, &(own * share(accel.bias_std, at)));
            into.set(STATES + at, ACCEL_DRIFT, &(own * share(accel.instability_std, at)));
            into.set(STATES + k::LEVER + axis, GNSS_LEVER, &own);
            into.set(STATES + k::SLOW_POSITION + axis, GNSS_POSITION_ERROR, &own);
            into.set(STATES + k::SLOW_VELOCITY + axis, GNSS_VELOCITY_ERROR, &own);
            into.set(STATES + k::CURRENT + axis, CURRENT, &Vector2::ith(axis, 1.0).transpose());
        }
        let one = Matrix1::identity();
        into.set(STATES + k::GYRO_SCALE_DOWN, GYRO_SCALE, &Vector3::z().transpose());
        into.set(STATES + k::DELAY, GNSS_DELAY, &one);
        into.set(STATES + k::VELOCITY_DELAY, GNSS_VELOCITY_DELAY, &one);
        into.set(STATES + k::LOG_SCALE, LOG_SCALE, &one);
        into.set(STATES + k::LOG_TURN, LOG_MISALIGNMENT, &Vector2::y().transpose());
        into
    }
}

/// The height came from the antenna by way of its lever arm, and is off as that is: with dl the error of
/// the lever arm, dr_D = dr_D - (C_nb dl)_D. The horizontal pair carries its part in the belief.
fn hang_from_mast(
    p: &mut insd_nav::error_state::Covariance,
    c_en: &Matrix3<f64>,
    c_nb: &Matrix3<f64>,
) {
    GNSS_LEVER.add_to(POSITION, p, &(-c_en.column(2) * c_nb.row(2)));
}
