//! What was found, as plain data; `--json` prints it as it is.

use insd_wire::stream::Protocol;
use serde::{Serialize, Serializer};

use super::bus::report::BusReport;
use super::tally::Counted;

/// What was found at all ports.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SniffReport {
    /// Ports in their order.
    pub ports: Vec<PortReport>,
}

/// What was found at one port. Rates and ages are `None` where there is no timing (a file) or too
/// little came.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PortReport {
    /// Name of the port.
    pub name: String,
    /// How it is with it.
    #[serde(flatten)]
    pub state: State,
    /// What the system opened.
    pub what: Option<String>,
    /// Baud rate of a serial line.
    pub baud: Option<u32>,
    /// For how long it was listened to, s.
    pub seconds: Option<f64>,
    /// Bytes that came.
    pub bytes: u64,
    /// Bytes per second.
    pub bytes_per_s: Option<f64>,
    /// Share of what the line can carry at its baud rate with 10 bits a byte, 0 to 1.
    pub load: Option<f64>,
    /// Bytes that belong to no frame.
    pub stray: u64,
    /// Good frames.
    pub frames: u64,
    /// Frames with a wrong checksum.
    pub damaged: u64,
    /// Bytes that came faster than they could be counted, and were dropped.
    pub dropped: u64,
    /// How often the port was lost.
    pub losses: u32,
    /// Messages, by protocol and name.
    pub messages: Vec<MessageReport>,
    /// Frames of further kinds, that are not told apart.
    pub more: u64,
    /// Talkers of NMEA sentences.
    pub talkers: Vec<Counted>,
    /// Sources that TAG blocks name.
    pub sources: Vec<Counted>,
    /// Satellites of a receiver that sends raw messages.
    pub satellites: Option<SatelliteReport>,
    /// Pulses.
    pub pulses: Option<PulseReport>,
    /// A CAN bus.
    pub bus: Option<BusReport>,
    /// What may be wrong, and what to do about it.
    pub hints: Vec<String>,
    /// Sections for the configuration, TOML.
    pub suggestions: Vec<String>,
}

/// How it is with a port.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "state", rename_all = "snake_case")]
pub enum State {
    /// It is not known yet whether it can be opened.
    Opening,
    /// It is open, and something comes.
    Open,
    /// It is open, and nothing comes.
    Silent {
        /// For how long, s.
        silent_s: f64,
    },
    /// It cannot be opened.
    Absent {
        /// What the system says.
        reason: String,
    },
    /// It was open and is gone.
    Lost {
        /// What the system says.
        reason: String,
    },
    /// It has been read to its end.
    Ended,
}

/// One kind of message.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MessageReport {
    /// How it is framed.
    #[serde(serialize_with = "protocol_name")]
    pub protocol: Protocol,
    /// Its name, with the talker: `HETHS`, `NAV-PVT`.
    pub name: String,
    /// How many came.
    pub count: u64,
    /// Of these, read and used by the navigator.
    pub used: u64,
    /// Of these, not what their format says.
    pub refused: u64,
    /// Of the refused, those that are read where lines without a checksum are taken.
    pub bare: u64,
    /// Of the used, those of which a bad field is left out.
    pub flawed: u64,
    /// Messages per second.
    pub rate_hz: Option<f64>,
    /// Standard deviation of the intervals between arrivals, ms.
    pub jitter_ms: Option<f64>,
    /// Time since the last, s.
    pub age_s: Option<f64>,
    /// The last one that was refused.
    pub refusal: Option<RefusedMessage>,
    /// The last one of which a field was left out, and which.
    pub flaw: Option<RefusedMessage>,
    /// Axes of the velocities of a Doppler log that tells them.
    pub axes: Option<LogAxes>,
}

/// Axes in which a Doppler log of RDI tells velocities.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LogAxes {
    /// `beam`, `instrument`, `ship` or `earth`.
    pub frame: &'static str,
    /// Whether it looks up.
    pub up: bool,
    /// Its heading alignment (`EA`): where its beam 3 points, deg clockwise from the bow.
    pub alignment_deg: f64,
}

/// A message that was refused.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct RefusedMessage {
    /// Why.
    pub reason: String,
    /// Its first bytes: as they are if they are text, else in hexadecimal digits.
    pub bytes: String,
}

/// Satellites of a receiver that sends raw messages.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SatelliteReport {
    /// Epochs that came.
    pub epochs: u64,
    /// What was measured, by constellation.
    pub constellations: Vec<ConstellationReport>,
    /// Whether a model of the ionosphere has been broadcast.
    pub ionosphere: bool,
    /// Words of satellites and records that are refused.
    pub refused: u64,
}

/// Satellites of one constellation.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ConstellationReport {
    /// Its name.
    pub constellation: String,
    /// How many satellites were measured.
    pub satellites: usize,
    /// Signals that were measured, in the characters of RINEX: `1C`, `5Q`.
    pub signals: Vec<String>,
    /// Least carrier to noise density, dB Hz.
    pub least_dbhz: Option<f64>,
    /// Greatest.
    pub greatest_dbhz: Option<f64>,
    /// Of how many the orbit is known: all pages of their broadcast message have come.
    pub orbits: usize,
}

/// Pulses of a port.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PulseReport {
    /// How many came.
    pub count: u64,
    /// Pulses that the kernel counted and that did not come.
    pub missed: u64,
    /// Mean interval by the computer's clock, s.
    pub interval_s: Option<f64>,
    /// Standard deviation of the intervals, ms.
    pub jitter_ms: Option<f64>,
    /// Time since the last, s.
    pub age_s: f64,
    /// How far the computer's time of day was from a whole second at the last pulse, ms; positive if
    /// the computer is ahead.
    pub clock_ahead_ms: f64,
}

impl PortReport {
    /// Whether nothing at all came.
    #[must_use]
    pub fn is_mute(&self) -> bool {
        self.bytes == 0 && self.pulses.is_none() && self.bus.is_none()
    }

    /// Whether something came that insd can read, if only where lines without a checksum are taken.
    #[must_use]
    pub fn is_readable(&self) -> bool {
        let good = |message: &MessageReport| message.count > message.refused || message.bare > 0;
        let frames = self.bus.as_ref().is_some_and(|bus| bus.frames > 0);
        self.messages.iter().any(good) || self.pulses.is_some() || frames
    }

    /// Share of the bytes that belong to no frame, 0 to 1.
    #[must_use]
    pub fn stray_share(&self) -> f64 {
        self.stray as f64 / self.bytes.max(1) as f64
    }

    /// Share of the frames whose checksum is wrong, 0 to 1.
    #[must_use]
    pub fn damaged_share(&self) -> f64 {
        self.damaged as f64 / (self.damaged + self.frames).max(1) as f64
    }

    /// Protocols that are spoken.
    #[must_use]
    pub fn protocols(&self) -> Vec<Protocol> {
        let mut all: Vec<Protocol> = self.messages.iter().map(|message| message.protocol).collect();
        all.sort_unstable();
        all.dedup();
        all
    }
}

impl MessageReport {
    /// Good ones that the navigator does not need.
    #[must_use]
    pub fn other(&self) -> u64 {
        self.count.saturating_sub(self.used + self.refused)
    }
}

fn protocol_name<S: Serializer>(protocol: &Protocol, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(protocol.name())
}
