//! The program, its time, its mode, its instances, its recording and its journal.

use serde::{Deserialize, Serialize};

/// Which program this is, and since when it runs.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Program {
    /// Its name: `insd`.
    pub name: String,
    /// Its version.
    pub version: String,
    /// When it was started, UTC by the computer's clock of that moment.
    pub started_utc: Option<String>,
    /// How long it has been running, s.
    pub uptime_s: f64,
    /// Name of the ship or of the unit, if the configuration tells.
    pub unit: Option<String>,
    /// Where the configuration was read from.
    pub configuration_path: Option<String>,
    /// A short hash of its text, in hexadecimal: equal for equal configurations.
    pub configuration_hash: Option<String>,
    /// When it was read last, on the ship's time line, s.
    pub configuration_read_at_s: Option<f64>,
    /// Whether all data come from a simulator.
    pub simulated: bool,
    /// Memory that the process holds, bytes.
    pub memory_bytes: Option<u64>,
    /// Processor time that it has used, s.
    pub processor_s: Option<f64>,
}

/// What time it is, and how well that is known.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct TimeInfo {
    /// Now, on the ship's time line, s.
    pub at_s: f64,
    /// How long ago the navigator told what stands here, s; close to zero while it runs.
    pub told_ago_s: f64,
    /// UTC now, if it is known.
    pub utc: Option<String>,
    /// UTC as the computer's own clock has it.
    pub system_utc: Option<String>,
    /// How UTC is known: `unknown`, `messages`, `pulses`.
    pub quality: String,
    /// The sensor or port that it comes from.
    pub source: Option<String>,
    /// 1-sigma of UTC, s, apart from the least delay of messages.
    pub sigma_s: Option<f64>,
}

/// What the system is doing.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ShownMode {
    /// `standby`, `coarse_alignment`, `fine_alignment`, `in_motion_alignment`, `aided`,
    /// `dead_reckoning`, `inertial`, `fault`; empty before anything is known.
    pub name: String,
    /// How long it has been so, s.
    pub since_s: f64,
    /// Why it changed to this, in words.
    pub reason: Option<String>,
}

/// A change of the mode.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ShownTransition {
    /// When, on the ship's time line, s.
    pub at_s: f64,
    /// When, if UTC was known.
    pub utc: Option<String>,
    /// From which mode; `None` for the first.
    pub from: Option<String>,
    /// To which.
    pub to: String,
    /// Why, in words.
    pub reason: Option<String>,
}

/// An instance of the navigator.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ShownEngine {
    /// Its name.
    pub name: String,
    /// What it is doing, in the words of [`ShownMode::name`].
    pub mode: String,
    /// Whether the outputs come from it.
    pub in_use: bool,
    /// Whether it takes part in the comparison.
    pub healthy: bool,
    /// Time of validity of its heading, on the ship's time line, s.
    pub valid_at_s: Option<f64>,
    /// Its heading, deg.
    pub heading_deg: Option<f64>,
    /// 1-sigma of that, deg.
    pub sigma_heading_deg: Option<f64>,
    /// In what it differs from the others by more than the sigmas allow: `heading`, `position`, ...
    pub differs: Vec<String>,
}

/// How a recording is going.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RecordingState {
    /// Everything that arrives goes to the disk.
    Recording,
    /// Nothing does at present: the disk is full, read-only, or fails.
    Failing,
    /// It was ended.
    Ended,
    /// A word that this version does not know.
    #[default]
    #[serde(other)]
    Unknown,
}

/// The recording.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ShownRecording {
    /// How it is going.
    pub state: RecordingState,
    /// Where the files go.
    pub folder: String,
    /// Bytes written since the start.
    pub bytes: u64,
    /// Files begun since the start.
    pub files: u64,
    /// What all files together may hold, bytes; `None` without a limit.
    pub quota_bytes: Option<u64>,
    /// Arrivals that were left out because the disk was slow or failed.
    pub lost: u64,
    /// What the system said last.
    pub last_error: Option<String>,
}

/// What is saved for the next start.
#[derive(Clone, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Saving {
    /// States on the disk since the start.
    pub saved: u64,
    /// States that could not be written.
    pub failed: u64,
    /// What the system said last, while it fails.
    pub last_error: Option<String>,
}

/// The journal.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Log {
    /// What is told: `error`, `warn`, `info`, `debug`, `trace`, or a filter by module.
    pub level: String,
    /// Lines that were left out since the start because they repeated others.
    pub repeats: u64,
    /// Lines and snapshots that were left out because whoever takes them was too slow.
    pub lost: u64,
}
