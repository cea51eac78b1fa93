//! The protocols that a port can speak.

use super::Look;
use crate::nmea;

/// A way of framing bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Protocol {
    /// NMEA 0183 lines, bare or in IEC 61162-450 datagrams.
    Nmea,
}

impl Protocol {
    /// All of them, in the order in which they are asked.
    pub const ALL: [Protocol; 1] = [Protocol::Nmea];

    /// Its short name, as in configurations and tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Protocol::Nmea => "nmea",
        }
    }

    /// What stands at the start of some bytes, at least one.
    #[must_use]
    pub fn look(self, bytes: &[u8]) -> Look {
        match self {
            Protocol::Nmea => nmea::look(bytes),
        }
    }

    /// Whether a frame or filler of this protocol can begin with a byte. May say yes too often.
    pub(crate) fn may_start(self, byte: u8) -> bool {
        self.look(&[byte]) != Look::Nothing
    }
}
