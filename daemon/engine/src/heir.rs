//! Who takes over from the bank of headings once a receiver is heard.
//!
//! The bank takes the noise of coarse gyros for motion and what GNSS says of that for a heading. Until a receiver is
//! heard there is nothing to compare it with; from then on the filter of eight states, which knows of it, finds
//! the heading from the beginning, upright as the bank has left her.

use insd_alignment::kinematics::Kinematics;
use insd_alignment::{Bank, Level};
use insd_base::{Message, Received, earth};
use insd_nav::berth::Method;
use insd_nav::{Estimator, NavConfig};
use nalgebra::Vector3;

/// Velocity of a ship of which only positions are told, 1-sigma, m/s: at her berth, and under way.
const SWAYING: f64 = 2.0;
const SAILING: f64 = 10.0;
/// Error of her first position, the lever arm included, 1-sigma, m.
const PLACE: f64 = 100.0;

/// The filter of eight states to be.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Heir {
    pub(crate) config: NavConfig,
    method: Method,
}

/// What it begins with: the level and the motion she has, and how she is held if she lies at her berth.
pub(crate) type Heritage = (Level, Kinematics, Option<Method>);

impl Heir {
    /// `method` is how a ship at her berth will be held by the full filter.
    pub(crate) fn new(config: &NavConfig, method: Method) -> Self {
        Heir { config: *config, method }
    }

    /// What the filter of eight states begins with, if the message is a position of a receiver.
    pub(crate) fn called_by(&self, received: &Received, bank: &Bank) -> Option<Heritage> {
        let Message::Gnss(fix) = received.message else { return None };
        let position = fix.position.filter(|_| fix.quality.is_measured())?;
        let navigator = bank.likeliest()?;
        let solution = navigator.solution();
        let gravity = earth::normal_gravity(position.latitude, position.height);
        let force = solution.attitude.c_nb().transpose() * Vector3::new(0.0, 0.0, -gravity);
        let level = Level { time: navigator.filter().time(), force, rate: solution.rate.0 };
        let moored = bank.is_moored();
        let told = fix.velocity.map(|velocity| velocity.0);
        let unsure = if moored { SWAYING } else { SAILING };
        let kinematics = Kinematics {
            position,
            position_std: PLACE,
            velocity: told.unwrap_or_else(Vector3::zeros),
            velocity_std: told.map_or(unsure, |_| 3.0),
            acceleration: Vector3::zeros(),
            moored,
            gnss_position: true,
            gnss_velocity: told.is_some(),
        };
        Some((level, kinematics, moored.then_some(self.method)))
    }
}
