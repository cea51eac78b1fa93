//! The contest for an address (ISO 11783-5, 4.5).
//!
//! A node claims an address and keeps silent for 250 ms; then the address is its own until a node
//! with a lower NAME claims it. Whatever others do, claims are bounded by a budget.

use insd_base::{Span, Time};

use super::NodeEvent;
use super::budget::Budget;
use super::random::Random;
use crate::{LAST_ADDRESS, NULL_ADDRESS, Name, Roster};

/// The silence after a claim.
const SILENCE: Span = Span::from_nanos(250_000_000);
/// Claims at once ...
const BURST: u32 = 32;
/// ... and then one in this time.
const EVERY: Span = Span::from_nanos(250_000_000);
/// Contests in a row that are won against a node that has no right and does not give in ...
const PATIENCE: u32 = 20;
/// ... if no longer than this lies between them.
const ROW: Span = Span::from_nanos(2_000_000_000);
/// Time between two reports of a node with the same NAME, or one that uses this address.
const REPORT: Span = Span::from_nanos(10_000_000_000);
/// The shortest time between two attempts of a node without address.
const RETRY: Span = Span::from_nanos(1_000_000_000);
/// After this long without an address the node asks again who is there: some may have gone.
const SURVEY: Span = Span::from_nanos(300_000_000_000);

/// How far the node is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    Down,
    /// Claimed, and silent until then.
    Claiming {
        address: u8,
        until: Time,
    },
    Held {
        address: u8,
    },
    /// Claims the next free address from this one on, at that time.
    Yielding {
        from: u8,
        until: Time,
    },
    /// Says at that time that it cannot claim.
    Leaving {
        until: Time,
    },
    /// Has said so, and asks at that time who is there.
    Homeless {
        since: Time,
    },
}

/// What the node has to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Step {
    /// Send a claim of this address now.
    Claim(u8),
    /// Send a claim of the address, but not too often.
    Repeat,
    /// Send nothing of what waits.
    Clear,
    /// The address is the node's own.
    Held(u8),
    /// Forget who is there, and ask.
    Survey,
    /// Tell the owner.
    Tell(NodeEvent),
}

/// Contests won and lost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ContestCounts {
    /// Contests won against a higher NAME.
    pub won: u64,
    /// Contests lost to a lower NAME.
    pub lost: u64,
    /// Claims by a node with the same NAME.
    pub same_name: u64,
    /// Frames that another sent from this node's address.
    pub address_used: u64,
}

/// The contest of one node.
#[derive(Clone, Debug)]
pub(crate) struct Claim {
    name: Name,
    /// Where to begin; the only one if the NAME does not allow others.
    preferred: u8,
    state: State,
    budget: Budget,
    /// Contests won in a row, and when the last was.
    row: (u32, Time),
    /// When a node with the same NAME was last reported, and one that uses this address.
    reported_name: Option<Time>,
    reported_use: Option<Time>,
    steps: Vec<Step>,
    pub(crate) counts: ContestCounts,
}

impl Claim {
    pub(crate) fn new(name: Name, preferred: u8) -> Self {
        Claim {
            name,
            preferred: preferred.min(LAST_ADDRESS),
            state: State::Down,
            budget: Budget::new(BURST, EVERY),
            row: (0, Time::START),
            reported_name: None,
            reported_use: None,
            steps: Vec::new(),
            counts: ContestCounts::default(),
        }
    }

    /// The address that may be used.
    pub(crate) fn address(&self) -> Option<u8> {
        match self.state {
            State::Held { address } => Some(address),
            _ => None,
        }
    }

    /// The address that is claimed, or from which it is said that none can be.
    pub(crate) fn source(&self) -> Option<u8> {
        match self.state {
            State::Held { address } | State::Claiming { address, .. } => Some(address),
            State::Homeless { .. } => Some(NULL_ADDRESS),
            _ => None,
        }
    }

    pub(crate) fn is_down(&self) -> bool {
        self.state == State::Down
    }

    pub(crate) fn is_claiming(&self) -> bool {
        matches!(self.state, State::Claiming { .. } | State::Yielding { .. })
    }

    /// What is to be done, in order.
    pub(crate) fn steps(&mut self) -> Vec<Step> {
        std::mem::take(&mut self.steps)
    }

    /// The bus is there.
    pub(crate) fn up(&mut self, now: Time) {
        self.claim(self.preferred, now);
    }

    /// The bus is gone.
    pub(crate) fn down(&mut self) {
        self.state = State::Down;
        self.steps.push(Step::Clear);
    }

    /// The node has another NAME, and tells so.
    pub(crate) fn rename(&mut self, name: Name) {
        self.name = name;
        self.steps.push(Step::Repeat);
    }

    /// The node is to take this address.
    pub(crate) fn command(&mut self, address: u8, now: Time) {
        self.preferred = address;
        self.steps.push(Step::Clear);
        self.claim(address, now);
    }

    /// Somebody claims an address. The roster has learnt it already.
    pub(crate) fn hear(
        &mut self,
        source: u8,
        name: Name,
        roster: &Roster,
        random: &mut Random,
        now: Time,
    ) {
        let ours = self.source().filter(|address| *address == source && source <= LAST_ADDRESS);
        match ours {
            _ if name == self.name => self.meet_double(source, ours.is_some(), random, now),
            Some(address) if self.name < name => self.win(address, name, roster, random, now),
            Some(address) => {
                self.counts.lost += 1;
                self.steps.push(Step::Tell(NodeEvent::Lost { address, to: name }));
                self.give_up(address, roster, random, now);
            }
            None => {}
        }
        self.look_for_home(roster, random, now);
    }

    /// Another node has the same NAME. At the same address both give way, each in its own time.
    fn meet_double(&mut self, source: u8, here: bool, random: &mut Random, now: Time) {
        self.counts.same_name += 1;
        if here || is_new(&mut self.reported_name, now) {
            self.steps.push(Step::Tell(NodeEvent::SameName { address: source }));
        }
        if here {
            self.steps.push(Step::Clear);
            let until = now + random.delay();
            self.state = State::Yielding { from: after(source), until };
        }
    }

    fn win(&mut self, address: u8, to: Name, roster: &Roster, random: &mut Random, now: Time) {
        self.counts.won += 1;
        let (count, last) = self.row;
        self.row = (if now - last <= ROW { count + 1 } else { 1 }, now);
        if self.row.0 <= PATIENCE {
            self.steps.push(Step::Repeat);
            return;
        }
        self.row.0 = 0;
        self.steps.push(Step::Tell(NodeEvent::GaveWay { address, to }));
        self.give_up(address, roster, random, now);
    }

    fn give_up(&mut self, address: u8, roster: &Roster, random: &mut Random, now: Time) {
        self.steps.push(Step::Clear);
        self.claim_free(after(address), roster, random, now);
    }

    /// Somebody sends from the node's address. Who has no right to it gives way to a claim.
    pub(crate) fn address_used(&mut self, now: Time) {
        self.counts.address_used += 1;
        let Some(address) = self.address() else { return };
        if is_new(&mut self.reported_use, now) {
            self.steps.push(Step::Repeat);
            self.steps.push(Step::Tell(NodeEvent::AddressUsed { address }));
        }
    }

    /// Claims the next free address, or begins to leave.
    fn claim_free(&mut self, from: u8, roster: &Roster, random: &mut Random, now: Time) {
        match self.free(from, roster) {
            Some(address) => self.claim(address, now),
            None => {
                self.state = State::Leaving { until: now + random.delay() };
                self.steps.push(Step::Tell(NodeEvent::NoneFree));
            }
        }
    }

    /// The next address from this one on that nobody has.
    fn free(&self, from: u8, roster: &Roster) -> Option<u8> {
        let is_free = |address: &u8| roster.name_at(*address).is_none();
        if !self.name.parts().arbitrary_address {
            return Some(self.preferred).filter(is_free);
        }
        (from..=LAST_ADDRESS).chain(0..from).find(is_free)
    }

    fn claim(&mut self, address: u8, now: Time) {
        if self.budget.take(now) {
            self.state = State::Claiming { address, until: now + SILENCE };
            self.steps.push(Step::Claim(address));
        } else {
            self.state = State::Yielding { from: address, until: self.budget.next(now) };
        }
    }

    /// Claims again when an address has become free.
    fn look_for_home(&mut self, roster: &Roster, random: &mut Random, now: Time) {
        let State::Homeless { since } = self.state else { return };
        if let Some(from) = self.free(self.preferred, roster) {
            let until = now.max(since + RETRY) + random.delay();
            self.state = State::Yielding { from, until };
        }
    }

    /// Does what the time has come for.
    pub(crate) fn wake(&mut self, roster: &Roster, random: &mut Random, now: Time) {
        if self.wake_at().is_none_or(|at| now < at) {
            return;
        }
        match self.state {
            State::Claiming { address, .. } => {
                self.state = State::Held { address };
                if self.name.parts().arbitrary_address {
                    self.preferred = address;
                }
                self.steps.push(Step::Held(address));
                self.steps.push(Step::Tell(NodeEvent::Claimed { address }));
            }
            State::Yielding { from, .. } => self.claim_free(from, roster, random, now),
            State::Leaving { .. } => {
                self.state = State::Homeless { since: now };
                self.steps.push(Step::Claim(NULL_ADDRESS));
            }
            State::Homeless { .. } => {
                self.steps.push(Step::Survey);
                self.state = State::Yielding { from: self.preferred, until: now + RETRY };
            }
            State::Down | State::Held { .. } => {}
        }
    }

    /// When [`Claim::wake`] has something to do.
    pub(crate) fn wake_at(&self) -> Option<Time> {
        match self.state {
            State::Down | State::Held { .. } => None,
            State::Claiming { until, .. }
            | State::Yielding { until, .. }
            | State::Leaving { until } => Some(until),
            State::Homeless { since } => Some(since + SURVEY),
        }
    }
}

/// Whether the last report is long enough ago; then this is the last.
fn is_new(reported: &mut Option<Time>, now: Time) -> bool {
    let new = reported.is_none_or(|last| now - last >= REPORT);
    if new {
        *reported = Some(now);
    }
    new
}

/// The next address.
fn after(address: u8) -> u8 {
    if address >= LAST_ADDRESS { 0 } else { address + 1 }
}
