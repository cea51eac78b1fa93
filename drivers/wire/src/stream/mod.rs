//! Cuts a stream of bytes into frames, whatever the chunks they come in.
//!
//! One [`Cutter`] serves a port, on which several protocols may be mixed (UBX among NMEA, say). A
//! format says by its `look` what stands at the start of some bytes; the answer may depend on nothing
//! but those bytes, and what it says of a beginning it must say of every longer one, apart from
//! [`Look::More`]. That is why the same bytes give the same frames in any splitting.

mod cutter;
mod protocol;

pub use cutter::{Cut, Cutter};
pub use protocol::Protocol;

/// What stands at the start of some bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Look {
    /// No frame begins here.
    Nothing,
    /// Perhaps a frame; it cannot be told before there are this many bytes in all.
    More(usize),
    /// A frame of this many bytes, its checksum (where the format has one) verified.
    Frame(usize),
    /// A frame by its shape, but not by its checksum. The search goes on at the next byte, as what
    /// looked like a header may have been noise before a good frame.
    Damaged,
    /// So many bytes that belong to the format and carry nothing: padding, line ends.
    Filler(usize),
}
