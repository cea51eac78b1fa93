//! From a navigation solution to the sentences of one port, or the messages of one NMEA 2000 bus: which,
//! how often, and how far each may be trusted.
//!
//! Pure: no I/O, no clock; the UTC of a solution is handed in as a value. Nothing is invented: what
//! the solution does not say stays empty, and what it is not sure of is marked so or not sent.

mod config;
pub mod n2k;
mod policy;
mod port;
mod schedule;
mod sentences;

pub use config::{PortConfig, SentenceKind};
pub use insd_wire::nmea::{CivilTime, Date, TimeOfDay};
pub use policy::{Policy, PositionLimits};
pub use port::Port;
pub use schedule::Rate;
