//! RTCM 10403 ("RTCM3"): frames, so that a mixed stream is cut well and corrections are passed on; and what a base says
//! of its place, its measurements (MSM4 to MSM7) and the satellites' orbits.
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

pub use collector::{Correction, MsmCollector, is_of_satellites};
pub use frame::{Frame, look};
pub use msm::Msm;
pub use station::BaseStation;
