//! The state of one alert.

use insd_base::{Span, Time, UtcTime};
use insd_wire::nmea::{
    AlertCategory, AlertCommand, AlertEntry, AlertPriority, AlertState, Alf, CivilTime,
};

use super::conditions::Condition;
use super::patience::{AlertConfig, Escalation};
use super::view::AlertView;
use crate::epoch::AlertText;
use crate::schedule::Boundary;

/// How long an alert stays silenced.
const SILENCE: Span = Span::from_nanos(30_000_000_000);

/// Greatest revision; after it comes 1.
const REVISION_MAX: u8 = 99;

/// Greatest number of escalations that is told.
const ESCALATION_MAX: u8 = 9;

/// One alert.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Alert {
    pub(super) condition: Condition,
    pub(super) state: AlertState,
    priority: AlertPriority,
    /// 0 before it was ever raised.
    revision: u8,
    escalation: u8,
    /// UTC of the last change.
    changed: Option<UtcTime>,
    /// Since when it asks to be acknowledged, or was last repeated.
    asks: Time,
    silenced: Time,
    /// What it says instead of its usual description.
    detail: Option<AlertText>,
    /// When it was last to be told, in the board's own count.
    pub(super) stamp: u64,
}

impl Alert {
    /// An alert that was never raised.
    pub(super) fn normal(condition: Condition) -> Self {
        Alert {
            condition,
            state: AlertState::Normal,
            priority: condition.priority(),
            revision: 0,
            escalation: 0,
            changed: None,
            asks: Time::START,
            silenced: Time::START,
            detail: None,
            stamp: 0,
        }
    }

    /// The condition holds; whether that is new.
    pub(super) fn raise(&mut self, now: &Boundary) -> bool {
        if !matches!(self.state, AlertState::Normal | AlertState::Rectified) {
            return false;
        }
        *self =
            Alert { priority: self.condition.priority(), escalation: 0, asks: now.time, ..*self };
        let state = match self.priority {
            AlertPriority::Caution => AlertState::Acknowledged,
            _ => AlertState::Unacknowledged,
        };
        self.turn(state, now)
    }

    /// From now on it says something else; whether that is news to those who know of it.
    pub(super) fn explain(&mut self, detail: Option<AlertText>, now: &Boundary) -> bool {
        // what is over keeps the words under which it was raised
        if detail.is_none() || detail == self.detail {
            return false;
        }
        self.detail = detail;
        let is_told = !matches!(self.state, AlertState::Normal | AlertState::Rectified);
        is_told && self.turn(self.state, now)
    }

    fn description(&self) -> AlertText {
        let usual = || AlertText::new(self.condition.description()).unwrap_or_default();
        self.detail.unwrap_or_else(usual)
    }

    /// The condition is gone; whether that is new.
    pub(super) fn rectify(&mut self, now: &Boundary) -> bool {
        match self.state {
            AlertState::Normal | AlertState::Rectified => false,
            AlertState::Unacknowledged | AlertState::Silenced => {
                self.turn(AlertState::Rectified, now)
            }
            AlertState::Acknowledged | AlertState::Transferred => {
                self.turn(AlertState::Normal, now)
            }
        }
    }

    /// Obeys the bridge; whether it could. `supervised`: its heartbeat is heard.
    pub(super) fn obey(&mut self, command: AlertCommand, supervised: bool, now: &Boundary) -> bool {
        use AlertState::{Acknowledged, Normal, Rectified, Silenced, Transferred, Unacknowledged};
        let asks = matches!(self.state, Unacknowledged | Silenced);
        match command {
            AlertCommand::Request => self.revision > 0,
            AlertCommand::Acknowledge if asks || self.state == Transferred => {
                self.turn(Acknowledged, now)
            }
            AlertCommand::Acknowledge if self.state == Rectified => self.turn(Normal, now),
            AlertCommand::Silence if asks => {
                self.silenced = now.time;
                self.turn(Silenced, now)
            }
            AlertCommand::Transfer if asks && supervised => self.turn(Transferred, now),
            _ => false,
        }
    }

    /// Lets time pass; whether that changes anything.
    pub(super) fn wait(&mut self, config: &AlertConfig, supervised: bool, now: &Boundary) -> bool {
        use AlertState::{Silenced, Transferred, Unacknowledged};
        let asks = matches!(self.state, Unacknowledged | Silenced);
        if asks && now.time - self.asks >= config.patience {
            self.escalate(config.escalation, now)
        } else if self.state == Silenced && now.time - self.silenced >= SILENCE {
            self.turn(Unacknowledged, now)
        } else if self.state == Transferred && !supervised {
            self.asks = now.time;
            self.turn(Unacknowledged, now)
        } else {
            false
        }
    }

    /// A warning that nobody has acknowledged is raised again. An alarm sounds until somebody does.
    fn escalate(&mut self, escalation: Escalation, now: &Boundary) -> bool {
        if self.priority != AlertPriority::Warning {
            return false;
        }
        self.asks = now.time;
        self.escalation = (self.escalation + 1).min(ESCALATION_MAX);
        if escalation == Escalation::Alarm {
            self.priority = AlertPriority::Alarm;
        }
        self.turn(AlertState::Unacknowledged, now)
    }

    /// Counts a change.
    fn turn(&mut self, state: AlertState, now: &Boundary) -> bool {
        self.state = state;
        self.revision = self.revision % REVISION_MAX + 1;
        self.changed = now.utc;
        true
    }

    fn revision(&self) -> Option<u8> {
        Some(self.revision).filter(|revision| *revision > 0)
    }

    /// As it stands in the list of what is active.
    pub(super) fn entry(&self) -> AlertEntry {
        AlertEntry { alert: self.condition.alert(), revision: self.revision() }
    }

    /// As a page or a journal shows it.
    pub(super) fn view(&self) -> AlertView {
        AlertView {
            manufacturer: self.condition.alert().manufacturer,
            identifier: self.condition.alert().identifier,
            instance: self.condition.alert().instance,
            title: self.condition.title(),
            description: self.description(),
            priority: self.priority,
            state: self.state,
            escalation: self.escalation,
            revision: self.revision(),
            changed: self.changed,
        }
    }

    /// The two sentences that tell of it, their message not yet numbered.
    pub(super) fn sentences(&self) -> [Alf; 2] {
        let title = Alf {
            sentences: 2,
            number: 1,
            message: 0,
            time: self.changed.and_then(CivilTime::from_utc).map(|utc| utc.time),
            category: Some(AlertCategory::B),
            priority: Some(self.priority),
            state: Some(self.state),
            alert: self.condition.alert(),
            revision: self.revision(),
            escalation: Some(self.escalation),
            text: AlertText::new(self.condition.title()).unwrap_or_default(),
        };
        title.with_description(self.description())
    }
}
