//! The vocabulary of a CAN bus: classic frames (ISO 11898-1), and what a controller says of its bus.

use std::fmt;

/// The identifier of a frame. Lower identifiers win the bus.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum CanId {
    /// 11 bits.
    Standard(u16),
    /// 29 bits.
    Extended(u32),
}

impl CanId {
    /// Largest identifier of 11 bits.
    pub const MAX_STANDARD: u16 = 0x7FF;
    /// Largest identifier of 29 bits.
    pub const MAX_EXTENDED: u32 = 0x1FFF_FFFF;

    /// Whether the number has no more bits than its kind allows.
    #[must_use]
    pub fn is_valid(self) -> bool {
        match self {
            CanId::Standard(id) => id <= Self::MAX_STANDARD,
            CanId::Extended(id) => id <= Self::MAX_EXTENDED,
        }
    }
}

/// As candump writes it: three hexadecimal digits, or eight.
impl fmt::Display for CanId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            CanId::Standard(id) => write!(f, "{id:03X}"),
            CanId::Extended(id) => write!(f, "{id:08X}"),
        }
    }
}

/// A data frame of up to eight bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct CanFrame {
    id: CanId,
    length: u8,
    data: [u8; 8],
}

impl CanFrame {
    /// A frame; `None` if the identifier or the data are too long.
    #[must_use]
    pub fn new(id: CanId, data: &[u8]) -> Option<Self> {
        let mut bytes = [0; 8];
        bytes.get_mut(..data.len())?.copy_from_slice(data);
        let length = u8::try_from(data.len()).ok()?;
        id.is_valid().then_some(CanFrame { id, length, data: bytes })
    }

    /// Its identifier.
    #[must_use]
    pub fn id(&self) -> CanId {
        self.id
    }

    /// Its data, up to eight bytes.
    #[must_use]
    pub fn data(&self) -> &[u8] {
        self.data.get(..usize::from(self.length)).unwrap_or(&self.data)
    }
}

impl CanFrame {
    /// Bits that the frame takes on the wire, with its stuffing and the gap of three after it (ISO
    /// 11898-1, 10.4 and 10.5).
    #[must_use]
    pub fn wire_bits(&self) -> u32 {
        let mut stuffed = Stuffed::default();
        stuffed.push(0, 1);
        match self.id {
            // identifier, no remote request, identifier format, reserved
            CanId::Standard(id) => stuffed.push(u32::from(id) << 3, 14),
            // base identifier, two recessive bits, the rest, no remote request, two reserved
            CanId::Extended(id) => {
                stuffed.push(id >> 18, 11);
                stuffed.push(0b11, 2);
                stuffed.push(id & 0x3_FFFF, 18);
                stuffed.push(0, 3);
            }
        }
        stuffed.push(u32::from(self.length), 4);
        for byte in self.data() {
            stuffed.push(u32::from(*byte), 8);
        }
        stuffed.push(u32::from(stuffed.checksum), 15);
        // delimiter of the checksum, acknowledgement and its delimiter, end of frame, gap
        stuffed.count + 1 + 2 + 7 + 3
    }
}

/// Counts bits with those that are stuffed in: one of the other kind after five that are equal.
#[derive(Clone, Copy, Debug, Default)]
struct Stuffed {
    count: u32,
    checksum: u16,
    last: Option<bool>,
    equal: u32,
}

impl Stuffed {
    /// Takes the lowest `width` bits of a number, the highest first.
    fn push(&mut self, bits: u32, width: u32) {
        for at in (0..width).rev() {
            let bit = bits >> at & 1 == 1;
            let feedback = bit != (self.checksum >> 14 & 1 == 1);
            self.checksum = self.checksum << 1 & 0x7FFF ^ if feedback { 0x4599 } else { 0 };
            self.equal = if self.last == Some(bit) { self.equal + 1 } else { 1 };
            self.count += 1;
            self.last = Some(bit);
            if self.equal == 5 {
                self.count += 1;
                self.last = Some(!bit);
                self.equal = 1;
            }
        }
    }
}

/// What a controller says of its bus.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BusEvent {
    /// Errors are few again.
    Active,
    /// A counter of errors has passed 96.
    Warning,
    /// A counter of errors has passed 127: the controller no longer disturbs others.
    Passive,
    /// Too many errors: the controller has left the bus, and nothing is sent or heard.
    BusOff,
    /// The controller is back on the bus after it was off.
    Restarted,
    /// An error on the wire, by the bits of the kernel's class of errors (`linux/can/error.h`).
    Error {
        /// Bits of the class.
        class: u32,
    },
    /// The kernel dropped received frames because they were not fetched soon enough.
    Dropped {
        /// How many since the last such report.
        frames: u32,
    },
}

impl fmt::Display for BusEvent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            BusEvent::Active => f.write_str("few errors again"),
            BusEvent::Warning => f.write_str("many errors"),
            BusEvent::Passive => f.write_str("error passive"),
            BusEvent::BusOff => f.write_str("bus off"),
            BusEvent::Restarted => f.write_str("on the bus again"),
            BusEvent::Error { class } => write!(f, "error of class 0x{class:X}"),
            BusEvent::Dropped { frames } => write!(f, "{frames} frames dropped"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_holds_up_to_eight_bytes_under_a_valid_identifier() {
        let frame = CanFrame::new(CanId::Extended(0x18EE_FF01), &[1, 2, 3]).unwrap();
        assert_eq!((frame.data(), frame.id().to_string().as_str()), (&[1, 2, 3][..], "18EEFF01"));
        assert_eq!(CanFrame::new(CanId::Standard(0x800), &[]), None);
        assert_eq!(CanFrame::new(CanId::Extended(1 << 29), &[]), None);
        assert_eq!(CanFrame::new(CanId::Standard(1), &[0; 9]), None);
    }

    #[test]
    fn a_frame_takes_its_bits_and_those_stuffed_in() {
        // without stuffing 47 + 8 n bits with an identifier of 11 bits, 67 + 8 n with one of 29
        let bits = |id, data: &[u8]| CanFrame::new(id, data).unwrap().wire_bits();
        let plain = bits(CanId::Extended(0x0AAA_AAAA), &[0x55; 8]);
        assert!((131..=137).contains(&plain), "{plain}");
        // 34 zeros, and a one after each five of them
        assert_eq!(bits(CanId::Standard(0), &[]), 47 + 6);
        for data in [[0; 8], [0xFF; 8]] {
            let most = bits(CanId::Extended(0), &data);
            assert!((140..=160).contains(&most), "{most}");
        }
    }
}
