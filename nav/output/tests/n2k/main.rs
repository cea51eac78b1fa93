//! What a voice says on an NMEA 2000 bus of what is known.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

mod config;
mod load;
mod meaning;
mod schedule;
mod ship;
mod validity;
