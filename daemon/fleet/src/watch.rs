//! What is due to be told, and which alerts have changed.

use std::collections::BTreeMap;

use insd_base::{Span, Time};
use insd_web::snapshot::{Alert, ShownAlertState, ShownPriority};

/// Remembers how each alert stood last.
#[derive(Debug, Default)]
pub(crate) struct AlertWatch {
    known: BTreeMap<(u32, Option<u32>), Alert>,
}

/// What makes a change of an alert worth telling.
fn stands(alert: &Alert) -> (ShownAlertState, ShownPriority, u32) {
    (alert.state, alert.priority, alert.escalation)
}

impl AlertWatch {
    /// Those that have changed since the last look; those that are gone have become normal.
    pub(crate) fn changes(&mut self, alerts: &[Alert]) -> Vec<Alert> {
        let mut changed = Vec::new();
        let now: BTreeMap<_, _> =
            alerts.iter().map(|own| ((own.id, own.instance), own.clone())).collect();
        for (key, own) in &self.known {
            if !now.contains_key(key) {
                changed.push(Alert {
                    state: ShownAlertState::Normal,
                    changed_utc: None,
                    ..own.clone()
                });
            }
        }
        for (key, own) in &now {
            if self.known.get(key).map(stands) != Some(stands(own)) {
                changed.push(own.clone());
            }
        }
        self.known = now;
        changed
    }
}

/// Something that is due at intervals, and at once at first.
#[derive(Debug)]
pub(crate) struct Interval {
    /// `None` for never.
    period: Option<Span>,
    last: Option<Time>,
}

impl Interval {
    pub(crate) fn new(period: Option<Span>) -> Self {
        Interval { period, last: None }
    }

    pub(crate) fn is_due(&self, now: Time) -> bool {
        self.period.is_some_and(|period| self.last.is_none_or(|last| now - last >= period))
    }

    /// It was done. Where that was late by less than a period the grid is kept, so that the mean is.
    pub(crate) fn done(&mut self, now: Time) {
        let next = self.last.zip(self.period).map(|(last, period)| last + period);
        let is_close = |next: &Time| self.period.is_some_and(|period| now - *next < period);
        self.last = Some(next.filter(is_close).unwrap_or(now));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn alert(id: u32, state: ShownAlertState) -> Alert {
        Alert { id, state, ..Alert::default() }
    }

    #[test]
    fn an_alert_is_told_when_it_comes_when_it_changes_and_when_it_is_over() {
        use ShownAlertState::{Acknowledged, Normal, Unacknowledged};
        let mut watch = AlertWatch::default();
        let mut states = |alerts: &[Alert]| -> Vec<_> {
            watch.changes(alerts).iter().map(|own| (own.id, own.state)).collect()
        };
        assert_eq!(states(&[alert(1, Unacknowledged)]), [(1, Unacknowledged)]);
        assert_eq!(states(&[alert(1, Unacknowledged)]), []);
        let both = [alert(1, Acknowledged), alert(2, Unacknowledged)];
        assert_eq!(states(&both), [(1, Acknowledged), (2, Unacknowledged)]);
        assert_eq!(states(&both[1..]), [(1, Normal)]);
    }

    #[test]
    fn what_is_looked_for_late_still_comes_as_often_as_it_should() {
        let mut interval = Interval::new(Some(Span::from_seconds(1.0)));
        let looks = (0..1000).map(|look| Time::from_seconds(f64::from(look) * 0.3));
        let done = looks.filter(|now| {
            let is_due = interval.is_due(*now);
            if is_due {
                interval.done(*now);
            }
            is_due
        });
        assert_eq!(done.count(), 300);
    }
}
