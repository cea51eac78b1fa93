//! Time: whose clock says what, and when that was on the computer's own.
//!
//! The ship's time line is the computer's monotonic clock. It never steps, whatever receivers, devices
//! and the system clock do. Every other clock (a device's counter, UTC) is tied to it by a
//! [`ClockMap`], and an error of such a tie shifts times of validity by micro- to milliseconds, never
//! the line itself.

mod map;
mod pulses;
mod system;
mod unwrap;
mod utc;

pub use map::{ClockMap, MapChange, Observed};
pub use pulses::{Labelled, PulseFault, Pulses};
pub use system::SystemWatch;
pub use unwrap::Unwrap;
pub use utc::{ShipUtc, TimeChange, TimeQuality};
