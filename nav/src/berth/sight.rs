//! What those who look on, or ahead, may see of how a ship is held.

use insd_base::{SeaFit, SeaQuantity, Time};
use nalgebra::Vector2;

use crate::disturbance::Model;
use crate::error_state::Innovation;
use crate::method::Method;

/// The sea as a model has it that holds a ship, for those who look on.
#[derive(Clone, Debug)]
pub struct SeaSight {
    /// The method that it is of; nothing for a model that holds nobody.
    pub method: Option<Method>,
    /// The model.
    pub model: Model,
    /// What of.
    pub quantity: SeaQuantity,
    /// What was seen without a gap until now, at the model's interval, oldest first, m or m/s.
    pub samples: Vec<Vector2<f64>>,
    /// How well the model fits, where that is looked at.
    pub fit: Option<SeaFit>,
}

/// What the berth says next, if nothing moves: for looking ahead.
#[derive(Clone, Debug)]
pub struct BerthSample {
    /// The sample, with the noise of one.
    pub innovation: Innovation,
    /// From one to the next, s.
    pub spacing: f64,
    /// Since when the ship is held so.
    pub start: Time,
}
