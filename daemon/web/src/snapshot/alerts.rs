//! Alerts after IEC 62923, and lines of the journal.

use serde::{Deserialize, Serialize};

/// How urgent an alert is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ShownPriority {
    /// Somebody must act at once to save lives or the ship.
    EmergencyAlarm,
    /// Somebody must act at once.
    Alarm,
    /// Somebody must attend to it, or it will be an alarm.
    Warning,
    /// Worth more than ordinary attention.
    Caution,
    /// A word that this version does not know.
    #[default]
    #[serde(other)]
    Unknown,
}

/// State of an alert.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ShownAlertState {
    /// It holds, and nobody has acknowledged it.
    Unacknowledged,
    /// It holds, nobody has acknowledged it, and it is silent for a while.
    Silenced,
    /// It holds and was acknowledged, or there is nothing to acknowledge (a caution).
    Acknowledged,
    /// It holds, and the bridge has taken over the responsibility.
    Transferred,
    /// It holds no longer, and was never acknowledged.
    Rectified,
    /// It holds no longer.
    Normal,
    /// A word that this version does not know.
    #[default]
    #[serde(other)]
    Unknown,
}

/// An alert.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Alert {
    /// Identifier, as ALF has it.
    pub id: u32,
    /// Instance, where there are several of one identifier.
    pub instance: Option<u32>,
    /// Mnemonic of the maker; `None` for an alert of a standard.
    pub manufacturer: Option<String>,
    /// Title.
    pub title: String,
    /// What it means, or what to do.
    pub description: String,
    /// How urgent it is.
    pub priority: ShownPriority,
    /// Its state.
    pub state: ShownAlertState,
    /// How often it was raised again because nobody answered.
    pub escalation: u32,
    /// UTC of the last change, if it was known.
    pub changed_utc: Option<String>,
    /// How long ago that was, s.
    pub since_s: Option<f64>,
}

/// How much a line of the journal matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ShownSeverity {
    /// Something does not work.
    Error,
    /// Something is not as it should be.
    Warn,
    /// Something happened.
    Info,
    /// Something for developers.
    Debug,
    /// A word that this version does not know.
    #[default]
    #[serde(other)]
    Unknown,
}

/// A line of the journal.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ShownEvent {
    /// When, on the ship's time line, s.
    pub at_s: f64,
    /// When, if UTC was known.
    pub utc: Option<String>,
    /// How much it matters.
    pub severity: ShownSeverity,
    /// What.
    pub text: String,
}
