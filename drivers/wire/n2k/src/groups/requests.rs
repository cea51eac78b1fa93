//! Requests and answers of ISO 11783-3, lists of groups, and the commanded address of ISO 11783-5.

use insd_base::Span;

use crate::bytes::{Bytes, pgn_bytes};
use crate::pgn::{Group, Short};
use crate::{BROADCAST, Name};

/// The error of contents with too few bytes.
pub(crate) fn short(data: &[u8], least: usize) -> Short {
    Short { length: data.len(), least }
}

/// 59904 ISO request: send this group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct IsoRequest {
    /// The group that is wanted.
    pub pgn: u32,
}

impl Group for IsoRequest {
    const PGN: u32 = 59_904;
    const PRIORITY: u8 = 6;
    const INTERVAL: Option<Span> = None;

    fn read(data: &[u8]) -> Result<Self, Short> {
        let pgn = Bytes(data).pgn().ok_or_else(|| short(data, 3))?;
        Ok(IsoRequest { pgn })
    }

    fn write(&self) -> Vec<u8> {
        pgn_bytes(self.pgn).to_vec()
    }
}

/// What an ISO acknowledgement says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Control {
    /// Yes.
    Positive,
    /// No: there is no such group here.
    Negative,
    /// No: you may not.
    Denied,
    /// Not now; ask again later.
    Busy,
    /// Something else.
    Other(u8),
}

/// 59392 ISO acknowledgement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct IsoAcknowledgement {
    /// Yes or no.
    pub control: Control,
    /// The group that was asked for.
    pub pgn: u32,
}

impl Group for IsoAcknowledgement {
    const PGN: u32 = 59_392;
    const PRIORITY: u8 = 6;
    const INTERVAL: Option<Span> = None;

    fn read(data: &[u8]) -> Result<Self, Short> {
        let mut bytes = Bytes(data);
        let parts = (bytes.byte(), bytes.take(4), bytes.pgn());
        let (Some(code), Some(_), Some(pgn)) = parts else { return Err(short(data, 8)) };
        let control = match code {
            0 => Control::Positive,
            1 => Control::Negative,
            2 => Control::Denied,
            3 => Control::Busy,
            other => Control::Other(other),
        };
        Ok(IsoAcknowledgement { control, pgn })
    }

    fn write(&self) -> Vec<u8> {
        let code = match self.control {
            Control::Positive => 0,
            Control::Negative => 1,
            Control::Denied => 2,
            Control::Busy => 3,
            Control::Other(code) => code,
        };
        let [low, middle, high] = pgn_bytes(self.pgn);
        vec![code, 255, 255, 255, 255, low, middle, high]
    }
}

/// 126464 List of groups.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PgnList {
    /// Groups that the node sends.
    Transmit(Vec<u32>),
    /// Groups that it reads.
    Receive(Vec<u32>),
    /// A list of another kind.
    Other(u8),
}

/// Groups in a list that fits in a fast packet.
const LONGEST_LIST: usize = 74;

impl Group for PgnList {
    const PGN: u32 = 126_464;
    const PRIORITY: u8 = 6;
    const INTERVAL: Option<Span> = None;

    fn read(data: &[u8]) -> Result<Self, Short> {
        let mut bytes = Bytes(data);
        let kind = bytes.byte().ok_or_else(|| short(data, 1))?;
        let groups: Vec<u32> = std::iter::from_fn(|| bytes.pgn()).collect();
        Ok(match kind {
            0 => PgnList::Transmit(groups),
            1 => PgnList::Receive(groups),
            other => PgnList::Other(other),
        })
    }

    /// Groups beyond the 74th do not fit in a message.
    fn write(&self) -> Vec<u8> {
        let (kind, groups) = match self {
            PgnList::Transmit(groups) => (0, groups.as_slice()),
            PgnList::Receive(groups) => (1, groups.as_slice()),
            PgnList::Other(kind) => (*kind, [].as_slice()),
        };
        let list = groups.iter().take(LONGEST_LIST).flat_map(|pgn| pgn_bytes(*pgn));
        std::iter::once(kind).chain(list).collect()
    }
}

/// 65240 Commanded address: the node of this NAME shall take this address. Sent by the transport
/// protocol.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CommandedAddress {
    /// Who.
    pub name: Name,
    /// Which address.
    pub address: u8,
}

impl Group for CommandedAddress {
    const PGN: u32 = 65_240;
    const PRIORITY: u8 = 6;
    const INTERVAL: Option<Span> = None;

    fn read(data: &[u8]) -> Result<Self, Short> {
        let mut bytes = Bytes(data);
        let parts = (bytes.number(8), bytes.byte());
        let (Some(name), Some(address)) = parts else { return Err(short(data, 9)) };
        Ok(CommandedAddress { name: Name::new(name), address })
    }

    fn write(&self) -> Vec<u8> {
        let mut data = self.name.bytes().to_vec();
        data.push(self.address);
        data
    }
}

/// The address of an answer to one who may have none: everybody.
pub(crate) fn answer_to(source: u8) -> u8 {
    if source <= crate::LAST_ADDRESS { source } else { BROADCAST }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn acknowledgements_and_requests_of_a_real_bus_are_read_and_written() {
        // canboat's sample dirona-actisense-serial.raw
        let request = [0x16, 0xF0, 0x01];
        assert_eq!(IsoRequest::read(&request), Ok(IsoRequest { pgn: 126_998 }));
        assert_eq!(IsoRequest { pgn: 126_998 }.write(), request);
        let refusal = [0x01, 0xFF, 0xFF, 0xFF, 0xFF, 0x16, 0xF0, 0x01];
        let read = IsoAcknowledgement::read(&refusal).unwrap();
        assert_eq!((read.control, read.pgn), (Control::Negative, 126_998));
        assert_eq!(read.write(), refusal);
    }

    #[test]
    fn lists_and_commands_survive_the_round_trip() {
        for list in [PgnList::Transmit(vec![126_992, 127_250]), PgnList::Receive(Vec::new())] {
            assert_eq!(PgnList::read(&list.write()), Ok(list));
        }
        assert_eq!(PgnList::Transmit(vec![127_250; 100]).write().len(), 223);
        let command = CommandedAddress { name: Name::new(0xC03C_8C02_1139_F215), address: 33 };
        assert_eq!(command.write().len(), 9);
        assert_eq!(CommandedAddress::read(&command.write()), Ok(command));
    }

    #[test]
    fn contents_too_short_are_an_error() {
        assert_eq!(IsoRequest::read(&[1, 2]), Err(Short { length: 2, least: 3 }));
        assert_eq!(IsoAcknowledgement::read(&[1; 7]), Err(Short { length: 7, least: 8 }));
        assert_eq!(CommandedAddress::read(&[1; 8]), Err(Short { length: 8, least: 9 }));
        assert_eq!(PgnList::read(&[]), Err(Short { length: 0, least: 1 }));
    }
}
