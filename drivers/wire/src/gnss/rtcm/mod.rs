//! RTCM 10403 ("RTCM3"): frames, so that a mixed stream is cut well and corrections are passed on; and what a base says
//! of its place, its measurements (MSM4 to MSM7; MSM7 is written) and the satellites' orbits.
//!
//! Readers never panic, whatever the bytes. They are our own, over the field tables that navigation messages are read by: one reader
//! for all constellations is shorter than one type for each message and constellation would be to take apart.

mod collector;
mod frame;
mod glonass;
mod kepler;
mod msm;
mod signal;
mod station;
mod writer;

pub use collector::{Correction, MsmCollector, is_of_satellites};
pub use frame::{Frame, look};
pub use msm::Msm;
pub use station::BaseStation;
pub use writer::{MsmWriter, write_record};

/// DF002: the number of every message.
const NUMBER: super::bits::Field = super::bits::Field::count(0, 12);
