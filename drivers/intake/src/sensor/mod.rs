//! What becomes of the readings of each family of sensors.

mod gnss;
mod gravity;
mod imu;
mod pace;
mod warmth;

pub use gnss::{Epoch, EpochBuilder};
pub use gravity::Gravity;
pub use imu::{ImuChange, ImuIntake, ImuSettings, TimeBase};
pub use pace::Pace;
pub use warmth::Warmth;
