//! Why bytes are not a sentence.

use std::fmt;

/// Why a reader refused a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NmeaFault {
    /// The line does not begin with `$` or `!`.
    NoStart,
    /// A byte that is not printable ASCII, at this offset.
    IllegalByte {
        /// Offset in the line.
        at: usize,
    },
    /// A TAG block before the sentence that is not closed, or whose checksum is missing or wrong.
    TagBlock,
    /// No `*hh` at the end.
    NoChecksum,
    /// The checksum is not that of the bytes.
    WrongChecksum {
        /// What the line says.
        stated: u8,
        /// What its bytes give.
        computed: u8,
    },
    /// The address is not two letters of a talker and three of a formatter.
    Address,
    /// Another sentence than the reader's own.
    OtherSentence,
    /// The line ends before this field, counted from 1 after the address.
    Missing {
        /// Number of the field.
        field: u8,
    },
    /// This field, counted from 1 after the address, does not have its form or range.
    Malformed {
        /// Number of the field.
        field: u8,
    },
}

impl fmt::Display for NmeaFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NmeaFault::NoStart => f.write_str("no $ or ! at the start"),
            NmeaFault::IllegalByte { at } => write!(f, "byte {at} is not printable ASCII"),
            NmeaFault::TagBlock => f.write_str("the TAG block is damaged"),
            NmeaFault::NoChecksum => f.write_str("no checksum"),
            NmeaFault::WrongChecksum { stated, computed } => {
                write!(f, "checksum {stated:02X} stated, {computed:02X} computed")
            }
            NmeaFault::Address => f.write_str("not an approved address"),
            NmeaFault::OtherSentence => f.write_str("another sentence than expected"),
            NmeaFault::Missing { field } => write!(f, "field {field} is missing"),
            NmeaFault::Malformed { field } => write!(f, "field {field} is malformed"),
        }
    }
}

impl std::error::Error for NmeaFault {}
