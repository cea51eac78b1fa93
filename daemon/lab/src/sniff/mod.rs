//! What comes in at the ports, counted and judged, for whoever connects a ship.
//!
//! Pure: [`Sniffed`] takes arrivals and gives a [`SniffReport`]; [`text`] writes it for people. Memory is
//! bounded whatever comes: of ports, messages, talkers and sources the first so many are told apart,
//! the rest is counted together.

mod advice;
pub mod bus;
mod follow;
mod message;
mod named;
mod plan;
mod port;
mod pulses;
pub mod report;
mod satellites;
mod seen;
mod suggestion;
mod tally;
#[cfg(test)]
mod tests;
pub mod text;

use std::collections::BTreeMap;

use insd_base::{Arrival, Input, PortId, Time};
use insd_wire::stream::Protocol;

pub use follow::Follower;
pub use named::is_proof;
pub use plan::{PortToHear, SuggestedTransport};
use port::Port;
pub use report::SniffReport;
pub use seen::{Seen, SeenWhat};
pub use suggestion::quoted;
pub use tally::Counted;

/// Ports that are told apart.
const PORTS: usize = 64;

/// Statistics of all that arrives.
#[derive(Clone, Debug)]
pub struct Sniffed {
    protocols: Vec<Protocol>,
    ports: BTreeMap<PortId, Port>,
    now: Option<Time>,
}

impl Sniffed {
    /// Nothing has arrived yet. Frames of these protocols are looked for.
    #[must_use]
    pub fn new(protocols: &[Protocol]) -> Self {
        Sniffed { protocols: protocols.to_vec(), ports: BTreeMap::new(), now: None }
    }

    /// Makes a port known, unless too many are. Without this a port is known when something arrives at
    /// it.
    pub fn announce(&mut self, id: PortId, plan: PortToHear) {
        if self.ports.len() < PORTS {
            self.ports.insert(id, Port::new(plan, &self.protocols));
        }
    }

    /// Takes one arrival.
    pub fn take(&mut self, arrival: &Arrival) {
        self.take_and_show(arrival, |_| {});
    }

    /// Takes one arrival, and shows what it brings.
    pub fn take_and_show(&mut self, arrival: &Arrival, mut show: impl FnMut(&Seen<'_>)) {
        self.now = self.now.max(Some(arrival.stamp.monotonic));
        if matches!(arrival.input, Input::Tick | Input::Order(_) | Input::Storage(_)) {
            return; // it came to no port
        }
        if !self.ports.contains_key(&arrival.port) {
            let name = format!("port {}", arrival.port.0);
            self.announce(arrival.port, PortToHear { name, timed: true, transport: None });
        }
        if let Some(port) = self.ports.get_mut(&arrival.port) {
            port.take(&arrival.stamp, &arrival.input, &mut show);
        }
    }

    /// Tells of a port what is known by other means than its arrivals.
    pub fn note(&mut self, id: PortId, note: &str) {
        if let Some(port) = self.ports.get_mut(&id) {
            port.notes.push(note.to_owned());
        }
    }

    /// So many bytes were heard at a port while its baud rate was searched, and none could be read.
    pub fn unreadable(&mut self, id: PortId, bytes: u64) {
        if let Some(port) = self.ports.get_mut(&id) {
            port.unreadable = bytes;
        }
    }

    /// Whether it is known of every port whether it can be opened.
    #[must_use]
    pub fn is_settled(&self) -> bool {
        self.ports.values().all(Port::is_settled)
    }

    /// Whether nothing can come any more: all ports have been read to their end.
    #[must_use]
    pub fn is_ended(&self) -> bool {
        self.ports.values().all(Port::is_ended)
    }

    /// When the last arrival came.
    #[must_use]
    pub fn last(&self) -> Option<Time> {
        self.now
    }

    /// What is known at this time.
    #[must_use]
    pub fn report(&self, now: Time) -> SniffReport {
        SniffReport { ports: self.ports.values().map(|port| port.report(now)).collect() }
    }
}
