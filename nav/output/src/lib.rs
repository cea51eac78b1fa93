//! From the newest there is to know of the ship to the messages of every port, and of every NMEA 2000 bus:
//! which, when, and how far each may be trusted.
//!
//! Pure: no I/O, no clock; time and UTC are handed in as values. Nothing is invented: what is not known
//! stays empty, and what is not sure is marked so or not sent.
//!
//! [`OutputStation`] knows when something is due, carries the newest motion on to that instant and to each
//! port's monitoring point, and lets the ports speak. `docs/outputs.md` has the messages field by field,
//! the profiles and the policy.

pub mod alerts;
pub mod docking;
mod epoch;
mod lan;
mod manner;
mod messages;
pub mod n2k;
mod policy;
mod port;
mod profile;
mod redacted_epoch;
mod schedule;
mod station;

pub use epoch::{Contradicted, Distance, Doubts, OutputEpoch, SatelliteGeometry, Variation};
pub use insd_wire::nmea::{CivilTime, Date, Sfi, Talker, TimeOfDay, TransmissionGroup};
pub use lan::{Datagram, Lan, LanConfig};
pub use manner::Manner;
pub use messages::{Content, MessageKind};
pub use policy::{Policy, PositionLimits};
pub use port::{OutputPortConfig, Port, PortMessage};
pub use profile::Profile;
pub use redacted_epoch::Ellipse;
pub use schedule::{Boundary, Due, Pacer, Rate, WakeUp};
pub use station::{OutputStation, Situation};
