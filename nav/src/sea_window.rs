//! The mean height over a window of waves.
//!
//! Heave is narrow-band: single heights would alias the waves into a slow drift. Over a window of
//! several waves the heave nearly cancels, and what is left of it is learnt from the data.

use serde::{Deserialize, Serialize};

use crate::config::SeaModel;
use crate::spread::Spread;

/// Length of the window, s.
const WINDOW: f64 = 20.0;

/// Heights summed since the last mean was taken, and the spread of the means.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LevelWindow {
    sum: f64,
    length: f64,
    /// Spread of the mean heave.
    pub heave: Spread,
}

impl LevelWindow {
    /// An empty window.
    #[must_use]
    pub fn new(sea: &SeaModel) -> Self {
        LevelWindow {
            sum: 0.0,
            length: 0.0,
            heave: Spread::new(sea.initial_mean_heave, sea.least_mean_heave),
        }
    }

    /// Adds a height, m, that held for `duration` s.
    pub fn add(&mut self, height: f64, duration: f64) {
        self.sum += height * duration;
        self.length += duration;
    }

    /// Whether the window is complete.
    #[must_use]
    pub fn is_full(&self) -> bool {
        self.length >= WINDOW
    }

    /// The mean height, m, and the length of the window, s; starts a new one.
    pub fn take_mean(&mut self) -> (f64, f64) {
        let taken = (self.sum / self.length, self.length);
        self.restart();
        taken
    }

    /// Starts a new window.
    pub fn restart(&mut self) {
        self.sum = 0.0;
        self.length = 0.0;
    }
}
