//! The 29-bit identifier: priority, parameter group, source and destination (ISO 11783-3, 5.2).

use insd_base::can::CanId;

/// The address of everybody.
pub const BROADCAST: u8 = 255;
/// The source of a node that has no address.
pub const NULL_ADDRESS: u8 = 254;

/// Parameter groups whose PDU format is below this are sent to one address.
const FIRST_BROADCAST_FORMAT: u32 = 240;

/// An identifier taken apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct N2kId {
    /// 0, the highest, to 7.
    pub priority: u8,
    /// Number of the parameter group, 18 bits.
    pub pgn: u32,
    /// Address of the sender.
    pub source: u8,
    /// Address of the receiver; [`BROADCAST`] for groups that are sent to everybody.
    pub destination: u8,
}

impl N2kId {
    /// The parts of an identifier; `None` if it is not one of 29 bits.
    #[must_use]
    pub fn parse(id: CanId) -> Option<Self> {
        let CanId::Extended(bits) = id else { return None };
        let [top, format, specific, source] = bits.to_be_bytes();
        let priority = top >> 2 & 7;
        let page = u32::from(top & 3) << 16;
        let format_bits = u32::from(format) << 8;
        let (pgn, destination) = if is_addressed(format_bits) {
            (page | format_bits, specific)
        } else {
            (page | format_bits | u32::from(specific), BROADCAST)
        };
        Some(N2kId { priority, pgn, source, destination })
    }

    /// The identifier. Priority and group are cut to their bits; the destination of a group that goes
    /// to everybody has no place in it.
    #[must_use]
    pub fn compose(&self) -> CanId {
        let pgn = self.pgn & 0x3_FFFF;
        let specific = if is_addressed(pgn) { u32::from(self.destination) } else { pgn & 0xFF };
        let group = pgn & 0x3_FF00 | specific;
        CanId::Extended(u32::from(self.priority & 7) << 26 | group << 8 | u32::from(self.source))
    }
}

/// Whether messages of the group have one receiver (which may be everybody).
#[must_use]
pub fn is_addressed(pgn: u32) -> bool {
    (pgn >> 8 & 0xFF) < FIRST_BROADCAST_FORMAT
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_identifier_is_taken_apart_and_put_together() {
        let claim = N2kId { priority: 6, pgn: 60928, source: 0x23, destination: BROADCAST };
        assert_eq!(claim.compose(), CanId::Extended(0x18EE_FF23));
        let heading = N2kId { priority: 2, pgn: 127_250, source: 1, destination: BROADCAST };
        assert_eq!(heading.compose(), CanId::Extended(0x09F1_1201));
        for id in [claim, heading] {
            assert_eq!(N2kId::parse(id.compose()), Some(id));
        }
        assert_eq!(N2kId::parse(CanId::Standard(0x123)), None);
    }
}
