//! Aids: one file each, all of the same shape. From the estimate and a measurement to an innovation
//! with its measurement matrix and noise; nothing is changed here.

pub mod antenna_heading;
pub mod antenna_phases;
pub mod berth;
pub mod gnss_position;
pub mod gnss_velocity;
pub mod log_velocity;
pub mod ranging;
pub mod reference_heading;
pub mod reference_position;
pub mod reference_velocity;
pub mod satellite_range;
pub mod sea_level;

use insd_base::attitude::skew;
use insd_base::earth;
use insd_base::{Attitude, Geodetic};
use nalgebra::{Matrix3, UnitQuaternion, Vector3};

use crate::dating::Dating;
use crate::nominal::Nominal;
use crate::strapdown::earth_relative_rate;

/// The estimate with what every aid needs of it, computed once per measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// The estimate.
    pub nominal: Nominal,
    /// Geodetic position of the IMU.
    pub geodetic: Geodetic,
    /// Rotation from ECEF to NED axes.
    pub c_ne: Matrix3<f64>,
    /// Rotation from body to ECEF axes.
    pub c_eb: Matrix3<f64>,
    /// Angular rate of the body with respect to the Earth, body axes, rad/s.
    pub rate: Vector3<f64>,
    /// Angular rate with respect to inertial space as measured, body axes, rad/s: what a scale factor
    /// acts on.
    pub inertial_rate: Vector3<f64>,
    /// Variance of the noise of that rate, (rad/s)^2, each axis.
    pub rate_variance: f64,
}

impl View {
    /// A view of an estimate; `measured_rate` is the gyros' rate with respect to inertial space at
    /// this instant, rad/s, and `rate_variance` the variance of its noise.
    #[must_use]
    pub fn new(nominal: &Nominal, measured_rate: &Vector3<f64>, rate_variance: f64) -> Self {
        let geodetic = nominal.geodetic();
        View {
            nominal: *nominal,
            geodetic,
            c_ne: earth::c_ne(&geodetic),
            c_eb: nominal.c_eb(),
            rate: earth_relative_rate(nominal, measured_rate),
            inertial_rate: *measured_rate,
            rate_variance,
        }
    }

    /// The estimate at the instant that GNSS time, not the IMU's time base, calls now: earlier by what the stamps of
    /// the IMU are behind. `acceleration` in ECEF axes, m/s^2.
    #[must_use]
    pub fn at_gnss_time(&self, acceleration: &Vector3<f64>, dating: &Dating) -> Self {
        let delay = self.nominal.gnss_delay * dating.share;
        let mut nominal = self.nominal;
        nominal.position -= self.nominal.velocity * delay;
        nominal.velocity -= acceleration * delay;
        nominal.attitude *= UnitQuaternion::new(self.rate * -delay);
        let geodetic = nominal.geodetic();
        View { nominal, geodetic, c_ne: earth::c_ne(&geodetic), c_eb: nominal.c_eb(), ..*self }
    }

    /// Rotation from body to NED axes.
    #[must_use]
    pub fn c_nb(&self) -> Matrix3<f64> {
        self.c_ne * self.c_eb
    }

    /// Earth rate in body axes by attitude error: C_be [omega_ie x], which the rate with respect to
    /// the Earth loses.
    #[must_use]
    pub fn earth_rate_by_attitude(&self) -> Matrix3<f64> {
        self.c_eb.transpose() * skew(&earth::rate_e())
    }

    /// Roll, pitch and heading.
    #[must_use]
    pub fn attitude(&self) -> Attitude {
        Attitude::from_c_nb(&self.c_nb())
    }

    /// Velocity in NED axes, m/s.
    #[must_use]
    pub fn v_n(&self) -> Vector3<f64> {
        self.c_ne * self.nominal.velocity
    }
}

#[cfg(test)]
mod tests;
