//! Differences of carrier phase between two epochs: how far an antenna has moved, to millimetres, without any ambiguity.

mod change;
mod displacement;
mod ionosphere;
mod observed;
mod scatter;
mod tracker;

pub use change::PhaseChange;
pub use displacement::CarrierDisplacement;
pub use tracker::CarrierTracker;
