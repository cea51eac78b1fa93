//! What reaches the computer: bytes, frames, pulses and the state of its ports, each with the time of receipt.
//!
//! These are what a raw recording holds: whoever takes the same arrivals in the same order does the
//! same with them.

use std::fmt;

use crate::can::{BusEvent, CanFrame};
use crate::time::{Span, Time};
use crate::utc::UtcTime;

/// A port by its place in the list of the configuration.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PortId(pub u16);

/// The computer's two clocks, read together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stamp {
    /// Never steps: time since the process started.
    pub monotonic: Time,
    /// UTC as the computer believes; it may be wrong, and it may step.
    pub system: UtcTime,
}

/// What became of a port. Each change is told with its reason.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PortState {
    /// It is open, and bytes may come.
    Open {
        /// What was opened: device and baud rate, address, file.
        what: String,
    },
    /// It could not be opened; it is tried again and again.
    Absent {
        /// What the system said.
        reason: String,
    },
    /// It was open and is gone: unplugged, closed by the peer, an error.
    Lost {
        /// What the system said.
        reason: String,
    },
    /// It is open, and nothing has come for longer than its configured patience.
    Silent {
        /// For how long.
        span: Span,
    },
    /// Bytes come again after a silence.
    Speaking,
    /// More came than could be taken; the oldest waiting bytes were dropped.
    Overrun {
        /// Bytes dropped since the last such report.
        bytes: u64,
    },
    /// A file or recording has been read to its end.
    Ended,
    /// Somebody on the network was not let in.
    Refused {
        /// Address of the host.
        host: String,
        /// Why.
        why: Closed,
        /// Datagrams or calls of it since the last such report.
        count: u64,
    },
}

/// Why a host on the network is not let in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Closed {
    /// It is not one of those from whom the port takes anything.
    NotListed,
    /// It has as many connections as a host may have.
    HostFull,
    /// All connections that the port can have are taken.
    Full,
}

/// Bytes of which it is known who on the network sent them, and whether it may give commands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sent {
    /// Address of the host.
    pub host: String,
    /// Whether its commands are obeyed.
    pub may_command: bool,
    /// The bytes: of a stream as one read gave them, or one datagram.
    pub bytes: Vec<u8>,
}

/// A pulse per second.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pulse {
    /// When the kernel saw its edge, on the monotonic clock.
    pub time: Time,
    /// The kernel's count of edges.
    pub sequence: u32,
}

/// What can arrive.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Input {
    /// Bytes of a stream as one read gave them, or one datagram.
    Bytes(Vec<u8>),
    /// The same from the network, at a port that is listened to for commands.
    Sent(Sent),
    /// A frame of a CAN bus.
    Can(CanFrame),
    /// What the controller says of its CAN bus.
    Bus(BusEvent),
    /// An edge of a pulse line.
    Pulse(Pulse),
    /// Another state of the port.
    State(PortState),
    /// Time has come for the ports that are written to. It arrives from nowhere but our own clock, and is
    /// recorded with the rest: what was sent depends on what had arrived until then.
    Tick,
    /// What the operator orders, or the run before has left. Recorded like all that arrives: what comes
    /// after depends on it.
    Order(Order),
    /// What cannot be written on the disk from here on. Recorded like all that arrives: alerts depend on it.
    Storage(StorageFaults),
}

/// What cannot be written on the disk at present.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct StorageFaults {
    /// The recording.
    pub recording: bool,
    /// What the next start goes on from.
    pub state: bool,
    /// What waits for a fleet.
    pub fleet: bool,
}

/// What is not measured but ordered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Order {
    /// About an alert of this identifier.
    Alert {
        /// Identifier of IEC 62923: a standard one, or one of ours from 10000 on.
        identifier: u32,
        /// What is done about it.
        command: AlertOrder,
    },
    /// From here on another configuration holds: its text.
    Configuration(String),
    /// The navigation of the run before, to go on from.
    Checkpoint {
        /// How long before the stamp of this order it was valid.
        age: Span,
        /// What the engine made.
        state: Vec<u8>,
    },
    /// The state of a ship at her berth that the run before has stored: its text.
    StoredState(String),
    /// The berth of this name is gone alongside; without a name the nearest is proposed.
    Berth(Option<String>),
    /// What was learnt of the sensors on earlier voyages: the text of its file.
    LearntModel(String),
    /// Whether what is learnt of the sensors may be used.
    UseLearnt(bool),
}

/// What an operator can do about an alert.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AlertOrder {
    /// It is known.
    Acknowledge,
    /// It is to be quiet for a while.
    Silence,
}

/// Something that reached the computer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Arrival {
    /// When: for bytes, when the read that gave them returned; for a frame, when the kernel had it.
    pub stamp: Stamp,
    /// Where.
    pub port: PortId,
    /// What.
    pub input: Input,
}

impl Input {
    /// The bytes that it holds, whoever sent them.
    #[must_use]
    pub fn bytes(&self) -> Option<&[u8]> {
        match self {
            Input::Bytes(bytes) | Input::Sent(Sent { bytes, .. }) => Some(bytes),
            _ => None,
        }
    }
}

impl Order {
    /// Bytes of what has no fixed length.
    #[must_use]
    pub fn length(&self) -> usize {
        match self {
            Order::Alert { .. } | Order::UseLearnt(_) => 0,
            Order::Configuration(text) | Order::StoredState(text) | Order::LearntModel(text) => {
                text.len()
            }
            Order::Berth(name) => name.as_ref().map_or(0, String::len),
            Order::Checkpoint { state, .. } => state.len(),
        }
    }
}

impl fmt::Display for PortState {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            PortState::Open { what } => write!(f, "open: {what}"),
            PortState::Absent { reason } => write!(f, "absent: {reason}"),
            PortState::Lost { reason } => write!(f, "lost: {reason}"),
            PortState::Silent { span } => write!(f, "silent for {:.1} s", span.as_seconds()),
            PortState::Speaking => f.write_str("speaking again"),
            PortState::Overrun { bytes } => write!(f, "overrun: {bytes} bytes dropped"),
            PortState::Ended => f.write_str("ended"),
            PortState::Refused { host, why, count } => {
                write!(f, "refused: {host}, {why} (count {count})")
            }
        }
    }
}

impl fmt::Display for Closed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Closed::NotListed => "which is not listed",
            Closed::HostFull => "which has as many connections as one host may have",
            Closed::Full => "for whom there is no connection left",
        })
    }
}
