//! A port: what it sends, how often, in whose name, and of which point of the ship.

use insd_base::{Span, Time, UtcTime};
use insd_wire::nmea::Talker;

use crate::alerts::AlertBoard;
use crate::epoch::OutputEpoch;
use crate::manner::Manner;
use crate::messages::{Content, MessageKind};
use crate::redacted_epoch::RedactedEpoch;
use crate::schedule::Rate;

/// One port.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct OutputPortConfig {
    /// Messages and their rates. They leave in the order of [`MessageKind::all`].
    pub messages: Vec<(MessageKind, Rate)>,
    /// How it speaks of quality and of simulated data.
    pub manner: Manner,
    /// Talker of all sentences that have one, in place of the usual ones.
    pub talker: Option<Talker>,
    /// Talkers of single messages.
    pub talkers: Vec<(MessageKind, Talker)>,
    /// Index of the monitoring point: position, velocity and heave are those there.
    pub point: usize,
    /// Time constant by which the rate of turn is damped, s; 0 for none.
    pub turn_damping: f64,
    /// Height of the geoid above the WGS-84 ellipsoid where the ship sails, m, in place of that of EGM96.
    pub geoid_separation: Option<f64>,
}

/// A message on its way to a port.
#[derive(Clone, Debug, PartialEq)]
pub struct PortMessage {
    /// Place of its kind in the port's list: a newer message of one slot replaces one that waits. Each
    /// alert has a slot of its own behind those of the list.
    pub slot: u16,
    /// What it is.
    pub kind: MessageKind,
    /// Its bytes.
    pub content: Content,
    /// Time of validity of what it says.
    pub valid: Time,
    /// The same in UTC, if it is known.
    pub utc: Option<UtcTime>,
    /// Time to the next of its kind.
    pub period: Span,
}

/// Turns epochs into the messages of one port.
#[derive(Clone, Debug)]
pub struct Port {
    config: OutputPortConfig,
    lines: Vec<LineUp>,
    turn: Option<(Time, f64)>,
    /// Stamp of the board up to which alerts were told.
    told: u64,
}

#[derive(Clone, Copy, Debug)]
struct LineUp {
    kind: MessageKind,
    rate: Rate,
    talker: Option<Talker>,
    sent: u64,
}

impl Port {
    /// A port that has sent nothing yet.
    #[must_use]
    pub fn new(config: OutputPortConfig) -> Self {
        let talker = |kind: MessageKind| {
            let own = config.talkers.iter().find(|(own, _)| *own == kind);
            own.map(|(_, talker)| *talker).or(config.talker)
        };
        let lines = MessageKind::all().filter_map(|kind| {
            let (_, rate) = config.messages.iter().find(|(own, _)| *own == kind)?;
            Some(LineUp { kind, rate: *rate, talker: talker(kind), sent: 0 })
        });
        Port { lines: lines.collect(), config, turn: None, told: 0 }
    }

    /// What the port was made from.
    #[must_use]
    pub fn config(&self) -> &OutputPortConfig {
        &self.config
    }

    /// Its messages in the order of their slots.
    pub fn kinds(&self) -> impl Iterator<Item = MessageKind> {
        self.lines.iter().map(|line| line.kind)
    }

    /// Its messages with their talkers; makers' own have none.
    pub(crate) fn talkers(&self) -> impl Iterator<Item = (MessageKind, Option<Talker>)> {
        let talker = |line: &LineUp| line.kind.talker().map(|usual| line.talker.unwrap_or(usual));
        self.lines.iter().map(move |line| (line.kind, talker(line)))
    }

    /// Whether it sends ALF or ALC.
    pub(crate) fn tells_alerts(&self) -> bool {
        self.kinds().any(MessageKind::tells_alerts)
    }

    /// How often something is due.
    pub fn rates(&self) -> impl Iterator<Item = Rate> {
        self.lines.iter().map(|line| line.rate)
    }

    /// Most bytes per second that the port has to carry.
    #[must_use]
    pub fn bytes_per_second(&self) -> f64 {
        let bytes = |line: &LineUp| line.kind.longest() as f64 * line.rate.as_hertz();
        self.lines.iter().map(bytes).sum()
    }

    /// The messages that are due with this epoch, which is that of the port's monitoring point.
    pub fn messages(&mut self, epoch: &OutputEpoch) -> Vec<PortMessage> {
        self.messages_with(epoch, None)
    }

    /// The same, where a board has the alerts; without one nothing is said of them.
    pub fn messages_with(
        &mut self,
        epoch: &OutputEpoch,
        board: Option<&AlertBoard>,
    ) -> Vec<PortMessage> {
        let rate_of_turn = self.damped(epoch);
        let geoid = self.config.geoid_separation.or(epoch.geoid);
        let epoch = OutputEpoch { rate_of_turn, geoid, ..*epoch };
        let grid = epoch.boundary().grid();
        let manner = &self.config.manner;
        let alerts = board.map(|board| board.list(|condition| manner.shows(condition)));
        let said = RedactedEpoch::new(&epoch, manner).with_alerts(alerts.as_deref());
        let slots = u16::try_from(self.lines.len()).unwrap_or(u16::MAX);
        let mut messages = Vec::new();
        for (slot, line) in (0..).zip(&mut self.lines).filter(|(_, line)| line.rate.is_on(grid)) {
            if !line.kind.tells_changes() {
                messages.extend(line.say(slot, &said));
                continue;
            }
            let Some(board) = board else { continue };
            for change in &board.news(self.told, |condition| manner.shows(condition)) {
                let slot = slots.saturating_add(change.key());
                messages.extend(line.say(slot, &said.with_announcement(change)));
            }
            self.told = board.stamp();
        }
        messages
    }

    /// The rate of turn through a low pass of first order.
    fn damped(&mut self, epoch: &OutputEpoch) -> Option<f64> {
        let solution = epoch.solution.filter(|solution| solution.mode.is_navigating());
        let rate = solution.map(|solution| solution.rate_of_turn());
        let Some(rate) = rate.filter(|rate| rate.is_finite()) else {
            self.turn = None;
            return None;
        };
        let constant = self.config.turn_damping;
        let damped = match self.turn {
            Some((last, before)) if constant > 0.0 => {
                let passed = (epoch.time - last).as_seconds().max(0.0);
                before + (rate - before) * -(-passed / constant).exp_m1()
            }
            _ => rate,
        };
        self.turn = Some((epoch.time, damped));
        Some(damped)
    }
}

impl LineUp {
    /// One message, if there is anything to say.
    fn say(&mut self, slot: u16, said: &RedactedEpoch<'_>) -> Option<PortMessage> {
        let (kind, period) = (self.kind, self.rate.period());
        let said = said.with_count(self.sent).with_period(period);
        let content = kind.make(&said, self.talker)?;
        self.sent += 1;
        let (valid, utc) = (said.time(), said.utc());
        Some(PortMessage { slot, kind, content, valid, utc, period })
    }
}
