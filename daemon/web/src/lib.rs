//! The status page: what the daemon knows of itself, for a browser, for programs and for monitoring.
//!
//! The engine's thread hands over a [`snapshot::Snapshot`] up to ten times a second
//! ([`Publisher::publish`]), which waits for nobody. Everything else runs on one thread of normal
//! priority ([`start`]): pages, JSON, events, metrics, and the few orders that may come back
//! ([`orders`]). Nothing can be changed over the network unless a token is configured.
//!
//! No clock is read here: what tells time is the snapshot.

mod channel;
mod config;
pub mod orders;
mod server;
pub mod snapshot;

pub use channel::{Publisher, Viewer, channel};
pub use config::{Listen, MIN_TOKEN, WebConfig, WebError};

/// Target of the lines of the journal that are about security: no level switches them off.
pub const SECURITY: &str = "security";
pub use orders::{OrderReceiver, OrderSender, PageOrder, Request};
pub use server::{FleetBoardText, WebHandle, start, start_fleet};
