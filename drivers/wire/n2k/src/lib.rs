//! NMEA 2000: from frames of a CAN bus to parameter groups and back, and the behaviour of a node.
//!
//! Pure: no I/O, no clock, no thread, no log. Time is handed in; what is to be sent is handed out.
//! Readers never panic, whatever the bytes. SI units and radians in every struct; "not available" is
//! `None`.

mod assembler;
mod bytes;
mod codes;
pub mod fast_packet;
pub mod groups;
mod id;
mod message;
mod name;
pub mod node;
pub mod pgn;
mod roster;
pub mod text;
mod transport;

pub use assembler::{Assembled, Assembler, AssemblerCounts};
pub use codes::{class_name, function_name, manufacturer_name};
pub use id::{BROADCAST, N2kId, NULL_ADDRESS, is_addressed};
pub use message::BusMessage;
pub use name::{Name, NameParts, NoName};
pub use roster::{ADDRESS_CLAIM, LAST_ADDRESS, Roster, RosterChange};
