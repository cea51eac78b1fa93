//! The ports of the computer: serial lines, UDP and TCP, files, named pipes, pulses and CAN.
//!
//! [`spawn`] starts a port with a task of its own, which reads into a bounded [`queue()`] that all ports
//! share and one consumer empties. What a port does about trouble:
//!
//! | trouble | what is told | what is done |
//! |---|---|---|
//! | absent at the start, or refused | `Absent`, once for each reason | tried again after 0.2 s, doubling to 5 s |
//! | unplugged, closed, an error | `Lost` | closed at once, then as above |
//! | nothing comes | `Silent` once, then `Speaking` | the group of a silent multicast is joined again |
//! | more than the consumer takes | `Overrun`, once a second at most | the oldest bytes of that port go, see [`Queue`] |
//! | a wrong baud rate | `Absent`, with the rates | if rates to probe are given, listens on at each |
//! | a caster refuses, answers something else, or sends no corrections | `Absent` or `Lost` with a word for it | called again after pauses that grow up to a minute |
//!
//! A CAN port does the same in its own way, see [`crate::can`].
//!
//! Nothing is ever written to a port that is not configured for writing; no baud rate is searched by
//! writing.
//!
//! Who is not let in, because the configuration does not list it or because it has enough connections, is
//! told as `Refused`: at once, then once a minute with a count.
//!
//! [`spawn_output`] starts a port that is only written to. What it is handed is data that grow old:
//!
//! | trouble | what is done |
//! |---|---|
//! | a device or client takes less than it is handed | the newest message of each [slot](Outgoing) waits, older ones are dropped and counted |
//! | a message waits for longer than its period | it is not started any more |
//! | a list is longer than a serial line can carry | every slot has its turn, see [`spawn_output`] |
//! | the system would take more than the line carries | it is given a message when the line is nearly free, by reckoning and by what the driver holds |
//! | nobody reads a made terminal | what is a second old is forgotten |
//! | a client does not read | the system is let hold little for it; after some 20 s it is let go |
//!
//! [`OutputPort::status`] tells what left and how old it was.
//!
//! The time of receipt is that of the return of a read, by the given [`Clock`]; of pulses and of frames of
//! the kernel's CAN interfaces it is the kernel's.

mod attempt;
mod cable;
mod chrony;
mod clock;
mod config;
mod doorman;
mod file;
mod found;
mod handle;
mod histogram;
mod hosts;
mod judge;
mod low_latency;
mod ntrip;
mod outbox;
mod outgoing;
mod pace;
mod pps;
mod probe;
mod pty;
mod queue;
mod run;
mod serial;
mod stream;
mod surroundings;
mod tally;
mod tcp;
mod teller;
mod udp;
mod waiting;

pub use cable::{Cable, cable};
pub use chrony::{ChronySock, Leap, SAMPLE_LENGTH, Sample};
pub use clock::Clock;
pub use config::{
    Destination, Edge, File, FlowControl, OutputConfig, Parity, PortConfig, Pps, Pty, Serial,
    SerialMode, TcpClient, TcpServer, Transport, Udp, UdpOutput,
};
pub use found::{FoundKind, FoundPort, list};
pub use handle::{OutputPort, PortHandle};
pub use hosts::{Hosts, Network, NoNetwork};
pub use judge::{BaudJudge, BaudJudgement};
pub use ntrip::{Ntrip, read_password};
pub use outgoing::{AgeStatus, Outgoing, OutputStatus, SlotStatus};
pub use queue::{FRAME, Queue, Receiver, WAITING_LIMIT, queue};
pub use run::{spawn, spawn_output};
pub use surroundings::Surroundings;

pub(crate) use attempt::{FIRST_PAUSE, LONGEST_PAUSE, Outcome, Pause, tell};
pub(crate) use clock::{both_clocks, monotonic_at};
pub(crate) use serial::{Line, open_line};
pub(crate) use tcp::{CALLING, keep_alive};
pub(crate) use teller::Teller;
