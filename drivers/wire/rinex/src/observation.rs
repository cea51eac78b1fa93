//! Files of observations: what receivers measured.

mod codes;
mod header;
mod reader;
mod rows;
#[cfg(test)]
mod tests;
mod write;

pub(crate) use header::{Draft, leap_seconds, version};
pub use header::{Equipment, ObservationHeader};
pub use reader::ObservationReader;
pub(crate) use rows::{instant, satellite};
pub use write::{write_moving, write_observations};
