//! The ports that are listened to and written to, and the CAN buses.

use serde::{Deserialize, Serialize};

/// How a port is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ShownPortState {
    /// Nothing was told yet.
    Waiting,
    /// It is open.
    Open,
    /// It cannot be opened; it is tried again and again.
    Absent,
    /// It was open and is gone; it is tried again and again.
    Lost,
    /// It is open, and nothing has come for longer than its patience.
    Silent,
    /// A file or recording has been read to its end.
    Ended,
    /// A word that this version does not know.
    #[default]
    #[serde(other)]
    Unknown,
}

/// A port that is listened to.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ShownInput {
    /// Its name.
    pub name: String,
    /// What it is: `serial`, `udp`, `tcp-client`, `tcp-server`, `socketcan`, `pps`, ...
    pub transport: String,
    /// What is opened: device and baud rate, address, file.
    pub what: String,
    /// How it is.
    pub state: ShownPortState,
    /// Bytes taken.
    pub bytes: u64,
    /// Bytes a second, over the last seconds.
    pub rate_bytes_s: Option<f64>,
    /// How long ago bytes, frames or pulses came, s; `None` if never.
    pub age_s: Option<f64>,
    /// Frames found; pulses of a pulse line.
    pub frames: u64,
    /// Frames with a wrong checksum.
    pub damaged: u64,
    /// Bytes that belonged to no frame.
    pub skipped_bytes: u64,
    /// Bytes that were dropped because more came than could be taken.
    pub overrun_bytes: u64,
    /// Datagrams and calls of hosts on the network that were not let in.
    pub refused: u64,
    /// How often it was opened again.
    pub reopened: u64,
    /// What the system said last when something was wrong.
    pub last_error: Option<String>,
}

/// A port that is written to.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ShownOutput {
    /// Its name.
    pub name: String,
    /// What it is: `serial`, `udp`, `tcp-server`, `file`, `pty`, `lan`, `n2k`.
    pub transport: String,
    /// Where it goes to.
    pub what: String,
    /// The monitoring point of which it tells; `None` for the IMU.
    pub point: Option<String>,
    /// How it is.
    pub state: ShownPortState,
    /// Messages handed over whole to the system.
    pub sent: u64,
    /// Messages that will never leave.
    pub dropped: u64,
    /// Messages that wait or are being written.
    pub waiting: u64,
    /// Bytes of the messages sent.
    pub bytes: u64,
    /// Bytes a second, over the last seconds.
    pub rate_bytes_s: Option<f64>,
    /// What a line of a known pace carries, bytes a second.
    pub capacity_bytes_s: Option<f64>,
    /// How old messages were when they left: the worst of all kinds.
    pub age_ms: Option<Age>,
    /// Each kind of message.
    pub messages: Vec<OutputMessage>,
    /// What the system said last when something was wrong.
    pub last_error: Option<String>,
}

/// What became of one kind of message of an output.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct OutputMessage {
    /// Its name in the configuration: `HDT`, `PSXN.23`, ...
    pub name: String,
    /// How often it is to be sent, Hz; `None` if not regularly.
    pub rate_hz: Option<f64>,
    /// Messages handed over whole to the system.
    pub sent: u64,
    /// Messages that will never leave.
    pub dropped: u64,
    /// How old they were when they left.
    pub age_ms: Option<Age>,
}

/// How old messages were when they left: from their time of validity until the last byte was handed to
/// the system, or had left a line of a known pace.
#[derive(Clone, Copy, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Age {
    /// Of the last one, ms.
    pub last: f64,
    /// Of the oldest since the start, ms.
    pub max: f64,
    /// The median of late, ms.
    pub p50: f64,
    /// The age that 99 % of late did not exceed, ms.
    pub p99: f64,
}

/// What a CAN controller says of its bus.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum BusState {
    /// Few errors.
    Active,
    /// An error counter has passed 96.
    Warning,
    /// An error counter has passed 127.
    Passive,
    /// The controller has left the bus.
    Off,
    /// Nothing was told, or a word that this version does not know.
    #[default]
    #[serde(other)]
    Unknown,
}

/// A CAN bus.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Bus {
    /// Name of its port.
    pub port: String,
    /// What its controller says.
    pub state: BusState,
    /// Errors on the wire.
    pub errors: u64,
    /// Times that the controller left the bus.
    pub offs: u64,
    /// Frames that the kernel dropped.
    pub dropped: u64,
    /// Frames a second that are received.
    pub rate_hz: Option<f64>,
    /// Load of the bus by what is received and sent, 0 to 1, if the bit rate is known.
    pub load: Option<f64>,
    /// How far our own node is with its address: `down`, `claiming`, `held`, `cannot_claim`; `None`
    /// where there is no node.
    pub node_state: Option<String>,
    /// The address that our node holds.
    pub address: Option<u8>,
    /// The NAME of our node, 16 hexadecimal digits.
    pub name: Option<String>,
    /// Other devices that are known by a claim.
    pub nodes: Vec<BusNode>,
}

/// Another device of a bus.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct BusNode {
    /// Its address.
    pub address: u8,
    /// Its NAME, 16 hexadecimal digits.
    pub name: String,
}

/// How punctual the outputs are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Schedule {
    /// Instants at which something was due.
    pub epochs: u64,
    /// Those that began more than a millisecond late.
    pub late: u64,
    /// Those that were skipped because they were too late.
    pub skipped: u64,
}
