//! What comes in at the ports, counted and judged, for whoever connects a ship.
//!
//! Pure: [`Sniffed`] takes arrivals and gives a [`Report`]; [`text`] writes it for people. Memory is
//! bounded whatever comes: of ports, messages, talkers and sources the first so many are told apart,
//! the rest is counted together.

mod advice;
pub mod bus;
mod message;
mod named;
mod port;
mod pulses;
pub mod report;
mod suggestion;
mod tally;
#[cfg(test)]
mod tests;
pub mod text;

use std::collections::BTreeMap;

use insd_base::{Arrival, BusEvent, CanFrame, Input, PortId, PortState, Stamp, Time};
use insd_wire::describe::Reading;
use insd_wire::stream::Protocol;

pub(crate) use named::is_proof;
use port::Port;
pub use report::Report;
pub(crate) use suggestion::quoted;

/// Ports that are told apart.
const PORTS: usize = 64;

/// Statistics of all that arrives.
#[derive(Clone, Debug)]
pub struct Sniffed {
    protocols: Vec<Protocol>,
    ports: BTreeMap<PortId, Port>,
    now: Option<Time>,
}

/// Something that came, for showing it at once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen<'a> {
    /// Name of its port.
    pub port: &'a str,
    /// The clocks at its receipt: of a frame, when its last byte came.
    pub stamp: Stamp,
    /// What it is.
    pub what: SeenWhat<'a>,
}

/// What came.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SeenWhat<'a> {
    /// A frame.
    Frame {
        /// How it is framed.
        protocol: Protocol,
        /// Name of the message.
        name: &'a str,
        /// What becomes of it.
        read: Reading,
        /// Why it is refused.
        reason: Option<&'a str>,
        /// All its bytes.
        bytes: &'a [u8],
    },
    /// Bytes of one read, of which some belong to no frame.
    Stray {
        /// How many belong to none, those of earlier reads included that are only now known.
        count: u64,
        /// All bytes of the read.
        bytes: &'a [u8],
    },
    /// A frame of a CAN bus.
    Can(CanFrame),
    /// What a controller says of its bus.
    Bus(BusEvent),
    /// The edge of a pulse with its number.
    Pulse {
        /// The kernel's count of edges.
        sequence: u32,
    },
    /// Another state of the port.
    State(&'a PortState),
}

/// What is known of a port before anything arrives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Plan {
    /// Its name.
    pub name: String,
    /// Whether the times of receipt mean anything: not those of a file, which is read as fast as can
    /// be.
    pub timed: bool,
    /// The `transport` of a configuration, as TOML, if one can be suggested.
    pub transport: Option<Transport>,
}

/// What a configuration opens, for the suggestion.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Transport {
    /// A serial device by its lasting name; the rate is that which was found.
    Serial {
        /// Path of the device.
        device: String,
    },
    /// Anything else, as an inline table.
    Other(String),
}

impl Sniffed {
    /// Nothing has arrived yet. Frames of these protocols are looked for.
    #[must_use]
    pub fn new(protocols: &[Protocol]) -> Self {
        Sniffed { protocols: protocols.to_vec(), ports: BTreeMap::new(), now: None }
    }

    /// Makes a port known, unless too many are. Without this a port is known when something arrives at
    /// it.
    pub fn announce(&mut self, id: PortId, plan: Plan) {
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
            self.announce(arrival.port, Plan { name, timed: true, transport: None });
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
    pub fn report(&self, now: Time) -> Report {
        Report { ports: self.ports.values().map(|port| port.report(now)).collect() }
    }
}
