//! What must hold for whatever stands on a bus, and for any lines of text. The replay of seeds and the
//! fuzz targets share it.
//!
//! The first byte of a storm chooses what the node is. Then come doings, each of three bytes and what
//! the third says:
//!
//! ```text
//! 1   modulo 16: 0 to 2 a frame: four bytes of identifier, data
//!     3 a message: group, source, destination and priority, data; 4 and 5 the same, but frames of it are
//!     left out, sent twice or exchanged, as one byte more before the group says
//!     6 a message to the node and 7 one to everybody by the transport protocol
//!     8 a group function: function, group, source, contents; 9 a request: group, source, destination
//!     10 a claim: source, NAME; 11 claims of as many nodes as the first byte says from an address on
//!     12 a claim of the node's own address by the NAME before or behind its own, or by its own
//!     13 the node is given a message: group, contents; 14 what its link does with the next frames
//!     15 the bus goes, comes, is off or starts again, or the node sleeps
//! 2   time since the doing before: 0 to 63 times 0.1 ms, 10 ms, or s, or a power of two of seconds
//! 3   bytes of the contents
//! ```

#![allow(clippy::unwrap_used, clippy::panic, dead_code)] // helpers of tests are not seen as tests

#[path = "../common/mod.rs"]
mod common;
mod heard;
mod leaving;
pub(crate) mod lines;
mod storm;

pub(crate) use storm::everything;
