//! Statistics of one port.

use insd_base::{Input, PortState, Sent, Stamp, Time};
use insd_intake::port::{Link, PortCounts, PortFrame, PortIntake};
use insd_wire::stream::Protocol;

use super::advice;
use super::bus::Bus;
use super::message::Message;
use super::named::{Named, named};
use super::plan::PortToHear;
use super::pulses::Pulses;
use super::report::{PortReport, State};
use super::satellites::Satellites;
use super::seen::{Seen, SeenWhat};
use super::suggestion;
use super::tally::Tally;

/// Kinds of messages that are told apart.
const MESSAGES: usize = 96;

/// Bytes that came last and are kept to find out what they may be.
const TAIL: usize = 2048;

/// Bits of a byte on a serial line: start, eight of data, stop.
const SYMBOLS: f64 = 10.0;

/// Silence after which a port that has spoken counts as silent, s, and one that never has.
const SILENCE: f64 = 3.0;
const NEVER: f64 = 1.0;

/// Least time over which a number of bytes per second means something, s.
const LEAST: f64 = 0.5;

/// What came at one port.
#[derive(Clone, Debug)]
pub(super) struct Port {
    plan: PortToHear,
    protocols: Vec<Protocol>,
    told: Told,
    /// Bytes heard while no baud rate could be found.
    pub(super) unreadable: u64,
    /// What is known of it by other means than its arrivals.
    pub(super) notes: Vec<String>,
    what: Option<String>,
    baud: Option<u32>,
    link: Link,
    intake: PortIntake,
    /// Counts of the links before this one.
    before: PortCounts,
    since: Option<Time>,
    last: Option<Time>,
    dropped: u64,
    losses: u32,
    kinds: Kinds,
    pulses: Option<Pulses>,
    bus: Bus,
    tail: Vec<u8>,
    stray_told: u64,
}

/// Messages with who sent them.
#[derive(Clone, Debug, Default)]
struct Kinds {
    messages: Vec<Message>,
    more: u64,
    talkers: Tally,
    sources: Tally,
    satellites: Satellites,
}

/// The last that was told of the port.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Told {
    Nothing,
    Open,
    Absent(String),
    Lost(String),
    Ended,
}

impl Port {
    pub(super) fn new(plan: PortToHear, protocols: &[Protocol]) -> Self {
        let link = Link::Stream;
        Port {
            plan,
            protocols: protocols.to_vec(),
            told: Told::Nothing,
            unreadable: 0,
            notes: Vec::new(),
            what: None,
            baud: None,
            link,
            intake: PortIntake::new(link, protocols),
            before: PortCounts::default(),
            since: None,
            last: None,
            dropped: 0,
            losses: 0,
            kinds: Kinds::default(),
            pulses: None,
            bus: Bus::default(),
            tail: Vec::new(),
            stray_told: 0,
        }
    }

    pub(super) fn is_settled(&self) -> bool {
        self.told != Told::Nothing
    }

    pub(super) fn is_ended(&self) -> bool {
        self.told == Told::Ended
    }

    pub(super) fn take(&mut self, stamp: &Stamp, input: &Input, show: &mut impl FnMut(&Seen<'_>)) {
        match input {
            Input::Bytes(bytes) | Input::Sent(Sent { bytes, .. }) => self.bytes(stamp, bytes, show),
            Input::Can(frame) => {
                self.speaks(stamp);
                self.bus.frame(stamp, frame);
                show(&Seen {
                    port: &self.plan.name,
                    timed: self.plan.timed,
                    stamp: *stamp,
                    what: SeenWhat::Can(*frame),
                });
            }
            Input::Bus(event) => {
                self.bus.event(*event);
                show(&Seen {
                    port: &self.plan.name,
                    timed: self.plan.timed,
                    stamp: *stamp,
                    what: SeenWhat::Bus(*event),
                });
            }
            Input::Pulse(pulse) => {
                self.speaks(stamp);
                self.pulses = Some(Pulses::with(self.pulses.take(), stamp, pulse));
                let what = SeenWhat::Pulse { sequence: pulse.sequence };
                show(&Seen { port: &self.plan.name, timed: self.plan.timed, stamp: *stamp, what });
            }
            Input::State(state) => {
                self.state(stamp, state, show);
                let what = SeenWhat::State(state);
                show(&Seen { port: &self.plan.name, timed: self.plan.timed, stamp: *stamp, what });
            }
            Input::Tick | Input::Order(_) | Input::Storage(_) => {}
        }
    }

    fn speaks(&mut self, stamp: &Stamp) {
        let now = stamp.monotonic;
        self.since.get_or_insert(now);
        self.last = Some(now);
        // a recording may begin after its port was opened
        if self.told == Told::Nothing {
            self.told = Told::Open;
        }
    }

    fn bytes(&mut self, stamp: &Stamp, bytes: &[u8], show: &mut impl FnMut(&Seen<'_>)) {
        self.speaks(stamp);
        let from = bytes.len().saturating_sub(TAIL);
        self.tail.extend_from_slice(bytes.get(from..).unwrap_or_default());
        let excess = self.tail.len().saturating_sub(TAIL);
        self.tail.drain(..excess);
        let (kinds, plan) = (&mut self.kinds, &self.plan);
        self.intake.take(stamp, bytes, |frame| kinds.frame(plan, stamp, frame, show));
        let stray = self.counts().skipped;
        if stray > self.stray_told {
            let what = SeenWhat::Stray { count: stray - self.stray_told, bytes };
            show(&Seen { port: &self.plan.name, timed: self.plan.timed, stamp: *stamp, what });
            self.stray_told = stray;
        }
    }

    fn state(&mut self, stamp: &Stamp, state: &PortState, show: &mut impl FnMut(&Seen<'_>)) {
        match state {
            PortState::Open { what } => {
                self.since.get_or_insert(stamp.monotonic);
                self.told = Told::Open;
                self.baud = baud(what);
                self.relink(link(what), stamp, show);
                self.what = Some(what.clone());
            }
            PortState::Absent { reason } => self.told = Told::Absent(reason.clone()),
            PortState::Lost { reason } => {
                self.told = Told::Lost(reason.clone());
                self.losses = self.losses.saturating_add(1);
                self.interrupt(stamp, show);
            }
            PortState::Overrun { bytes } => self.dropped += bytes,
            PortState::Ended => {
                self.told = Told::Ended;
                self.interrupt(stamp, show);
            }
            PortState::Silent { .. } | PortState::Speaking | PortState::Refused { .. } => {}
        }
    }

    fn interrupt(&mut self, stamp: &Stamp, show: &mut impl FnMut(&Seen<'_>)) {
        let (kinds, plan) = (&mut self.kinds, &self.plan);
        self.intake.interrupt(stamp, |frame| kinds.frame(plan, stamp, frame, show));
    }

    /// Goes on with another link, if it is another one.
    fn relink(&mut self, link: Link, stamp: &Stamp, show: &mut impl FnMut(&Seen<'_>)) {
        if link != self.link {
            self.interrupt(stamp, show);
            self.before = self.counts();
            self.link = link;
            self.intake = PortIntake::new(link, &self.protocols);
        }
    }

    fn counts(&self) -> PortCounts {
        let (before, now) = (self.before, self.intake.counts());
        PortCounts {
            bytes: before.bytes + now.bytes,
            frames: before.frames + now.frames,
            skipped: before.skipped + now.skipped,
            damaged: before.damaged + now.damaged,
        }
    }

    pub(super) fn report(&self, now: Time) -> PortReport {
        let counts = self.counts();
        let timed = self.plan.timed.then_some(now);
        let seconds = timed.zip(self.since).map(|(now, since)| (now - since).as_seconds().max(0.0));
        let per_second = seconds.filter(|s| *s >= LEAST).map(|s| counts.bytes as f64 / s);
        let capacity = self.baud.map(|baud| f64::from(baud) / SYMBOLS);
        let mut messages: Vec<_> =
            self.kinds.messages.iter().map(|message| message.report(timed)).collect();
        messages.sort_by(|a, b| (a.protocol, &a.name).cmp(&(b.protocol, &b.name)));
        let mut report = PortReport {
            name: self.plan.name.clone(),
            state: self.state_at(now),
            what: self.what.clone(),
            baud: self.baud,
            seconds,
            bytes: counts.bytes,
            bytes_per_s: per_second,
            load: per_second.zip(capacity).map(|(bytes, capacity)| bytes / capacity),
            stray: counts.skipped,
            frames: counts.frames,
            damaged: counts.damaged,
            dropped: self.dropped,
            losses: self.losses,
            messages,
            more: self.kinds.more,
            talkers: self.kinds.talkers.sorted(),
            sources: self.kinds.sources.sorted(),
            satellites: self.kinds.satellites.report(),
            pulses: self.pulses.as_ref().map(|pulses| pulses.report(now)),
            bus: self.bus.report(timed, seconds.filter(|s| *s >= LEAST)),
            hints: Vec::new(),
            suggestions: Vec::new(),
        };
        report.hints = self.notes.clone();
        report.hints.extend(advice::hints(&report, &self.tail, self.unreadable, &self.protocols));
        report.suggestions = suggestion::sections(&report, self.plan.transport.as_ref());
        report
    }

    fn state_at(&self, now: Time) -> State {
        match &self.told {
            Told::Nothing => State::Opening,
            Told::Absent(reason) => State::Absent { reason: reason.clone() },
            Told::Lost(reason) => State::Lost { reason: reason.clone() },
            Told::Ended => State::Ended,
            Told::Open => {
                let limit = if self.last.is_some() { SILENCE } else { NEVER };
                let since = self.last.or(self.since).unwrap_or(now);
                let silent_s = (now - since).as_seconds();
                if silent_s >= limit { State::Silent { silent_s } } else { State::Open }
            }
        }
    }
}

impl Kinds {
    fn frame(
        &mut self,
        plan: &PortToHear,
        stamp: &Stamp,
        frame: &PortFrame<'_>,
        show: &mut impl FnMut(&Seen<'_>),
    ) {
        let named = named(frame.protocol, frame.bytes);
        if let Some(talker) = named.talker {
            self.talkers.add(talker.as_str());
        }
        if let Some(source) = named.source {
            self.sources.add(source);
        }
        self.satellites.take(frame.protocol, stamp, frame.bytes);
        match self.message(frame.protocol, &named) {
            Some(message) => message.add(&named, frame.begun, frame.bytes),
            None => self.more += 1,
        }
        let what = SeenWhat::Frame {
            protocol: frame.protocol,
            name: &named.name,
            read: named.read,
            reason: named.reason.as_deref(),
            bytes: frame.bytes,
        };
        let system = stamp.system.plus(frame.ended - stamp.monotonic);
        let stamp = Stamp { monotonic: frame.ended, system };
        show(&Seen { port: &plan.name, timed: plan.timed, stamp, what });
    }

    /// The message of this name, made known if there is room.
    fn message(&mut self, protocol: Protocol, named: &Named<'_>) -> Option<&mut Message> {
        let is = |message: &Message| message.protocol == protocol && message.name == named.name;
        let at = match self.messages.iter().position(is) {
            Some(at) => at,
            None if self.messages.len() < MESSAGES => {
                self.messages.push(Message::new(protocol, &named.name));
                self.messages.len() - 1
            }
            None => return None,
        };
        self.messages.get_mut(at)
    }
}

/// The baud rate in what a serial port says when it is open: `/dev/ttyUSB0 at 38400 baud`.
fn baud(what: &str) -> Option<u32> {
    what.strip_suffix(" baud")?.rsplit_once(" at ")?.1.parse().ok().filter(|baud| *baud > 0)
}

/// What carries the bytes of a port that says this when it is open.
pub(super) fn link(what: &str) -> Link {
    match baud(what) {
        Some(baud) => Link::Serial { byte_time: SYMBOLS / f64::from(baud) },
        None if what.starts_with("udp ") => Link::Datagrams,
        None => Link::Stream,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_link_is_known_by_what_was_opened() {
        assert_eq!(baud("/dev/serial at home at 4800 baud"), Some(4800));
        assert_eq!(link("/dev/ttyS0 at 4800 baud"), Link::Serial { byte_time: 10.0 / 4800.0 });
        assert_eq!(link("udp 0.0.0.0:60001 in group 239.192.0.1"), Link::Datagrams);
        assert_eq!(link("tcp 192.168.1.20:10110"), Link::Stream);
        assert_eq!(baud("/dev/ttyS0 at 0 baud"), None);
    }
}
