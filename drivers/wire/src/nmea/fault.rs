//! Why bytes are not a sentence.

use std::fmt;

/// Why a reader refused a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
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

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Fault::NoStart => f.write_str("no $ or ! at the start"),
            Fault::IllegalByte { at } => write!(f, "byte {at} is not printable ASCII"),
            Fault::TagBlock => f.write_str("the TAG block is damaged"),
            Fault::NoChecksum => f.write_str("no checksum"),
            Fault::WrongChecksum { stated, computed } => {
                write!(f, "checksum {stated:02X} stated, {computed:02X} computed")
            }
            Fault::Address => f.write_str("not an approved address"),
            Fault::OtherSentence => f.write_str("another sentence than expected"),
            Fault::Missing { field } => write!(f, "field {field} is missing"),
            Fault::Malformed { field } => write!(f, "field {field} is malformed"),
        }
    }
}

impl std::error::Error for Fault {}
