//! All alerts, and what there is to tell of them.

use std::collections::VecDeque;

use insd_base::{Span, Time};
use insd_wire::nmea::{Acn, AlertCommand, AlertEntry, AlertState, Alf, Arc, CivilTime, Hbt};

use super::alert::Alert;
use super::conditions::Condition;
use super::patience::AlertConfig;
use super::view::AlertView;
use crate::epoch::AlertText;
use crate::schedule::Boundary;

/// A heartbeat counts for so many of its intervals: one may be lost.
const BEATS: f64 = 2.5;

/// Interval of a heartbeat that does not say how often it comes, s.
const USUAL_BEAT: f64 = 60.0;

/// Refusals that wait to be told; who sends more commands at a time gets no answer to the first.
const MAX_REFUSALS: usize = 16;

/// Something that there is to tell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Announcement {
    /// How an alert stands, in two sentences whose message is not yet numbered.
    Alert(Condition, [Alf; 2]),
    /// A command was refused; with the number of the refusal, 0 to 15 and again.
    Refusal(u16, Arc),
}

/// All alerts.
#[derive(Clone, Debug)]
pub struct AlertBoard {
    config: AlertConfig,
    alerts: [Alert; Condition::ALL.len()],
    refusals: VecDeque<(u64, Announcement)>,
    refused: u16,
    stamp: u64,
    /// Until when the last heartbeat of the bridge counts.
    supervised: Option<Time>,
}

impl Default for AlertBoard {
    fn default() -> Self {
        AlertBoard::new(AlertConfig::default())
    }
}

impl AlertBoard {
    /// A board on which nothing was ever raised.
    #[must_use]
    pub fn new(config: AlertConfig) -> Self {
        AlertBoard {
            config,
            alerts: Condition::ALL.map(Alert::normal),
            refusals: VecDeque::new(),
            refused: 0,
            stamp: 0,
            supervised: None,
        }
    }

    /// A condition holds; nothing changes if that was known.
    pub fn raise(&mut self, condition: Condition, now: &Boundary) {
        self.each(|alert| alert.condition == condition && alert.raise(now));
    }

    /// What an alert says from now on instead of its usual description; nothing changes without a text. Who knows of it is
    /// told anew.
    pub fn explain(&mut self, condition: Condition, detail: Option<AlertText>, now: &Boundary) {
        self.each(|alert| alert.condition == condition && alert.explain(detail, now));
    }

    /// A condition is gone; nothing changes if that was known.
    pub fn rectify(&mut self, condition: Condition, now: &Boundary) {
        self.each(|alert| alert.condition == condition && alert.rectify(now));
    }

    /// Lets time pass: silence ends, warnings are raised again, what was taken over comes back.
    pub fn wait(&mut self, now: &Boundary) {
        let (config, supervised) = (self.config, self.is_supervised(now.time));
        self.each(|alert| alert.wait(&config, supervised, now));
    }

    /// A heartbeat of the bridge was heard. While they come, it may take over responsibility.
    pub fn hear(&mut self, heartbeat: &Hbt, now: Time) {
        let interval = heartbeat.interval.filter(|interval| *interval > 0.0).unwrap_or(USUAL_BEAT);
        let until = now + Span::from_seconds(BEATS * interval);
        self.supervised = heartbeat.normal.then_some(until);
    }

    /// Obeys a command of the bridge: the alert is to be told again. Gives the refusal, which is to be
    /// told, too, if there is no such alert or it cannot be done.
    pub fn handle(&mut self, command: &Acn, now: &Boundary) -> Option<Arc> {
        let supervised = self.is_supervised(now.time);
        let obeyed = self.each(|alert| {
            let is_meant = alert.condition.alert() == command.alert;
            is_meant && alert.obey(command.command, supervised, now)
        });
        if obeyed { None } else { Some(self.refuse(command, now)) }
    }

    /// Refuses a command, whatever it is; gives the refusal, which is to be told.
    pub fn refuse(&mut self, command: &Acn, now: &Boundary) -> Arc {
        let time = now.utc.and_then(CivilTime::from_utc).map(|utc| utc.time);
        let arc = Arc { time, alert: command.alert, command: command.command };
        self.stamp += 1;
        self.refusals.push_back((self.stamp, Announcement::Refusal(self.refused, arc)));
        self.refused = (self.refused + 1) % MAX_REFUSALS as u16;
        if self.refusals.len() > MAX_REFUSALS {
            self.refusals.pop_front();
        }
        arc
    }

    /// Obeys the operator at our own page; whether it could. Nothing is refused on the line.
    pub fn obey(&mut self, identifier: u32, command: AlertCommand, now: &Boundary) -> bool {
        let supervised = self.is_supervised(now.time);
        self.each(|alert| {
            let is_meant = alert.condition.alert().identifier == identifier;
            is_meant && alert.obey(command, supervised, now)
        })
    }

    /// How all alerts stand, those that matter most first.
    pub fn views(&self) -> impl Iterator<Item = AlertView> + '_ {
        self.alerts.iter().map(Alert::view)
    }

    /// How an alert stands.
    #[must_use]
    pub fn state(&self, condition: Condition) -> AlertState {
        let alert = self.alerts.iter().find(|alert| alert.condition == condition);
        alert.map_or(AlertState::Normal, |alert| alert.state)
    }

    /// The alerts that are not normal, of those that are shown; for ALC.
    #[must_use]
    pub fn list(&self, is_shown: impl Fn(Condition) -> bool) -> Vec<AlertEntry> {
        let active = self.alerts.iter().filter(|alert| alert.state != AlertState::Normal);
        active.filter(|alert| is_shown(alert.condition)).map(Alert::entry).collect()
    }

    /// Grows with everything that there is to tell.
    #[must_use]
    pub fn stamp(&self) -> u64 {
        self.stamp
    }

    /// What there is to tell since a stamp, of those alerts that are shown, in the order in which it
    /// came up. Of each alert it is how it stands now.
    #[must_use]
    pub fn news(&self, since: u64, is_shown: impl Fn(Condition) -> bool) -> Vec<Announcement> {
        let alerts =
            self.alerts.iter().filter(|alert| is_shown(alert.condition)).map(|alert| {
                (alert.stamp, Announcement::Alert(alert.condition, alert.sentences()))
            });
        let all = alerts.chain(self.refusals.iter().copied());
        let mut news: Vec<(u64, Announcement)> = all.filter(|(stamp, _)| *stamp > since).collect();
        news.sort_by_key(|(stamp, _)| *stamp);
        news.into_iter().map(|(_, announcement)| announcement).collect()
    }

    fn is_supervised(&self, now: Time) -> bool {
        self.supervised.is_some_and(|until| now <= until)
    }

    /// Does something to each alert; those to which something happened are to be told. Whether there
    /// are any.
    fn each(&mut self, mut act: impl FnMut(&mut Alert) -> bool) -> bool {
        let before = self.stamp;
        for alert in &mut self.alerts {
            if act(alert) {
                self.stamp += 1;
                alert.stamp = self.stamp;
            }
        }
        self.stamp > before
    }
}

impl Announcement {
    /// A number for what may take the place of what: of an alert its newest state, of a refusal
    /// nothing that comes soon.
    pub(crate) fn key(&self) -> u16 {
        match self {
            Announcement::Alert(condition, _) => *condition as u16,
            Announcement::Refusal(number, _) => Condition::ALL.len() as u16 + number,
        }
    }
}
