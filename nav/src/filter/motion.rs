//! What the newest increment tells of the ship's motion, for outputs.

use insd_base::{Current, Ned, earth};
use nalgebra::UnitQuaternion;

use super::Filter;
use crate::error_state::CURRENT;
use crate::heave::VerticalStep;
use crate::increments::Increment;
use crate::strapdown;

/// Time after the last measured speed through the water at which the current is no longer told, s.
const CURRENT_TIMEOUT: f64 = 60.0;

impl Filter {
    /// Mean acceleration over the Earth during an increment that the filter has just moved over, NED axes,
    /// m/s^2: its specific force without the estimated errors, turned by the attitude in its middle, with
    /// gravity and Coriolis. Groves, 2nd ed., eq. (5.84).
    #[must_use]
    pub fn acceleration(&self, increment: &Increment) -> Ned {
        let c_ne = earth::c_ne(&self.state.nominal.geodetic());
        Ned(c_ne * strapdown::acceleration(&self.state.nominal, &self.state.gravity, increment))
    }

    /// The vertical part of an increment that the filter has just moved over, for heave. The estimated
    /// errors of the accelerometers stay in it: they change with every correction, and what is constant
    /// leaves no heave.
    #[must_use]
    pub fn vertical_step(&self, increment: &Increment) -> VerticalStep {
        let (h, nominal) = (increment.duration(), &self.state.nominal);
        let rotation = increment.rotation - nominal.gyro_error().bias * h;
        let middle = nominal.attitude * UnitQuaternion::new(-0.5 * rotation);
        let weight = self.state.gravity.at(&nominal.position);
        let up = -weight.normalize();
        let coriolis = 2.0 * earth::rate_e().cross(&nominal.velocity);
        let rise = nominal.velocity.dot(&up);
        // up itself turns as she sails round the Earth
        let turn = (nominal.velocity.norm_squared() - rise * rise) / nominal.position.norm();
        let velocity =
            up.dot(&(middle * increment.velocity)) + h * (up.dot(&(weight - coriolis)) + turn);
        let down_b = nominal.attitude.inverse_transform_vector(&-up);
        VerticalStep { to: increment.to, duration: h, velocity, down_b }
    }

    /// Velocity of the water, while a log tells the speed through it.
    #[must_use]
    pub fn current(&self) -> Option<Current> {
        let last = self.heard.water?;
        let fresh = (self.state.time - last).as_seconds() < CURRENT_TIMEOUT;
        let (velocity, sigma) = (self.state.nominal.current, CURRENT.stds(&self.state.covariance));
        fresh.then(|| Current {
            velocity: Ned::new(velocity.x, velocity.y, 0.0),
            sigma: Ned::new(sigma.x, sigma.y, 0.0),
        })
    }
}
