//! The transport protocol of ISO 11783-3, 5.13: messages of up to 1785 bytes in numbered packets.
//!
//! A transfer to everybody is announced (BAM) and then sent; a transfer to one address is offered
//! (RTS), sent in the portions that the receiver allows (CTS) and acknowledged at its end. Management
//! goes by group 60416, packets of seven bytes by group 60160.

use insd_base::{Span, Time};

use crate::bytes::{Bytes, pgn_bytes};
use crate::{BusMessage, N2kId};

/// Group of the management of transfers.
pub(crate) const MANAGEMENT: u32 = 60_416;
/// Group of their packets.
pub(crate) const PACKET: u32 = 60_160;
/// Bytes of the message in a packet.
const PACKET_BYTES: usize = 7;
/// The longest silence within a transfer (T2 and T3 of ISO 11783-3).
pub(crate) const SILENCE: Span = Span::from_nanos(1_250_000_000);

/// What is announced: a message of this group and length.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Announcement {
    /// The group of the message.
    pub(crate) pgn: u32,
    /// Its length, bytes.
    pub(crate) length: u16,
    /// The number of its packets.
    pub(crate) packets: u8,
}

/// Contents of group 60416.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Management {
    /// RTS: a message for one address is ready.
    Request {
        /// The message.
        announced: Announcement,
        /// The sender wants to send no more packets than these for one [`Management::Clear`].
        portion: u8,
    },
    /// CTS: the receiver wants these packets; none means: wait.
    Clear {
        /// How many.
        packets: u8,
        /// Number of the first, from 1.
        next: u8,
        /// The group of the message.
        pgn: u32,
    },
    /// The receiver has all of it.
    End(Announcement),
    /// BAM: a message for everybody follows.
    Announce(Announcement),
    /// One of both gives up.
    Abort {
        /// 1 busy, 2 no resources, 3 too slow.
        reason: u8,
        /// The group of the message.
        pgn: u32,
    },
}

impl Management {
    /// Reads the contents; `None` if they are too short, or of no known kind.
    pub(crate) fn read(data: &[u8]) -> Option<Self> {
        let mut bytes = Bytes(data);
        let (kind, length) = (bytes.byte()?, bytes.word()?);
        let (packets, portion, pgn) = (bytes.byte()?, bytes.byte()?, bytes.pgn()?);
        let announced = Announcement { pgn, length, packets };
        let [first, second] = length.to_le_bytes();
        match kind {
            16 => Some(Management::Request { announced, portion }),
            17 => Some(Management::Clear { packets: first, next: second, pgn }),
            19 => Some(Management::End(announced)),
            32 => Some(Management::Announce(announced)),
            255 => Some(Management::Abort { reason: first, pgn }),
            _ => None,
        }
    }

    /// The contents.
    pub(crate) fn write(&self) -> [u8; 8] {
        let of = |kind, announced: Announcement, last| {
            let [low, high] = announced.length.to_le_bytes();
            (kind, low, high, announced.packets, last, announced.pgn)
        };
        let (kind, first, second, third, fourth, pgn) = match *self {
            Management::Request { announced, portion } => of(16, announced, portion),
            Management::Clear { packets, next, pgn } => (17, packets, next, 255, 255, pgn),
            Management::End(announced) => of(19, announced, 255),
            Management::Announce(announced) => of(32, announced, 255),
            Management::Abort { reason, pgn } => (255, reason, 255, 255, 255, pgn),
        };
        let [low, middle, high] = pgn_bytes(pgn);
        [kind, first, second, third, fourth, low, middle, high]
    }
}

/// A message under way.
#[derive(Clone, Debug)]
pub(crate) struct Transfer {
    id: N2kId,
    pub(crate) announced: Announcement,
    /// When it was announced.
    pub(crate) begun: Time,
    /// When something of it was last heard.
    pub(crate) heard: Time,
    data: Vec<u8>,
    /// Packets there are.
    pub(crate) received: u8,
}

/// What a packet did to a transfer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Packet {
    /// It was the next.
    Taken,
    /// It was the last.
    Last,
    /// It had been there before.
    Repeated,
    /// Some before it are missing, or it is too short.
    Gap,
}

impl Transfer {
    /// A transfer as announced by a message of management; `None` if the length and the number of
    /// packets contradict each other.
    pub(crate) fn begin(id: N2kId, announced: Announcement, now: Time) -> Option<Self> {
        let fits = announced.length > 0
            && usize::from(announced.length).div_ceil(PACKET_BYTES)
                == usize::from(announced.packets);
        fits.then(|| Transfer {
            id,
            announced,
            begun: now,
            heard: now,
            data: Vec::new(),
            received: 0,
        })
    }

    /// Whether the packets of this identifier belong to it.
    pub(crate) fn is_between(&self, source: u8, destination: u8) -> bool {
        self.id.source == source && self.id.destination == destination
    }

    /// The source.
    pub(crate) fn source(&self) -> u8 {
        self.id.source
    }

    /// Takes the contents of group 60160.
    pub(crate) fn take(&mut self, contents: &[u8], now: Time) -> Packet {
        self.heard = now;
        let Some((number, bytes)) = contents.split_first() else { return Packet::Gap };
        if *number <= self.received {
            return Packet::Repeated;
        }
        let missing = usize::from(self.announced.length).saturating_sub(self.data.len());
        let wanted = missing.min(PACKET_BYTES);
        let Some(bytes) = bytes.get(..wanted).filter(|_| *number == self.received + 1) else {
            return Packet::Gap;
        };
        self.data.extend_from_slice(bytes);
        self.received += 1;
        if self.received == self.announced.packets { Packet::Last } else { Packet::Taken }
    }

    /// The message, when all of it is there.
    pub(crate) fn finish(self) -> BusMessage {
        BusMessage {
            priority: self.id.priority,
            pgn: self.announced.pgn,
            source: self.id.source,
            destination: self.id.destination,
            data: self.data,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From canboat, analyzer/tests/iso-tp-test.in: 219 bytes of group 129540 in 32 packets.
    const ANNOUNCED: [u8; 8] = [0x20, 0xDB, 0x00, 0x20, 0xFF, 0x04, 0xFA, 0x01];

    #[test]
    fn an_announcement_from_a_bus_is_read_and_written() {
        let announced = Announcement { pgn: 129_540, length: 219, packets: 32 };
        assert_eq!(Management::read(&ANNOUNCED), Some(Management::Announce(announced)));
        assert_eq!(Management::Announce(announced).write(), ANNOUNCED);
    }

    #[test]
    fn all_kinds_survive_the_round_trip() {
        let announced = Announcement { pgn: 65_240, length: 9, packets: 2 };
        for management in [
            Management::Request { announced, portion: 2 },
            Management::Clear { packets: 2, next: 1, pgn: 65_240 },
            Management::End(announced),
            Management::Announce(announced),
            Management::Abort { reason: 3, pgn: 65_240 },
        ] {
            assert_eq!(Management::read(&management.write()), Some(management));
        }
        assert_eq!(Management::read(&[18, 0, 0, 0, 0, 0, 0, 0]), None);
        assert_eq!(Management::read(&[16, 9, 0]), None);
    }
}
