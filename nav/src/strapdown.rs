//! The strapdown mechanisation in ECEF axes: regular at every latitude and longitude, the poles and
//! the antimeridian included. Blocks 21-27 of JP3375720B2.
//!
//! In ECEF axes the correction quantities are gravity, Coriolis and Earth rate; the transport rate
//! does not appear, because the axes do not turn with the ship's position. Groves, Principles of
//! GNSS, Inertial and Multisensor Integrated Navigation Systems, 2nd ed., section 5.3.

use insd_base::earth;
use insd_base::{Ecef, Geodetic, Time};
use nalgebra::{Matrix3, UnitQuaternion, Vector3};

use crate::increments::{Increment, second_order};
use crate::nominal::Nominal;

/// Gravity near an anchor point: its value there and a linear change around it, so that the closed
/// formula need not be evaluated at every sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocalGravity {
    anchor: Vector3<f64>,
    value: Vector3<f64>,
    gradient: Matrix3<f64>,
}

impl LocalGravity {
    /// Gravity around an ECEF position, m, of which the geodetic coordinates are known.
    #[must_use]
    pub fn around(position: &Vector3<f64>, geodetic: &Geodetic) -> Self {
        LocalGravity {
            anchor: *position,
            value: earth::gravity_e(geodetic),
            gradient: earth::gravity_gradient_e(&Ecef(*position)),
        }
    }

    /// Gravity at a position within some hundred metres of the anchor, m/s^2.
    #[must_use]
    pub fn at(&self, position: &Vector3<f64>) -> Vector3<f64> {
        self.value + self.gradient * (position - self.anchor)
    }

    /// Derivative of gravity with respect to position, 1/s^2.
    #[must_use]
    pub fn gradient(&self) -> &Matrix3<f64> {
        &self.gradient
    }
}

/// What one step did, for the error model: the corrected increments and the rotation they met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Duration, s.
    pub duration: f64,
    /// Rotation from body to ECEF axes at the middle of the step.
    pub c_eb: Matrix3<f64>,
    /// Corrected rotation vector, body, rad.
    pub rotation: Vector3<f64>,
    /// Corrected specific-force integral, body, m/s.
    pub velocity: Vector3<f64>,
}

/// Integrates one increment: attitude, then velocity, then position.
///
/// Attitude: q_eb <- exp(-omega_ie h) q_eb exp(rotation). Velocity: the increment, turned by half
/// the rotation over the step, plus gravity and Coriolis. Position: trapezoid. Groves, 2nd ed.,
/// eqs. (5.73)-(5.86).
pub fn integrate(nominal: &mut Nominal, gravity: &LocalGravity, increment: &Increment) -> Step {
    let h = increment.duration();
    let rotation = corrected(&increment.rotation, h, &nominal.gyro_error());
    let velocity = corrected(&increment.velocity, h, &nominal.accel_error());
    let (earth_turn, turn) =
        (UnitQuaternion::new(earth::rate_e() * (-0.5 * h)), UnitQuaternion::new(rotation * 0.5));
    let halfway = earth_turn * nominal.attitude * turn;
    let c_eb = halfway.to_rotation_matrix().into_inner();
    // Turned by half the rotation the increment needs no half-angle term; the next order of the
    // mean rotation matrix over the step differs by theta x (theta x dv) / 24.
    let force = c_eb * (velocity + second_order(&rotation, &velocity));
    let old_velocity = nominal.velocity;
    let weight = gravity.at(&(nominal.position + 0.5 * h * old_velocity));
    let middle = old_velocity + 0.5 * (force + weight * h);
    let pull = weight - 2.0 * earth::rate_e().cross(&middle);
    nominal.velocity += force + pull * h;
    nominal.position += 0.5 * h * (old_velocity + nominal.velocity);
    nominal.attitude = earth_turn * halfway * turn;
    Step { duration: h, c_eb, rotation, velocity }
}

/// Mean acceleration over the Earth, ECEF axes, m/s^2, during an increment at whose end the estimate is.
#[must_use]
pub fn acceleration(
    nominal: &Nominal,
    gravity: &LocalGravity,
    increment: &Increment,
) -> Vector3<f64> {
    let h = increment.duration();
    let rotation = corrected(&increment.rotation, h, &nominal.gyro_error());
    let velocity = corrected(&increment.velocity, h, &nominal.accel_error());
    let middle = nominal.attitude * UnitQuaternion::new(-0.5 * rotation);
    let coriolis = 2.0 * earth::rate_e().cross(&nominal.velocity);
    middle * (velocity / h) + gravity.at(&nominal.position) - coriolis
}

/// Error of a triad: bias (turn-on plus in-run) and scale factor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriadError {
    /// Bias, SI units of the sensor.
    pub bias: Vector3<f64>,
    /// Scale factor, ratio.
    pub scale: Vector3<f64>,
}

impl Nominal {
    /// Estimated gyro error.
    #[must_use]
    pub fn gyro_error(&self) -> TriadError {
        let of_heat = self.warmth.change(&self.gyro_thermal, &self.gyro_thermal_bend);
        TriadError { bias: self.gyro_bias + self.gyro_drift + of_heat, scale: self.gyro_scale }
    }

    /// Estimated accelerometer error.
    #[must_use]
    pub fn accel_error(&self) -> TriadError {
        let of_heat = self.warmth.change(&self.accel_thermal, &self.accel_thermal_bend);
        TriadError { bias: self.accel_bias + self.accel_drift + of_heat, scale: self.accel_scale }
    }
}

/// Removes bias and scale factor from an increment: the sensor gave true (1 + scale) + bias.
fn corrected(increment: &Vector3<f64>, duration: f64, error: &TriadError) -> Vector3<f64> {
    (increment - error.bias * duration).component_div(&error.scale.add_scalar(1.0))
}

/// Angular rate with respect to the Earth in body axes, corrected, rad/s: for lever arms.
#[must_use]
pub fn earth_relative_rate(nominal: &Nominal, measured: &Vector3<f64>) -> Vector3<f64> {
    let rate = corrected(measured, 1.0, &nominal.gyro_error());
    rate - nominal.attitude.inverse_transform_vector(&earth::rate_e())
}

/// An estimate moved to an instant inside or just after the last increment, for output only.
#[must_use]
pub fn extrapolated(nominal: &Nominal, increment: &Increment, at: Time) -> Nominal {
    let mut moved = *nominal;
    if at > increment.from {
        let (head, _) =
            if at < increment.to { increment.split(at) } else { (*increment, *increment) };
        integrate(&mut moved, &LocalGravity::around(&nominal.position, &nominal.geodetic()), &head);
    }
    moved
}
