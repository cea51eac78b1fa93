//! Bytes to messages and back: one folder for each family of formats, and in it the writer and the
//! reader of a sentence in one file.
//!
//! Pure: no I/O, no clock, no thread, no log. Readers never panic, whatever the bytes; what they
//! refuse they refuse with a reason. SI units and radians in every struct; degrees and knots live
//! between the commas only.

pub mod binary;
pub mod describe;
pub mod gnss;
pub mod imu;
mod layout;
pub mod log;
pub mod motion;
pub mod ngt1;
pub mod nmea;
pub mod signalk;
pub mod stream;
