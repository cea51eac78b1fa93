//! A bus that anything may stand on: an assembler and a roster that listen, and a node that also sends.

use std::collections::BTreeSet;

use insd_base::can::CanFrame;
use insd_base::{Span, Time};
use insd_n2k::fast_packet::MAX_LENGTH;
use insd_n2k::node::{Node, NodeState};
use insd_n2k::pgn::{Integrity, Known};
use insd_n2k::{Assembler, BusMessage, LAST_ADDRESS, N2kId, NULL_ADDRESS, Name, NameParts, Roster};

use super::common::{claim, config, frame, iso_request, name, parts};
use super::heard;
use super::leaving::Leaving;

/// The bus's time ends here, s: a century is far beyond any voyage.
const END: f64 = 3.2e9;
/// The node is woken so often at most between two doings; then its computer sleeps.
const MOST_WAKES: u32 = 100;
/// Messages under way in an assembler, by its own limits.
const MOST_UNDER_WAY: usize = 64 + 16;
/// Messages that wait in a node, by its own limits.
const MOST_WAITING: usize = 32 + 32 + 64;
/// Characters that tell all that a node knows.
const MOST_TEXT: usize = 600_000;

/// What a storm brought: messages heard, of which understood, whole fast packets that left, and frames.
pub(crate) type Weathered = [u64; 4];

struct Storm {
    now: Time,
    assembler: Assembler,
    roster: Roster,
    node: Node,
    leaving: Leaving,
    /// The frame at the link, not sent and not refused yet.
    at_link: Option<CanFrame>,
    /// Frames that the link will refuse.
    refusals: u8,
    /// Doings until the link says what became of its frame.
    slow: u8,
    asleep: bool,
    heard: u64,
    understood: u64,
}

/// Lets the storm blow that the bytes say, and then asks the node whether it is there.
pub(crate) fn everything(bytes: &[u8]) -> Weathered {
    let Some((choice, mut bytes)) = bytes.split_first() else { return Weathered::default() };
    let mut storm = Storm::new(*choice);
    while let [what, step, length, rest @ ..] = bytes {
        let (own, rest) = rest.split_at(rest.len().min(usize::from(*length)));
        bytes = rest;
        storm.go_on(*step);
        storm.act(what % 16, own);
        storm.drive();
        assert!(storm.assembler.under_way() <= MOST_UNDER_WAY);
        assert!(storm.node.status().waiting <= MOST_WAITING);
    }
    storm.look();
    storm.calm_down();
    storm.ask();
    [storm.heard, storm.understood, storm.leaving.whole, storm.leaving.frames]
}

impl Storm {
    fn new(choice: u8) -> Self {
        let mut config = config(name(1000), choice);
        if choice & 1 == 1 {
            let fixed = NameParts { arbitrary_address: false, ..parts(1000) };
            config.name = fixed.name().unwrap();
        }
        let mut node = Node::new(config, choice.into());
        let now = Time::from_seconds(10.0);
        node.up(now);
        Storm {
            now,
            assembler: Assembler::new(),
            roster: Roster::default(),
            node,
            leaving: Leaving::default(),
            at_link: None,
            refusals: 0,
            slow: 0,
            asleep: false,
            heard: 0,
            understood: 0,
        }
    }

    /// Lets time pass. The node is woken when it wants.
    fn go_on(&mut self, step: u8) {
        let count = f64::from(step & 63);
        let seconds = match step >> 6 {
            0 => count * 1e-4,
            1 => count * 1e-2,
            2 => count,
            _ => f64::from(step & 31).exp2(),
        };
        let left = END - self.now.as_seconds();
        self.run(Span::from_seconds(seconds.min(left)));
    }

    fn run(&mut self, span: Span) {
        let end = self.now + span;
        for _ in 0..MOST_WAKES {
            let Some(at) = self.node.wake_at().filter(|at| *at <= end && !self.asleep) else {
                break;
            };
            self.now = self.now.max(at);
            self.node.wake(self.now);
            self.drive();
        }
        self.now = end;
    }

    fn act(&mut self, what: u8, bytes: &[u8]) {
        let own = self.own();
        let frames = match what {
            0..=2 => heard::frame(bytes).into_iter().collect(),
            3 => heard::message(bytes, own).unwrap_or_default(),
            4 | 5 => heard::damaged(bytes, own).unwrap_or_default(),
            6 => heard::transfer(bytes, own).unwrap_or_default(),
            7 => heard::transfer(bytes, 255).unwrap_or_default(),
            8 => heard::function(bytes, own).unwrap_or_default(),
            9 => request(bytes, own).into_iter().collect(),
            10 => heard::claim(bytes).into_iter().collect(),
            11 => heard::crowd(bytes),
            12 => vec![self.rival(bytes, own)],
            13 => return self.hand_in(bytes),
            14 => return self.disturb(bytes),
            _ => return self.bus(bytes),
        };
        for frame in frames {
            self.hear(&frame);
        }
    }

    /// The address that the node holds or held.
    fn own(&self) -> u8 {
        self.node.address().unwrap_or(self.node.config().address)
    }

    fn hear(&mut self, frame: &CanFrame) {
        self.node.hear(frame, self.now);
        let Some(assembled) = self.assembler.take(frame, self.now) else { return };
        assert!(assembled.begun <= self.now);
        self.heard += 1;
        self.roster.learn(&assembled.message);
        self.understood += u64::from(understand(&assembled.message));
    }

    /// A claim of the node's address.
    fn rival(&self, bytes: &[u8], own: u8) -> CanFrame {
        let bits = self.node.config().name.bits();
        let name = match bytes.first().map(|which| which % 3) {
            Some(0) => bits.wrapping_sub(1),
            Some(1) => bits.wrapping_add(1),
            _ => bits,
        };
        claim(Name::new(name), own)
    }

    fn hand_in(&mut self, bytes: &[u8]) {
        let Some((which, data)) = bytes.split_first() else { return };
        let pgn = [127_250, 129_029, 126_996][usize::from(*which) % 3];
        let sent = self.node.send(pgn, data, self.now);
        assert!(!sent || self.node.address().is_some());
    }

    fn disturb(&mut self, bytes: &[u8]) {
        let how = bytes.first().copied().unwrap_or_default();
        if how & 1 == 0 { self.refusals = how >> 1 } else { self.slow = how >> 1 }
    }

    fn bus(&mut self, bytes: &[u8]) {
        match bytes.first().map_or(0, |how| how % 5) {
            0 => self.node.down(self.now),
            1 => self.node.up(self.now),
            2 => self.node.bus_off(self.now),
            3 => self.node.restarted(self.now),
            _ => self.asleep = !self.asleep,
        }
        self.assembler.forget();
        self.leaving.forget_claims();
    }

    /// What the owner of the node does after everything: sends what there is.
    fn drive(&mut self) {
        if self.at_link.is_some() && self.slow > 0 {
            self.slow -= 1;
            return;
        }
        self.finish();
        while let Some(frame) = self.next_frame() {
            assert_eq!(self.node.next_frame(self.now), Some(frame), "the same until it is sent");
            self.leaving.look(&self.node, &frame);
            self.at_link = Some(frame);
            if self.slow > 0 {
                return;
            }
            self.finish();
        }
        while self.node.poll_event().is_some() {}
        let busy = self.node.wake_at().filter(|at| *at <= self.now && !self.asleep);
        assert_eq!(busy, None, "it wants to be woken again and again");
    }

    fn next_frame(&mut self) -> Option<CanFrame> {
        let frame = self.node.next_frame(self.now);
        if frame.is_some() || self.asleep {
            return frame;
        }
        self.node.wake(self.now);
        self.node.next_frame(self.now)
    }

    /// The link says what became of its frame.
    fn finish(&mut self) {
        let Some(frame) = self.at_link.take() else { return };
        if self.refusals > 0 {
            self.refusals -= 1;
            self.node.refused(self.now);
        } else {
            self.leaving.left(&self.node, &frame, self.now);
            self.node.sent(self.now);
        }
    }

    /// Memory is bounded, and each node sits at one address.
    fn look(&self) {
        let known = format!("{:?}", self.node).len();
        assert!(known <= MOST_TEXT, "{known} characters");
        for roster in [&self.roster, self.node.roster()] {
            let names: BTreeSet<Name> = roster.iter().map(|(_, name)| name).collect();
            assert_eq!(names.len(), roster.iter().count());
            assert!(roster.iter().all(|(address, _)| address <= LAST_ADDRESS));
        }
    }

    /// The bus is there, the link takes everything, and nobody says anything any more.
    fn calm_down(&mut self) {
        (self.refusals, self.slow, self.asleep) = (0, 0, false);
        self.drive();
        self.node.up(self.now);
        self.drive();
        // lists of groups that were asked from all addresses go out at 50 a second
        self.run_on(20.0);
        let (before, held) = (self.leaving.frames, self.node.address().is_some());
        self.run_on(10.0);
        let sent = self.leaving.frames - before;
        // heartbeats; who finds an address only now gives the answers that it still owes
        assert!(sent <= 20 || !held, "{sent} frames in ten seconds of silence");
        if self.node.status().state == NodeState::Claiming {
            self.run_on(3.0);
        }
    }

    fn run_on(&mut self, seconds: f64) {
        let end = self.now + Span::from_seconds(seconds);
        while self.now < end {
            let next = self.node.wake_at().unwrap_or(end).clamp(self.now, end);
            self.now = next;
            self.node.wake(next);
            self.drive();
        }
    }

    /// The node answers a request within a second, whether it has an address or not.
    fn ask(&mut self) {
        let from = if self.node.address() == Some(3) { 4 } else { 3 };
        self.hear(&iso_request(60_928, from, 255));
        let mut claimed = self.await_group(60_928);
        let state = self.node.status().state;
        if state == NodeState::Claiming {
            // it has just asked anew who is there, and claims a second after that
            claimed = claimed || self.await_group(60_928);
        }
        assert!(claimed, "no claim of one who is {state:?}");
        let Some(address) = self.node.address() else { return };
        assert_ne!(address, NULL_ADDRESS);
        for pgn in [126_996, 126_998, 126_464, 126_993] {
            self.hear(&iso_request(pgn, from, address));
            assert!(self.await_group(pgn), "no {pgn}");
        }
    }

    /// Whether a frame of the group leaves within a second.
    fn await_group(&mut self, pgn: u32) -> bool {
        let end = self.now + Span::from_seconds(1.0);
        while self.now <= end {
            self.node.wake(self.now);
            while let Some(frame) = self.node.next_frame(self.now) {
                self.leaving.look(&self.node, &frame);
                self.leaving.left(&self.node, &frame, self.now);
                self.node.sent(self.now);
                if N2kId::parse(frame.id()).is_some_and(|id| id.pgn == pgn) {
                    return true;
                }
            }
            self.now = self.node.wake_at().map_or(end, |at| at.max(self.now));
        }
        false
    }
}

/// A request: group, source, and whether it asks everybody.
fn request(bytes: &[u8], own: u8) -> Option<CanFrame> {
    let [number, source, way, ..] = bytes else { return None };
    let destination = if way & 1 == 0 { own } else { 255 };
    let [low, middle, high, _] = heard::group(*number).to_le_bytes();
    Some(frame(6, 59_904, *source, destination, &[low, middle, high]))
}

/// Reads a message as the group it is of; what is written of it reads the same, unless it is longer
/// than what is written.
fn understand(message: &BusMessage) -> bool {
    assert!(message.data.len() <= 1785);
    let Some(Ok(known)) = Known::read(message.pgn, &message.data) else { return false };
    assert_eq!(known.pgn(), message.pgn);
    if message.data.len() > MAX_LENGTH {
        return true;
    }
    let again = Known::read(message.pgn, &known.write()).unwrap().unwrap();
    assert_eq!(rounded(again, &known), known);
    true
}

/// Numbers of 64 bits do not survive a double: those near enough are taken from the first. Nor has an
/// integrity that was not told a code.
fn rounded(again: Known, first: &Known) -> Known {
    let (Known::GnssPosition(mut again), Known::GnssPosition(first)) = (again.clone(), first)
    else {
        return again;
    };
    let near = |again: &mut Option<f64>, first: Option<f64>| {
        let lost = |(again, first): (f64, f64)| (again - first).abs() <= 1e-15 * first.abs();
        *again = if again.zip(first).is_some_and(lost) { first } else { *again };
    };
    near(&mut again.latitude, first.latitude);
    near(&mut again.longitude, first.longitude);
    near(&mut again.altitude, first.altitude);
    if again.integrity == Some(Integrity::NoChecking) && first.integrity.is_none() {
        again.integrity = None;
    }
    Known::GnssPosition(again)
}
