//! What came, for showing it at once.

use insd_base::{BusEvent, CanFrame, PortState, Stamp};
use insd_wire::describe::ReadOutcome;
use insd_wire::stream::Protocol;

/// Something that came, for showing it at once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen<'a> {
    /// Name of its port.
    pub port: &'a str,
    /// Whether the clocks at its receipt mean anything: not those of a file, which is read as fast as can be.
    pub timed: bool,
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
        read: ReadOutcome,
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
