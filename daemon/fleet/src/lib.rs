//! What leaves the ship for a fleet, and what takes it in ashore.
//!
//! On board ([`start`]) a thread of its own looks at the newest snapshot, as the status page does: nothing of it
//! can delay the engine, which swaps a pointer and knows of nobody. What is to be told is put away in a [`spool`] on
//! disk and sent over MQTT 5, one message in flight, within a [`budget`]. Nothing is ever received: the
//! connection subscribes to nothing.
//!
//! Ashore ([`sink`]) messages are written to a database; a message is acknowledged when its
//! records are there, and those that come twice have the same key.
//!
//! No clock is read here: who starts it says what tells the time.

pub mod budget;
mod courier;
mod iso19848;
pub mod key;
mod link;
pub mod payload;
pub mod plan;
mod signal_k;
pub mod simulate;
pub mod sink;
pub mod spool;
mod steady;
mod tls;
mod told;
mod watch;

pub use courier::{FleetHandle, FleetNow, FleetStatus, start};
pub use plan::{BrokerPlan, FleetPayload, FleetPlan};
