//! Alignment: from nothing but sensor data to the initial state that navigation starts from.
//!
//! [`levelling`] finds which way is down while the ship moves; [`bank`] runs one filter for each
//! heading that the ship could have until the data have chosen one. Both work at rest (the Earth's
//! rotation tells the heading), in a swell and under way (GNSS velocity against specific force
//! tells it).
//!
//! Pure: no I/O, no clock, no thread, no randomness.

pub mod bank;
pub mod config;
pub mod forecast;
pub mod in_motion;
pub mod kinematics;
pub mod levelling;
pub mod mixture;
mod progress;
pub mod stored;
pub mod trial;

pub use bank::Bank;
pub use config::{AlignmentConfig, InMotion};
pub use in_motion::EightState;
pub use levelling::{Level, Levelling};
pub use stored::StoredState;
pub use trial::StoredVerdict;
