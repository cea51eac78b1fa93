//! Receives what others send to this node's address by the transport protocol (ISO 11783-3, 5.13.3):
//! allows portions, asks again for what was missed, and acknowledges.

use insd_base::{Span, Time};

use crate::transport::{MANAGEMENT, Management, Packet, SILENCE, Transfer};
use crate::{BusMessage, N2kId};

/// Transfers at once.
const MOST: usize = 4;
/// Packets of a portion.
const PORTION: u8 = 16;
/// After this long without a packet it is asked for again (T1 of ISO 11783-3).
const PACKET_SILENCE: Span = Span::from_nanos(750_000_000);
/// How often something is asked for again.
const ATTEMPTS: u8 = 3;
/// Why a transfer is given up.
const BUSY: u8 = 1;
const NO_RESOURCES: u8 = 2;
const TOO_SLOW: u8 = 3;

#[derive(Clone, Debug)]
struct Active {
    transfer: Transfer,
    /// The most packets that the sender wants to send at once.
    portion: u8,
    /// The last packet that it may send.
    last: u8,
    attempts: u8,
    /// When it was last asked for something.
    asked: Time,
}

/// What is to be answered, and to whom.
pub(crate) type Reply = (u8, Management);

/// All transfers to this node.
#[derive(Clone, Debug, Default)]
pub(crate) struct Reception(Vec<Active>);

impl Reception {
    /// Takes the contents of group 60416.
    pub(crate) fn manage(&mut self, id: N2kId, data: &[u8], now: Time) -> Option<Reply> {
        let reply = match Management::read(data)? {
            Management::Request { announced, portion } => {
                self.forget(id.source);
                let pgn = announced.pgn;
                match Transfer::begin(id, announced, now) {
                    None => Management::Abort { reason: NO_RESOURCES, pgn },
                    Some(_) if self.0.len() >= MOST => Management::Abort { reason: BUSY, pgn },
                    Some(transfer) => {
                        let portion = portion.clamp(1, PORTION);
                        let mut active =
                            Active { transfer, portion, last: 0, attempts: 0, asked: now };
                        let clear = active.ask(now);
                        self.0.push(active);
                        clear
                    }
                }
            }
            Management::Abort { .. } => {
                self.forget(id.source);
                return None;
            }
            _ => return None,
        };
        Some((id.source, reply))
    }

    fn forget(&mut self, source: u8) {
        self.0.retain(|active| active.transfer.source() != source);
    }

    /// Takes the contents of group 60160: what to answer, and the message if this was its end.
    pub(crate) fn take(
        &mut self,
        id: N2kId,
        data: &[u8],
        now: Time,
    ) -> (Option<Reply>, Option<BusMessage>) {
        let own = |active: &Active| active.transfer.source() == id.source;
        let Some(at) = self.0.iter().position(own) else { return (None, None) };
        let Some(active) = self.0.get_mut(at) else { return (None, None) };
        let at_end = data.first().is_some_and(|number| *number == active.last);
        let reply = |management| Some((id.source, management));
        match active.transfer.take(data, now) {
            Packet::Last => {
                let transfer = self.0.swap_remove(at).transfer;
                (reply(Management::End(transfer.announced)), Some(transfer.finish()))
            }
            Packet::Taken if active.transfer.received == active.last => {
                active.attempts = 0;
                (reply(active.ask(now)), None)
            }
            Packet::Gap if at_end => (reply(self.ask_again(at, now)), None),
            Packet::Taken | Packet::Repeated | Packet::Gap => (None, None),
        }
    }

    /// Asks again for what is missing, or gives up.
    fn ask_again(&mut self, at: usize, now: Time) -> Management {
        let Some(active) = self.0.get_mut(at) else {
            return Management::Abort { reason: TOO_SLOW, pgn: MANAGEMENT };
        };
        active.attempts += 1;
        if active.attempts <= ATTEMPTS {
            return active.ask(now);
        }
        let pgn = active.transfer.announced.pgn;
        self.0.swap_remove(at);
        Management::Abort { reason: TOO_SLOW, pgn }
    }

    /// Asks again one whose sender has fallen silent.
    pub(crate) fn wake(&mut self, now: Time) -> Option<Reply> {
        let late = |active: &Active| active.deadline() <= now;
        let at = self.0.iter().position(late)?;
        let source = self.0.get(at)?.transfer.source();
        Some((source, self.ask_again(at, now)))
    }

    /// When [`Reception::wake`] has something to do.
    pub(crate) fn wake_at(&self) -> Option<Time> {
        self.0.iter().map(Active::deadline).min()
    }

    /// Forgets all.
    pub(crate) fn clear(&mut self) {
        self.0.clear();
    }
}

impl Active {
    /// Allows the next packets.
    fn ask(&mut self, now: Time) -> Management {
        self.asked = now;
        let received = self.transfer.received;
        let announced = self.transfer.announced;
        let packets = self.portion.min(announced.packets - received);
        self.last = received + packets;
        Management::Clear { packets, next: received + 1, pgn: announced.pgn }
    }

    /// Until when the next packet must be here.
    fn deadline(&self) -> Time {
        (self.transfer.heard + PACKET_SILENCE).max(self.asked + SILENCE)
    }
}
