//! A node of the bus: frames in, frames and wake-up out.
//!
//! Its owner tells it when the bus comes and goes, hands it all frames of others (never its own),
//! wakes it when it wants, and sends what it hands out:
//!
//! 1. [`Node::up`] when the bus is there, then [`Node::hear`] for each frame and [`Node::wake`] at
//!    [`Node::wake_at`];
//! 2. after each of these, and after [`Node::send`], frames while there are any: [`Node::next_frame`],
//!    then [`Node::sent`] or [`Node::refused`];
//! 3. [`Node::poll_event`] until there is none.
//!
//! Behaviour: ISO 11783-5 (address claim), ISO 11783-3 (requests, acknowledgement, transport
//! protocol), and the groups of network management of NMEA 2000.

mod answers;
mod budget;
mod claim;
mod config;
mod event;
mod function;
mod pairs;
mod pulse;
mod queue;
mod random;
mod reception;
mod replies;
mod status;
mod transmit;

use std::collections::{BTreeMap, VecDeque};

use insd_base::can::CanFrame;
use insd_base::{Span, Time};

pub use crate::groups::ProductInfo;
pub use claim::ContestCounts;
pub use config::NodeConfig;
pub use event::{NodeEvent, Peer};
pub use queue::QueueCounts;
pub use status::{NodeCounts, NodeState, NodeStatus, RequestCounts};
pub use transmit::Transmit;

use crate::groups::IsoRequest;
use crate::pgn::Group;
use crate::transport::{MANAGEMENT, PACKET};
use crate::{ADDRESS_CLAIM, Assembler, BROADCAST, BusMessage, N2kId, NULL_ADDRESS, Roster};
use answers::{Answer, Answers};
use budget::Budget;
use claim::{Claim, Step};
use pulse::Pulse;
use queue::{Kind, Queue};
use random::Random;
use reception::Reception;

/// Events that wait for the owner; when there are more the oldest are dropped.
const MAX_EVENTS: usize = 64;
/// Refusals and acknowledgements at once ...
const COURTESIES: u32 = 32;
/// ... and then one in this time.
const COURTESY_TIME: Span = Span::from_nanos(20_000_000);

/// A node.
#[derive(Clone, Debug)]
pub struct Node {
    config: NodeConfig,
    /// The transmit table as it was configured.
    defaults: Vec<Transmit>,
    claim: Claim,
    roster: Roster,
    assembler: Assembler,
    reception: Reception,
    queue: Queue,
    answers: Answers,
    random: Random,
    courtesy: Budget,
    pulse: Pulse,
    /// The last contents of each group that is sent, and when they came.
    last: BTreeMap<u32, (Time, Vec<u8>)>,
    events: VecDeque<NodeEvent>,
    requests: RequestCounts,
}

impl Node {
    /// A node that is not on a bus yet. The seed is for its random delays and must differ from unit
    /// to unit and from start to start.
    #[must_use]
    pub fn new(config: NodeConfig, seed: u64) -> Self {
        Node {
            defaults: config.transmit.clone(),
            claim: Claim::new(config.name, config.address),
            roster: Roster::default(),
            assembler: Assembler::new(),
            reception: Reception::default(),
            queue: Queue::default(),
            answers: Answers::default(),
            random: Random::new(seed),
            courtesy: Budget::new(COURTESIES, COURTESY_TIME),
            pulse: Pulse::default(),
            last: BTreeMap::new(),
            events: VecDeque::new(),
            requests: RequestCounts::default(),
            config,
        }
    }

    /// The bus is there: asks who is on it, and claims an address.
    pub fn up(&mut self, now: Time) {
        if !self.claim.is_down() {
            return;
        }
        self.roster.clear();
        self.request_claims(now);
        self.claim.up(now);
        self.run_steps(now);
    }

    /// The bus is gone. All that waits is dropped, begun or not.
    pub fn down(&mut self, now: Time) {
        self.claim.down();
        self.assembler.forget();
        self.run_steps(now);
        self.answers.clear();
        self.pulse.stop();
    }

    /// The controller has left the bus because of too many errors.
    pub fn bus_off(&mut self, now: Time) {
        self.down(now);
    }

    /// The controller is back on the bus: others may have taken the address, so it is claimed anew.
    pub fn restarted(&mut self, now: Time) {
        self.down(now);
        self.up(now);
    }

    /// Takes a frame that another node sent. The node's own frames must not come back to it: it would
    /// take them for those of a unit with the same NAME.
    pub fn hear(&mut self, frame: &CanFrame, now: Time) {
        if self.claim.is_down() {
            return;
        }
        if let Some(id) = N2kId::parse(frame.id()) {
            self.take(id, frame, now);
        }
        self.wake(now);
    }

    fn take(&mut self, id: N2kId, frame: &CanFrame, now: Time) {
        if id.pgn == ADDRESS_CLAIM {
            self.random.stir(now);
        } else if self.address() == Some(id.source) {
            self.claim.address_used(now);
            self.run_steps(now);
        }
        let own = self.address() == Some(id.destination);
        let message = match id.pgn {
            MANAGEMENT if own => {
                let reply = self.reception.manage(id, frame.data(), now);
                self.manage(reply, now);
                None
            }
            PACKET if own => {
                let (reply, message) = self.reception.take(id, frame.data(), now);
                self.manage(reply, now);
                if let Some(message) = message {
                    self.receive(&message, now);
                    if self.address() != Some(id.destination) {
                        // the command to leave this address: what waited to be said from there is gone
                        self.manage_from(id.destination, reply, now);
                    }
                }
                None
            }
            _ => self.assembler.take(frame, now).map(|assembled| assembled.message),
        };
        if let Some(message) = message {
            self.receive(&message, now);
        }
    }

    /// Does what the time has come for.
    pub fn wake(&mut self, now: Time) {
        self.claim.wake(&self.roster, &mut self.random, now);
        self.run_steps(now);
        while let Some(reply) = self.reception.wake(now) {
            self.manage(Some(reply), now);
        }
        if self.address().is_some() && self.pulse.is_due(now) {
            self.answers.owe(Answer::Heartbeat, now);
        }
        while let Some(answer) = self.answers.due(self.address().is_some(), now) {
            self.give(answer, now);
        }
    }

    /// When [`Node::wake`] or [`Node::next_frame`] will have something; `None` if only a frame heard
    /// or a message handed in can change that. May be in the past: then there is something now.
    #[must_use]
    pub fn wake_at(&self) -> Option<Time> {
        let times = [
            self.claim.wake_at(),
            self.reception.wake_at(),
            self.pulse.next(),
            self.answers.next(self.address().is_some()),
            self.queue.ready_at(),
        ];
        times.into_iter().flatten().min()
    }

    /// Hands in a message to everybody. Its priority is that of the transmit table; a newer message of
    /// the group replaces one that still waits, unless both are handed in at the same instant. False
    /// if it is not sent: there is no address, or the group is not in the table or switched off.
    pub fn send(&mut self, pgn: u32, data: &[u8], now: Time) -> bool {
        let Some(entry) = self.entry(pgn).copied() else {
            self.requests.not_in_table += 1;
            return false;
        };
        if !entry.enabled {
            return false;
        }
        self.last.insert(pgn, (now, data.to_vec()));
        let Some(source) = self.address() else {
            self.requests.without_address += 1;
            return false;
        };
        let priority = entry.priority;
        let data = data.to_vec();
        let message = BusMessage { priority, pgn, source, destination: BROADCAST, data };
        self.queue.push(message, Kind::Stream, now)
    }

    /// The frame to be sent now, if any. The same again until [`Node::sent`] or [`Node::refused`].
    pub fn next_frame(&mut self, now: Time) -> Option<CanFrame> {
        self.queue.peek(now)
    }

    /// The frame handed out last was sent.
    pub fn sent(&mut self, now: Time) {
        self.queue.sent(now);
    }

    /// The link had no room for the frame handed out last. It will be handed out again after a pause.
    pub fn refused(&mut self, now: Time) {
        self.queue.refused(now);
    }

    /// What happened, in order.
    pub fn poll_event(&mut self) -> Option<NodeEvent> {
        self.events.pop_front()
    }

    /// Lets others command it from now on, or nobody.
    pub fn allow_commands(&mut self, allowed: bool) {
        self.config.commands = allowed;
    }

    /// The address that the node holds.
    #[must_use]
    pub fn address(&self) -> Option<u8> {
        self.claim.address()
    }

    /// What the node sends by itself, as others have changed it.
    #[must_use]
    pub fn transmit(&self) -> &[Transmit] {
        &self.config.transmit
    }

    /// What the node is, as others have changed it.
    #[must_use]
    pub fn config(&self) -> &NodeConfig {
        &self.config
    }

    /// Who else is on the bus.
    #[must_use]
    pub fn roster(&self) -> &Roster {
        &self.roster
    }

    fn entry(&self, pgn: u32) -> Option<&Transmit> {
        self.config.transmit.iter().find(|entry| entry.pgn == pgn)
    }

    fn tell(&mut self, event: NodeEvent) {
        if self.events.len() >= MAX_EVENTS {
            self.events.pop_front();
        }
        self.events.push_back(event);
    }

    /// Does what the contest for the address wants.
    fn run_steps(&mut self, now: Time) {
        for step in self.claim.steps() {
            match step {
                Step::Claim(source) => self.send_claim(source, now),
                Step::Repeat => {
                    self.answers.owe(Answer::Claim, now);
                }
                Step::Clear => {
                    self.queue.clear();
                    self.reception.clear();
                    self.pulse.stop();
                }
                Step::Held(address) => {
                    self.roster.vacate(address);
                    self.pulse.start(now);
                }
                Step::Survey => {
                    self.roster.clear();
                    self.request_claims(now);
                }
                Step::Tell(event) => self.tell(event),
            }
        }
    }

    fn send_claim(&mut self, source: u8, now: Time) {
        let data = self.config.name.bytes().to_vec();
        let (pgn, destination) = (ADDRESS_CLAIM, BROADCAST);
        let message = BusMessage { priority: 6, pgn, source, destination, data };
        self.queue.push(message, Kind::Urgent, now);
    }

    /// Asks everybody for a claim. Who has no address yet may do so from the null address.
    fn request_claims(&mut self, now: Time) {
        let data = IsoRequest { pgn: ADDRESS_CLAIM }.write();
        let (pgn, source, destination) = (IsoRequest::PGN, NULL_ADDRESS, BROADCAST);
        let message = BusMessage { priority: 6, pgn, source, destination, data };
        self.queue.push(message, Kind::Urgent, now);
    }
}
