//! The ship on the Earth: position, velocity, attitude and their rates in Earth-fixed axes.
//!
//! Chart axes `g` are chart north, chart east and down, where chart north points along the ground
//! towards a pole that need not be that of the Earth. With the pole on the equator (grid north) they
//! are regular over both geographic poles. All states are in ECEF axes, so nothing here is singular.

use nalgebra::{Matrix3, Rotation3, Vector3};

use insd_base::earth::{c_ne, ecef, geodetic, radii};
use insd_base::units::DEG;
use insd_base::{Attitude, Body, Ecef, Geodetic, Ned};

use crate::motion::{Jet, LocalMotion, Motion, SeaMotion};
use crate::quadrature::{NODES, WEIGHTS};
use crate::scenario::{HeadingReference, Scenario};

/// Spacing of the knots of the position, s.
const SPACING: f64 = 0.1;

/// The ship at one instant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Kinematics {
    /// Position of the IMU, ECEF, m.
    pub(crate) position: Vector3<f64>,
    /// The same, geodetic.
    pub(crate) point: Geodetic,
    /// Velocity over the Earth, ECEF axes, m/s.
    pub(crate) velocity: Vector3<f64>,
    /// Its time derivative in ECEF axes, m/s^2.
    pub(crate) acceleration: Vector3<f64>,
    /// Rotation from body to ECEF axes.
    pub(crate) c_eb: Matrix3<f64>,
    /// Angular rate of the body with respect to the Earth, body axes, rad/s.
    pub(crate) omega_eb: Vector3<f64>,
}

impl Kinematics {
    /// Velocity of the IMU in north-east-down axes, m/s.
    pub(crate) fn velocity_n(&self) -> Ned {
        Ned(c_ne(&self.point) * self.velocity)
    }

    /// Roll, pitch and heading from true north.
    pub(crate) fn attitude(&self) -> Attitude {
        Attitude::from_c_nb(&(c_ne(&self.point) * self.c_eb))
    }

    /// Position and velocity, ECEF, of a point of the hull at `lever` from the IMU.
    pub(crate) fn at_lever(&self, lever: &Body) -> (Ecef, Vector3<f64>) {
        let position = self.position + self.c_eb * lever.0;
        (Ecef(position), self.velocity + self.c_eb * self.omega_eb.cross(&lever.0))
    }
}

/// The voyage as a function of time.
///
/// Velocity and attitude in chart axes are closed formulas of time. The many sinusoids among them are
/// evaluated at knots only; between two knots the motion in the waves is, by definition, the quintic
/// that meets value and two derivatives at both, which is within 1e-7 of the sinusoids and has exact
/// derivatives of its own.
///
/// The position is the integral of the velocity by Gauss-Legendre quadrature of sixth order from knot
/// to knot, and between knots the quintic that meets position, velocity and acceleration. Velocity and
/// acceleration at any time come from the formulas; the slope of that quintic agrees with them to
/// about 1e-7 m/s.
#[derive(Debug)]
pub(crate) struct Track {
    motion: Motion,
    pole: Vector3<f64>,
    /// Motion in waves and moorings at the knots.
    sea: Vec<SeaMotion>,
    /// Position at the knots, each axis with its two derivatives.
    path: Vec<[Jet; 3]>,
}

impl Track {
    /// The track of a scenario under a seed.
    pub(crate) fn new(scenario: &Scenario, seed: u64) -> Self {
        let motion = Motion::new(scenario, seed);
        let start = start_of(scenario);
        let pole = match scenario.route.heading_reference {
            HeadingReference::True => Vector3::z(),
            HeadingReference::Grid => {
                let own = scenario.start.lon_deg;
                let meridian = scenario.route.grid_longitude_deg.unwrap_or(own) * DEG;
                -Vector3::new(meridian.cos(), meridian.sin(), 0.0)
            }
        };
        let duration = scenario.duration();
        let knots = (duration / SPACING).ceil() as usize + 2;
        let sea = (0..knots).map(|knot| motion.sea(knot as f64 * SPACING)).collect();
        let mut track = Track { motion, pole, sea, path: Vec::with_capacity(knots) };
        track.lay(&start);
        track
    }

    /// The motion in chart axes.
    pub(crate) fn motion(&self) -> &Motion {
        &self.motion
    }

    /// The ship at time `t`, s.
    pub(crate) fn at(&self, t: f64) -> Kinematics {
        let (knot, x) = self.knot_before(t);
        let (a, b) = (&self.path[knot], &self.path[knot + 1]);
        let position = Vector3::from_fn(|i, _| Jet::between(a[i], b[i], SPACING, x).value);
        self.resolve(&self.local(t), position)
    }

    /// Lays the path from the mean position `start`, displaced by the waves.
    fn lay(&mut self, start: &Geodetic) {
        let mut position = self.displaced(start);
        for knot in 0..self.sea.len() {
            let t = knot as f64 * SPACING;
            let now = self.resolve(&self.local(t), position);
            let (velocity, acceleration) = (now.velocity, now.acceleration);
            self.path.push(std::array::from_fn(|i| Jet {
                value: position[i],
                rate: velocity[i],
                accel: acceleration[i],
            }));
            let mut step = Vector3::zeros();
            for (node, weight) in NODES.into_iter().zip(WEIGHTS) {
                let tau = node * SPACING;
                // only turns the velocity with the curvature of the Earth: 1e-4 m off is 1e-11 rad
                let near = position + velocity * tau + acceleration * (tau * tau / 2.0);
                step += self.velocity_e(t + tau, &near) * (weight * SPACING);
            }
            position += step;
        }
    }

    fn displaced(&self, start: &Geodetic) -> Vector3<f64> {
        let [north, east, up] = self.local(0.0).displacement;
        let origin = ecef(start).0;
        origin + self.c_eg(&origin) * Vector3::new(north, east, -up)
    }

    fn velocity_e(&self, t: f64, position: &Vector3<f64>) -> Vector3<f64> {
        let velocity = self.local(t).velocity;
        self.c_eg(position) * Vector3::from(velocity.map(|jet| jet.value))
    }

    /// The knot at or before `t`, s, that has one after it, and the fraction of the way to that.
    fn knot_before(&self, t: f64) -> (usize, f64) {
        let knot = ((t / SPACING).max(0.0) as usize).min(self.sea.len() - 2);
        (knot, t / SPACING - knot as f64)
    }

    /// The motion in chart axes at time `t`, s.
    fn local(&self, t: f64) -> LocalMotion {
        let (knot, x) = self.knot_before(t);
        let sea = SeaMotion::between(&self.sea[knot], &self.sea[knot + 1], SPACING, x);
        self.motion.with_sea(t, &sea)
    }

    /// Rotation from chart to ECEF axes at an ECEF position.
    fn c_eg(&self, position: &Vector3<f64>) -> Matrix3<f64> {
        let up = upward(&geodetic(&Ecef(*position)));
        self.c_eg_of_up(&up)
    }

    fn c_eg_of_up(&self, up: &Vector3<f64>) -> Matrix3<f64> {
        let north = (self.pole - up * self.pole.dot(up)).normalize();
        Matrix3::from_columns(&[north, -up.cross(&north), -*up])
    }

    /// Turns chart velocity and attitude into Earth-fixed axes:
    ///
    /// v_e = C_eg v_g, dv_e/dt = C_eg dv_g/dt + omega_eg x v_e, C_eb = C_eg C_gb,
    /// omega_eb^b = omega_gb^b + C_be omega_eg^e.
    fn resolve(&self, local: &LocalMotion, position: Vector3<f64>) -> Kinematics {
        let point = geodetic(&Ecef(position));
        let up = upward(&point);
        let c_eg = self.c_eg_of_up(&up);
        let velocity = c_eg * Vector3::from(local.velocity.map(|jet| jet.value));
        let omega_eg = self.chart_rate(&point, &up, &c_eg, &velocity);
        let change = Vector3::from(local.velocity.map(|jet| jet.rate));
        let (roll, pitch) = (local.roll, local.pitch);
        let angles = Rotation3::from_euler_angles(roll.value, pitch.value, local.yaw.value);
        let c_eb = c_eg * angles.matrix();
        Kinematics {
            position,
            point,
            velocity,
            acceleration: c_eg * change + omega_eg.cross(&velocity),
            c_eb,
            omega_eb: euler_rate(local) + c_eb.tr_mul(&omega_eg),
        }
    }

    /// Angular rate of the chart axes with respect to the Earth, ECEF axes, rad/s.
    ///
    /// The vertical u turns with the curvature of the ellipsoid, du/dt = v_N/(M+h) north +
    /// v_E/(N+h) east, so omega = u x du/dt + w u. Chart east stays normal to the pole p, and its
    /// derivative too: p . (omega x east) = 0 gives w = -p . ((u x du/dt) x east) / (p . north),
    /// north and east being those of the chart.
    fn chart_rate(
        &self,
        point: &Geodetic,
        up: &Vector3<f64>,
        c_eg: &Matrix3<f64>,
        velocity: &Vector3<f64>,
    ) -> Vector3<f64> {
        let (meridian, prime_vertical) = radii(point.latitude);
        let (sin_lon, cos_lon) = point.longitude.sin_cos();
        let east = Vector3::new(-sin_lon, cos_lon, 0.0);
        let north = up.cross(&east);
        let turn = north * (north.dot(velocity) / (meridian + point.height))
            + east * (east.dot(velocity) / (prime_vertical + point.height));
        let level = up.cross(&turn);
        let (chart_north, chart_east) = (c_eg.column(0), c_eg.column(1));
        let spin = -self.pole.dot(&level.cross(&chart_east)) / self.pole.dot(&chart_north);
        level + up * spin
    }
}

/// The mean position at the start.
pub(crate) fn start_of(scenario: &Scenario) -> Geodetic {
    let start = &scenario.start;
    Geodetic::from_degrees(start.lat_deg, start.lon_deg, start.height_m)
}

/// The ellipsoid's outward normal, ECEF axes.
fn upward(point: &Geodetic) -> Vector3<f64> {
    let (sin_lat, cos_lat) = point.latitude.sin_cos();
    let (sin_lon, cos_lon) = point.longitude.sin_cos();
    Vector3::new(cos_lat * cos_lon, cos_lat * sin_lon, sin_lat)
}

/// Angular rate of the body with respect to the chart axes, body axes, rad/s.
/// Groves, 2nd ed., inverse of eq. (2.57).
fn euler_rate(local: &LocalMotion) -> Vector3<f64> {
    let (sin_r, cos_r) = local.roll.value.sin_cos();
    let (sin_p, cos_p) = local.pitch.value.sin_cos();
    let (roll, pitch, yaw) = (local.roll.rate, local.pitch.rate, local.yaw.rate);
    Vector3::new(
        roll - yaw * sin_p,
        pitch * cos_r + yaw * cos_p * sin_r,
        yaw * cos_p * cos_r - pitch * sin_r,
    )
}
