//! What leaves the ship for fleets.

use serde::{Deserialize, Serialize};

/// A fleet that is told.
#[derive(Clone, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ShownFleet {
    /// Its name.
    pub name: String,
    /// Whether there is a connection to the broker.
    pub connected: bool,
    /// Messages that the broker has taken since the start.
    pub sent_messages: u64,
    /// Bytes of their payloads.
    pub sent_bytes: u64,
    /// Records on the disk that are not ashore yet.
    pub waiting: u64,
    /// Records that were left out because the quota was reached.
    pub lost_quota: u64,
    /// Records that grew too old before they could be sent.
    pub lost_expired: u64,
    /// Records that could not be written to the disk.
    pub lost_unwritten: u64,
    /// Bytes on the disk that were damaged.
    pub damaged_bytes: u64,
    /// What the disk says, while it fails.
    pub disk_fault: Option<String>,
    /// Why nothing is sent, while there is a reason.
    pub link_fault: Option<String>,
}
