//! How it is going, for whoever looks.

use std::sync::{Arc, Mutex};

use crate::spool::SpoolLosses;

/// How it is going.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct FleetStatus {
    /// Whether there is a connection to the broker.
    pub is_connected: bool,
    /// Messages that the broker has taken.
    pub messages: u64,
    /// Bytes of their payloads.
    pub bytes: u64,
    /// Records that wait.
    pub waiting: u64,
    /// Records that are lost.
    pub losses: SpoolLosses,
    /// What the disk said, while it fails.
    pub disk_fault: Option<String>,
    /// Why nothing is sent, while there is a reason.
    pub link_fault: Option<String>,
}

/// Where all look.
pub(super) type Shared = Arc<Mutex<FleetStatus>>;
