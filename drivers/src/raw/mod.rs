//! Raw recordings: all that reached the computer, on all ports, in the order in which it was dealt
//! with. `docs/recording.md` describes the format byte by byte.
//!
//! [`Recorder`] writes on a thread of its own, [`RawWriter`] where it is called; [`RawReader`] gives
//! back the very same arrivals, to the nanosecond and the byte.
//!
//! - A power cut costs the last second ([`FLUSH_EVERY`]), damage costs the blocks that it touches.
//!   Both are told with their place, and so is everything that could not be recorded.
//! - No bytes make the reader panic, and none make it take memory without bound.
//! - Nothing here reads a clock: rotation and flushing go by the stamps of the arrivals and by the
//!   time that the caller tells.

mod block;
mod disk;
mod error;
mod fault;
mod file;
mod header;
mod layout;
mod names;
mod reader;
mod record;
mod recorder;
mod varint;
mod window;
mod writer;

#[cfg(test)]
mod tests;

pub use error::RawWriteError;
pub use fault::RawFault;
pub use header::FileHeader;
pub use names::EXTENSION;
pub use reader::{RawRead, RawReader};
pub use recorder::{Recorder, RecorderState};
pub use writer::{FLUSH_EVERY, RawHeader, RawWriter, RawWritten, RecordingConfig};
