//! What waits: records, each of a class.

use insd_base::UtcTime;

use crate::key::RecordKey;

/// What is kept longer, and sent first, comes later.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SpoolClass {
    /// Where she was and how she lay, at intervals.
    History,
    /// Changes of alerts.
    Alerts,
}

impl SpoolClass {
    /// All, the least first.
    pub const ALL: [SpoolClass; 2] = [SpoolClass::History, SpoolClass::Alerts];

    /// Name of its folder and its topic.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            SpoolClass::History => "log",
            SpoolClass::Alerts => "alert",
        }
    }
}

/// A record.
#[derive(Clone, Debug, PartialEq)]
pub struct SpoolRecord {
    /// What tells it from all others.
    pub key: RecordKey,
    /// UTC as the ship knew it; never that of the computer's own clock, which may step.
    pub utc: Option<UtcTime>,
    /// What it says: an object of JSON.
    pub text: String,
}
