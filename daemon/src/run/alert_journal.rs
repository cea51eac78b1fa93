//! Alerts, for the journal: a line for each change.

use std::collections::BTreeMap;

use insd_output::alerts::AlertView;
use insd_vessel::words::priority;
use insd_vessel::{Names, Product};
use insd_wire::nmea::{AlertPriority, AlertState};

use super::journal::Audience;
use super::report::Report;

/// Remembers how each alert stood last.
#[derive(Debug, Default)]
pub(super) struct AlertJournal {
    /// By identifier: how often it has changed, as the board counts.
    seen: BTreeMap<u32, Option<u8>>,
}

impl Audience for AlertJournal {
    fn hear(&mut self, _: &Names, _: &Product) {}

    fn see(&mut self, report: &Report) {
        for view in &report.alerts {
            let before = self.seen.insert(view.identifier, view.revision);
            if view.revision.is_some() && before.flatten() != view.revision {
                tell(view);
            }
        }
    }
}

fn tell(view: &AlertView) {
    let AlertView { identifier: alert, title, description, escalation, .. } = *view;
    let description = description.to_string();
    let (priority, state) = (priority(view.priority), state(view.state));
    match (view.state, view.priority) {
        (AlertState::Unacknowledged, AlertPriority::Alarm | AlertPriority::EmergencyAlarm) => {
            tracing::error!(alert, title, description, priority, state, escalation, "alert");
        }
        (AlertState::Unacknowledged, _) => {
            tracing::warn!(alert, title, description, priority, state, escalation, "alert");
        }
        _ => tracing::info!(alert, title, description, priority, state, escalation, "alert"),
    }
}

fn state(state: AlertState) -> &'static str {
    match state {
        AlertState::Unacknowledged => "unacknowledged",
        AlertState::Silenced => "silenced",
        AlertState::Acknowledged => "acknowledged",
        AlertState::Transferred => "transferred",
        AlertState::Rectified => "rectified",
        AlertState::Normal => "normal",
    }
}
