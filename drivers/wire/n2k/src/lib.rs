//! NMEA 2000: from frames of a CAN bus to parameter groups and back, and the behaviour of a node.
//!
//! Pure: no I/O, no clock, no thread, no log. Time is handed in; what is to be sent is handed out.
//! Readers never panic, whatever the bytes. SI units and radians in every struct; "not available" is
//! `None`.

mod id;
mod message;
pub mod node;
pub mod pgn;

pub use id::{BROADCAST, N2kId, NULL_ADDRESS};
pub use message::Message;
