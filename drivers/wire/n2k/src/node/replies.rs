//! What a node does with messages of network management, and what it answers.

use insd_base::{Span, Time};

use super::answers::Answer;
use super::queue::Kind;
use super::reception::Reply;
use super::{Node, NodeEvent, Peer};
use crate::groups::{
    CommandedAddress, Configuration, Control, GroupFunction, Heartbeat, IsoAcknowledgement,
    IsoRequest, PgnList, ProductInfo,
};
use crate::pgn::Group;
use crate::roster::claimed;
use crate::transport::MANAGEMENT;
use crate::{ADDRESS_CLAIM, BROADCAST, BusMessage, LAST_ADDRESS};

/// Groups of network management that a node sends.
const OWN_SENT: [u32; 9] = [
    IsoAcknowledgement::PGN,
    IsoRequest::PGN,
    ADDRESS_CLAIM,
    GroupFunction::PGN,
    PgnList::PGN,
    Heartbeat::PGN,
    ProductInfo::PGN,
    Configuration::PGN,
    MANAGEMENT,
];
/// Groups of network management that a node reads.
const OWN_READ: [u32; 7] = [
    IsoAcknowledgement::PGN,
    IsoRequest::PGN,
    crate::transport::PACKET,
    MANAGEMENT,
    ADDRESS_CLAIM,
    CommandedAddress::PGN,
    GroupFunction::PGN,
];

impl Node {
    /// Reacts to a message.
    pub(super) fn receive(&mut self, message: &BusMessage, now: Time) {
        if message.pgn == ADDRESS_CLAIM {
            self.hear_claim(message, now);
            return;
        }
        let claimed = self.claim.source().filter(|address| *address <= LAST_ADDRESS);
        let addressed = claimed == Some(message.destination);
        if !addressed && message.destination != BROADCAST {
            return;
        }
        match message.pgn {
            IsoRequest::PGN => {
                if let Ok(request) = IsoRequest::read(&message.data) {
                    self.answer(request.pgn, message.source, addressed, now);
                }
            }
            IsoAcknowledgement::PGN => {
                let read = IsoAcknowledgement::read(&message.data);
                let refused = read.is_ok_and(|answer| answer.control != Control::Positive);
                self.requests.refused += u64::from(addressed && refused);
            }
            CommandedAddress::PGN => {
                if let Ok(command) = CommandedAddress::read(&message.data) {
                    self.obey(command, message.source, now);
                }
            }
            GroupFunction::PGN if self.address().is_some() => {
                if let Ok(function) = GroupFunction::read(&message.data) {
                    self.function(&function, message.source, addressed, now);
                }
            }
            _ => {}
        }
    }

    fn hear_claim(&mut self, message: &BusMessage, now: Time) {
        let Some(name) = claimed(message) else { return };
        self.roster.learn(message);
        self.claim.hear(message.source, name, &self.roster, &mut self.random, now);
        self.run_steps(now);
    }

    fn obey(&mut self, command: CommandedAddress, source: u8, now: Time) {
        let new = self.claim.source() != Some(command.address);
        if command.name != self.config.name || command.address > LAST_ADDRESS || !new {
            return;
        }
        self.requests.commanded += 1;
        let by = self.peer(source);
        if !self.config.commands {
            return self.tell(NodeEvent::CommandRefused { pgn: CommandedAddress::PGN, by });
        }
        self.tell(NodeEvent::Commanded { address: command.address, by });
        self.claim.command(command.address, now);
        self.run_steps(now);
    }

    /// Answers an ISO request.
    fn answer(&mut self, pgn: u32, source: u8, addressed: bool, now: Time) {
        self.requests.requests += 1;
        let to = crate::groups::answer_to(source);
        let held = self.address().is_some();
        match pgn {
            ADDRESS_CLAIM => self.owe_claim(now),
            _ if !held => {}
            PgnList::PGN => {
                self.owe(Answer::Sends(to), now);
                self.owe(Answer::Reads(to), now);
            }
            ProductInfo::PGN => self.owe(Answer::Product, now),
            Configuration::PGN => self.owe(Answer::Configuration, now),
            Heartbeat::PGN => self.owe(Answer::Heartbeat, now),
            pgn if self.is_live(pgn, now) => self.owe(Answer::Stream(pgn), now),
            pgn if addressed => {
                let known = self.entry(pgn).is_some_and(|entry| entry.enabled);
                let control = if known { Control::Busy } else { Control::Negative };
                self.refuse(IsoAcknowledgement { control, pgn }, to, now);
            }
            _ => {}
        }
    }

    /// Owes the claim. Who could not claim says so after a random delay.
    pub(super) fn owe_claim(&mut self, now: Time) {
        let has_one = self.claim.source().is_some_and(|source| source <= LAST_ADDRESS);
        let delay = if has_one { Span::ZERO } else { self.random.delay() };
        self.owe(Answer::Claim, now + delay);
    }

    pub(super) fn owe(&mut self, answer: Answer, from: Time) {
        self.requests.joined += u64::from(self.answers.owe(answer, from));
    }

    /// Whether the last contents of a group are young enough to be sent once more.
    pub(super) fn is_live(&self, pgn: u32, now: Time) -> bool {
        let entry = self.entry(pgn).filter(|entry| entry.enabled);
        let age = self.last.get(&pgn).map(|(time, _)| now - *time);
        entry.zip(age).is_some_and(|(entry, age)| age <= entry.interval)
    }

    /// Gives an answer that is due.
    pub(super) fn give(&mut self, answer: Answer, now: Time) {
        if let Answer::Sends(_) | Answer::Reads(_) = answer
            && !self.courtesy.take(now)
        {
            self.answers.owe(answer, self.courtesy.next(now));
            return;
        }
        self.requests.answers += 1;
        match answer {
            Answer::Claim => {
                if let Some(source) = self.claim.source() {
                    self.send_claim(source, now);
                }
            }
            Answer::Heartbeat => {
                let beat = self.pulse.beat();
                self.reply(&beat, BROADCAST, now);
            }
            Answer::Product => {
                let product = self.config.product.clone();
                self.reply(&product, BROADCAST, now);
            }
            Answer::Configuration => self.reply(&self.config.configuration(), BROADCAST, now),
            Answer::Sends(to) => self.reply(&PgnList::Transmit(self.sent_groups()), to, now),
            Answer::Reads(to) => self.reply(&PgnList::Receive(self.read_groups()), to, now),
            Answer::Stream(pgn) => self.repeat(pgn, now),
        }
    }

    /// Sends the last contents of a group once more.
    fn repeat(&mut self, pgn: u32, now: Time) {
        let priority = self.entry(pgn).map(|entry| entry.priority);
        let data = self.last.get(&pgn).map(|(_, data)| data.clone());
        let (Some(priority), Some(data), Some(source)) = (priority, data, self.address()) else {
            return;
        };
        let message = BusMessage { priority, pgn, source, destination: BROADCAST, data };
        self.queue.push(message, Kind::Reply, now);
    }

    fn sent_groups(&self) -> Vec<u32> {
        let stream = self.config.transmit.iter().filter(|entry| entry.enabled);
        OWN_SENT.into_iter().chain(stream.map(|entry| entry.pgn)).collect()
    }

    fn read_groups(&self) -> Vec<u32> {
        OWN_READ.into_iter().chain(self.config.receive.iter().copied()).collect()
    }

    /// Refuses a request, unless there are too many.
    fn refuse(&mut self, refusal: IsoAcknowledgement, to: u8, now: Time) {
        if self.courtesy.take(now) {
            self.requests.refusals += 1;
            self.reply(&refusal, to, now);
        } else {
            self.requests.rationed += 1;
        }
    }

    /// Queues an answer.
    pub(super) fn reply<G: Group>(&mut self, group: &G, destination: u8, now: Time) {
        let Some(source) = self.address() else { return };
        let (priority, pgn, data) = (G::PRIORITY, G::PGN, group.write());
        let message = BusMessage { priority, pgn, source, destination, data };
        self.queue.push(message, Kind::Reply, now);
    }

    /// Queues the management of a transfer.
    pub(super) fn manage(&mut self, reply: Option<Reply>, now: Time) {
        if let Some(source) = self.address() {
            self.manage_from(source, reply, now);
        }
    }

    pub(super) fn manage_from(&mut self, source: u8, reply: Option<Reply>, now: Time) {
        let Some((destination, management)) = reply else { return };
        let data = management.write().to_vec();
        let message = BusMessage { priority: 6, pgn: MANAGEMENT, source, destination, data };
        self.queue.push(message, Kind::Reply, now);
    }

    pub(super) fn peer(&self, address: u8) -> Peer {
        Peer { address, name: self.roster.name_at(address) }
    }
}
