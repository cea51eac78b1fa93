//! CAN buses: interfaces of the kernel, adapters at a serial line, gateways, logs, and buses in memory.
//!
//! [`spawn`] starts a port with a task of its own, as [`crate::ports::spawn`] does: frames, what the
//! controller says, and each change of state go into the queue that all ports share. With a [`Speaker`]
//! the task also sends what that has to say, and wakes it when it wants; without one the port listens and
//! **no frame is ever written**.
//!
//! | trouble | what is told | what is done |
//! |---|---|---|
//! | the interface is not there, or down | `Absent`, once for each reason | tried again every 0.2 s |
//! | it goes down, or away; it is another under the same name | `Lost` | closed, then as above |
//! | adapter or gateway not there, or gone | `Absent`, `Lost` | as with all ports: 0.2 s, doubling to 5 s |
//! | the controller leaves the bus | bus off | nothing is sent until it is back, a frame is heard, or 0.5 s has passed; then the speaker is told |
//! | the kernel's queue is full | nothing | the speaker keeps its frame, and is asked again soon |
//! | the kernel dropped frames that came | frames dropped | |
//! | more than the consumer takes | `Overrun`, each frame as [`crate::ports::FRAME`] bytes | the oldest frames of that port go |
//!
//! Sending never waits, so it never holds up listening. Own frames and remote frames are never heard.
//!
//! Frames of the kernel's interfaces carry the kernel's time of receipt, all others that of the read
//! that brought them: a gateway's own times are not believed.

mod config;
mod error_frame;
mod gateway;
pub mod memory;
mod node;
mod socket;
mod speaker;
mod stream;
mod task;
#[cfg(test)]
mod tests;
mod words;

use std::future::Future;
use std::net::IpAddr;
use std::time::Duration;

use insd_base::{BusEvent, CanFrame, Stamp};

use crate::ports::LONGEST_PAUSE;

pub use config::{
    CanConfig, CanFilter, CanTransport, Candump, GatewayFormat, GatewayTcp, GatewayUdp, Slcan,
    Socketcan,
};
pub use speaker::{SharedSpeaker, Speaker};
pub use task::{spawn, spawn_on};

/// An open bus.
pub trait CanBus: Send {
    /// Waits for what comes next. If a frame was refused, a bus that knows when there is room again says
    /// that, too. Nothing is lost when the future is dropped.
    ///
    /// # Errors
    /// The reason for which the bus is lost.
    fn next(&mut self, refused: bool) -> impl Future<Output = Result<Heard, String>> + Send;

    /// Hands over a frame, and never waits.
    ///
    /// # Errors
    /// The reason for which the bus is lost.
    fn try_send(&mut self, frame: &CanFrame) -> Result<Sending, String>;
}

/// Opens a bus, again and again when it was lost.
pub trait Opener: Send + 'static {
    /// What it opens.
    type Bus: CanBus;

    /// Longest pause between two attempts; the first is 0.2 s, and each is twice the one before.
    const LONGEST_PAUSE: Duration = LONGEST_PAUSE;

    /// Whether the bus can wait for the consumer: a log can.
    const WAITS: bool = false;

    /// Opens it. Gives the bus, and what people call it.
    ///
    /// # Errors
    /// The reason why it cannot be had.
    fn open(&mut self) -> impl Future<Output = Result<(Self::Bus, String), String>> + Send;
}

/// What comes from a bus.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Heard {
    /// A data frame, and when it came.
    Frame(Stamp, CanFrame),
    /// Something that the controller says.
    Event(Stamp, BusEvent),
    /// A host on the network that is not listed sent something.
    Stranger(IpAddr),
    /// There may be room for a frame again.
    Room,
    /// The log is at its end.
    End,
}

/// What became of a frame that was to be sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sending {
    /// It was handed over.
    Sent,
    /// There is no room for it now.
    Full,
}
