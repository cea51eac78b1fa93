//! How a current goes on.

use serde::{Deserialize, Serialize};

/// How a current goes on: Gauss-Markov.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CurrentModel {
    /// 1-sigma of each component, m/s.
    pub std: f64,
    /// Time constant, s.
    pub time: f64,
}
