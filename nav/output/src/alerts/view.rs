//! An alert as a page or a journal shows it.

use insd_base::UtcTime;
use insd_wire::nmea::{AlertPriority, AlertState, Manufacturer};

use crate::epoch::AlertText;

/// How an alert stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AlertView {
    /// Mnemonic of the maker; `None` for an alert of a standard.
    pub manufacturer: Option<Manufacturer>,
    /// Its identifier: a standard one, or one of ours from 10000 on.
    pub identifier: u32,
    /// Its instance, where there are several alerts of one identifier.
    pub instance: Option<u32>,
    /// Its title, at most 16 characters.
    pub title: &'static str,
    /// What it means or what to do.
    pub description: AlertText,
    /// How urgent it is now.
    pub priority: AlertPriority,
    /// Who knows of it.
    pub state: AlertState,
    /// How often it was raised again because nobody acknowledged it.
    pub escalation: u8,
    /// Grows with each change, 1 to 99 and again; `None` before it was ever raised.
    pub revision: Option<u8>,
    /// UTC of the last change, if it was known then.
    pub changed: Option<UtcTime>,
}

impl AlertView {
    /// Whether the condition holds, or has gone without anybody's knowing.
    #[must_use]
    pub fn is_active(&self) -> bool {
        self.state != AlertState::Normal
    }
}
