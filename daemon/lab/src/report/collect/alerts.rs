//! Alerts: when each was raised, acknowledged and rectified.

use std::collections::BTreeMap;

use insd_base::Time;
use insd_output::alerts::AlertView;
use insd_wire::nmea::{AlertPriority, AlertState};

use super::lane::Lane;
use crate::report::bounded::Bounded;

/// Bits in the lane of an alert: asks to be acknowledged; active and known; over and never acknowledged.
pub(crate) const ASKS: u16 = 4;
/// See [`ASKS`].
pub(crate) const KNOWN: u16 = 2;
/// See [`ASKS`].
pub(crate) const OVER: u16 = 1;
/// Alerts kept at each end of the recording.
const KEPT: usize = 100;

type Key = (u32, Option<u32>);

/// An alert from when it was raised until it was normal again.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Occurrence {
    pub(crate) view: AlertView,
    pub(crate) raised: Time,
    pub(crate) acknowledged: Option<Time>,
    pub(crate) rectified: Option<Time>,
}

/// All alerts of a recording.
#[derive(Clone, Debug)]
pub(crate) struct Alerts {
    start: Time,
    /// Whether anybody kept watch: without ports that are written to nobody does.
    pub(crate) watched: bool,
    pub(crate) lanes: BTreeMap<Key, (&'static str, Lane)>,
    pub(crate) over: Bounded<Occurrence>,
    pub(crate) open: BTreeMap<Key, Occurrence>,
    last: BTreeMap<Key, (AlertState, u8)>,
}

impl Alerts {
    pub(crate) fn new(start: Time) -> Self {
        Alerts {
            start,
            watched: false,
            lanes: BTreeMap::new(),
            over: Bounded::new(KEPT),
            open: BTreeMap::new(),
            last: BTreeMap::new(),
        }
    }

    /// How many were raised.
    pub(crate) fn raised(&self) -> u64 {
        self.over.count() + self.open.len() as u64
    }

    /// How many are active.
    pub(crate) fn active(&self) -> usize {
        self.open.values().filter(|own| is_active(own.view.state)).count()
    }

    /// Looks at how the alerts stand; gives those that changed.
    pub(crate) fn look(
        &mut self,
        now: Time,
        views: impl Iterator<Item = AlertView>,
    ) -> Vec<AlertView> {
        self.watched = true;
        let mut changed = Vec::new();
        for view in views {
            let key = (view.identifier, view.instance);
            let known = self.last.insert(key, (view.state, view.escalation));
            let (before, escalation) = known.unwrap_or((AlertState::Normal, 0));
            if before != view.state || escalation != view.escalation {
                self.change(now, key, before, view);
                changed.push(view);
            }
        }
        changed
    }

    fn change(&mut self, now: Time, key: Key, before: AlertState, view: AlertView) {
        let start = self.start;
        let (_, lane) = self.lanes.entry(key).or_insert_with(|| (view.title, Lane::new(start)));
        lane.last(now, bit(view.state));
        if !is_active(before) && is_active(view.state) {
            let fresh = Occurrence { view, raised: now, acknowledged: None, rectified: None };
            self.over_with(key);
            self.open.insert(key, fresh);
        }
        let Some(own) = self.open.get_mut(&key) else { return };
        own.view = view;
        let is_known = matches!(view.state, AlertState::Acknowledged | AlertState::Transferred);
        if is_known && view.priority != AlertPriority::Caution {
            own.acknowledged.get_or_insert(now);
        }
        if is_active(before) && !is_active(view.state) {
            own.rectified.get_or_insert(now);
        } else if before == AlertState::Rectified && view.state == AlertState::Normal {
            own.acknowledged.get_or_insert(now);
        }
        if view.state == AlertState::Normal {
            self.over_with(key);
        }
    }

    fn over_with(&mut self, key: Key) {
        if let Some(own) = self.open.remove(&key) {
            self.over.push(own);
        }
    }

    /// The recording ends.
    pub(crate) fn finish(&mut self, now: Time) {
        self.lanes.values_mut().for_each(|(_, lane)| lane.finish(now));
    }
}

/// Whether what an alert is raised for holds.
fn is_active(state: AlertState) -> bool {
    !matches!(state, AlertState::Normal | AlertState::Rectified)
}

fn bit(state: AlertState) -> u16 {
    match state {
        AlertState::Unacknowledged => ASKS,
        AlertState::Silenced | AlertState::Acknowledged | AlertState::Transferred => KNOWN,
        AlertState::Rectified => OVER,
        AlertState::Normal => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_output::alerts::AlertText;

    fn view(state: AlertState) -> AlertView {
        AlertView {
            manufacturer: None,
            revision: None,
            identifier: 10_001,
            instance: None,
            title: "Heading lost",
            description: AlertText::new("Use another heading").unwrap(),
            priority: AlertPriority::Warning,
            state,
            escalation: 0,
            changed: None,
        }
    }

    fn after(states: &[AlertState]) -> Alerts {
        let mut alerts = Alerts::new(Time::START);
        for (second, state) in (1..).zip(states) {
            alerts.look(Time::from_seconds(f64::from(second)), std::iter::once(view(*state)));
        }
        alerts
    }

    #[test]
    fn an_alert_is_raised_acknowledged_and_rectified_once() {
        use AlertState::{Acknowledged, Normal, Unacknowledged};
        let alerts = after(&[Normal, Unacknowledged, Unacknowledged, Acknowledged, Normal]);
        let own = alerts.over.first().next().unwrap();
        assert_eq!((alerts.raised(), alerts.open.len()), (1, 0));
        let seconds = |time: Option<Time>| time.map(Time::as_seconds);
        assert_eq!(own.raised.as_seconds(), 2.0);
        assert_eq!((seconds(own.acknowledged), seconds(own.rectified)), (Some(4.0), Some(5.0)));
    }

    #[test]
    fn one_that_nobody_acknowledged_stays_open_and_counts_anew_when_it_is_raised_again() {
        use AlertState::{Rectified, Unacknowledged};
        let alerts = after(&[Unacknowledged, Rectified, Unacknowledged]);
        assert_eq!((alerts.raised(), alerts.open.len()), (2, 1));
        let own = alerts.over.first().next().unwrap();
        assert_eq!((own.acknowledged, own.rectified), (None, Some(Time::from_seconds(2.0))));
    }
}
