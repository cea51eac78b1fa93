//! Alerts, and when each of them changed.

use std::collections::BTreeMap;

use insd_base::Time;
use insd_config::calendar;
use insd_output::alerts::AlertView;
use insd_web::snapshot::{Alert, ShownAlertState, ShownPriority};
use insd_wire::nmea;

use super::super::report::Report;

/// What was seen of each alert last.
#[derive(Debug, Default)]
pub(super) struct Changes {
    seen: BTreeMap<u32, (Option<u8>, Time)>,
}

impl Changes {
    /// The alerts that are not normal.
    pub(super) fn alerts(&mut self, report: &Report) -> Vec<Alert> {
        let now = report.stamp.monotonic;
        for view in &report.alerts {
            let seen = self.seen.entry(view.identifier).or_insert((view.revision, now));
            if seen.0 != view.revision {
                *seen = (view.revision, now);
            }
        }
        let active = report.alerts.iter().filter(|view| view.is_active());
        active.map(|view| self.alert(view, now)).collect()
    }

    fn alert(&self, view: &AlertView, now: Time) -> Alert {
        let since = self.seen.get(&view.identifier).map(|(_, since)| (now - *since).as_seconds());
        Alert {
            id: view.identifier,
            instance: view.instance,
            manufacturer: view.manufacturer.map(|own| own.as_str().to_owned()),
            title: view.title.to_owned(),
            description: view.description.to_string(),
            priority: priority(view.priority),
            state: state(view.state),
            escalation: u32::from(view.escalation),
            changed_utc: view.changed.map(calendar::rfc3339_millis),
            since_s: since,
        }
    }
}

fn priority(priority: nmea::AlertPriority) -> ShownPriority {
    match priority {
        nmea::AlertPriority::EmergencyAlarm => ShownPriority::EmergencyAlarm,
        nmea::AlertPriority::Alarm => ShownPriority::Alarm,
        nmea::AlertPriority::Warning => ShownPriority::Warning,
        nmea::AlertPriority::Caution => ShownPriority::Caution,
    }
}

fn state(state: nmea::AlertState) -> ShownAlertState {
    match state {
        nmea::AlertState::Unacknowledged => ShownAlertState::Unacknowledged,
        nmea::AlertState::Silenced => ShownAlertState::Silenced,
        nmea::AlertState::Acknowledged => ShownAlertState::Acknowledged,
        nmea::AlertState::Transferred => ShownAlertState::Transferred,
        nmea::AlertState::Rectified => ShownAlertState::Rectified,
        nmea::AlertState::Normal => ShownAlertState::Normal,
    }
}
