//! What is handed to an output, and what became of it: plain types.

use insd_base::{PortState, Span, Time};

/// A message on its way out.
#[derive(Clone, Debug, PartialEq)]
pub struct Outgoing {
    /// What kind of message it is: a newer one of the same slot takes the place of one that still waits.
    pub slot: u16,
    /// The message: a sentence, a telegram. Where datagrams are sent it is one datagram.
    pub bytes: Vec<u8>,
    /// Time of validity of what it says, on the monotonic clock of
    /// [`Surroundings::clock`](super::Surroundings::clock).
    pub valid: Time,
    /// After `valid + period` the next one of its slot is due, and this one is not started any more
    /// (but see [`spawn_output`](super::spawn_output) about a message that comes late). Of a message
    /// that has no successor: how long it is worth sending.
    pub period: Span,
}

/// What an output has done since its start.
#[derive(Clone, Debug, PartialEq)]
pub struct OutputStatus {
    /// What was told last; `None` before anything was told.
    pub state: Option<PortState>,
    /// How often it was tried to open the port.
    pub attempts: u64,
    /// Messages handed over whole to the system.
    pub sent: u64,
    /// Messages that will never leave.
    pub dropped: u64,
    /// Messages that wait or are being written.
    pub waiting: u64,
    /// Bytes of the messages sent.
    pub bytes: u64,
    /// The same for each slot of which something was handed over, by its number.
    pub slots: Vec<SlotStatus>,
}

/// What became of the messages of a slot. All that were handed over are sent, dropped or waiting. A TCP
/// server counts each message once for each of its clients, and not at all while there is none.
#[derive(Clone, Debug, PartialEq)]
pub struct SlotStatus {
    /// The slot.
    pub slot: u16,
    /// Messages handed over whole to the system.
    pub sent: u64,
    /// Messages that will never leave: replaced by a newer one, too old, or lost with the device.
    pub dropped: u64,
    /// Messages that wait or are being written.
    pub waiting: u64,
    /// Of those sent: forgotten because nobody read them. Only a made terminal can tell.
    pub unread: u64,
    /// Bytes of the messages sent.
    pub bytes: u64,
    /// How old they were; `None` before the first.
    pub age: Option<AgeStatus>,
}

/// How old messages were when they left: from the time of validity until the last byte was handed to
/// the system, and on a line of a known pace until it had left the wire, as reckoned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AgeStatus {
    /// Of the last message.
    pub last: Span,
    /// Of the oldest since the start.
    pub max: Span,
    /// The median of the last tens of thousands, 3 % or 16 microseconds too high at most.
    pub p50: Span,
    /// The age that 99 % of the last tens of thousands did not exceed, to the same accuracy.
    pub p99: Span,
}
