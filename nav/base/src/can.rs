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
}
