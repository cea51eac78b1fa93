//! Files of observations: what receivers measured.

mod codes;
mod header;
mod reader;
mod rows;
#[cfg(test)]
mod tests;
mod write;

pub use header::{Equipment, ObservationHeader};
pub(crate) use header::{leap_seconds, version};
pub use reader::ObservationReader;
pub(crate) use rows::satellite;
pub use write::write_observations;
