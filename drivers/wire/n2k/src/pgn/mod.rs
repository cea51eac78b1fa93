//! Parameter groups of navigation, each as one table of its fields (`table.rs`), from which its struct,
//! reader, writer and documentation follow.
//!
//! Facts of layout: canboat.json 8 (Apache-2.0) and the field table of NMEA in canboat's
//! `nmea_1300.json` (version 1.300 of 2009; it has all groups but 127252). A bit's number in the tables
//! counts from the least significant bit of the first byte.
//!
//! A number outside of the range that the standard gives its field (an angle of more than a turn, a
//! latitude beyond a pole, a time past the end of the day) is read as unknown, like "not available".

mod attitude;
mod bits;
mod gnss;
mod kinds;
mod known;
mod names;
mod position;
mod speed;
mod table;
mod time;

pub use attitude::{
    Attitude, Heading, Heave, MagneticVariation, North, RateOfTurn, VariationSource,
};
pub use gnss::{
    Dops, FixMethod, FixMode, GnssPosition, GnssSystem, Integrity, PseudorangeNoise, Station,
};
pub use known::Known;
pub use names::name;
pub use position::{CourseSpeed, PositionRapid};
pub use speed::{Direction, DistanceLog, SetDrift, Speed, SpeedComponents, SpeedKind};
pub use table::Row;
pub use time::{SystemTime, TimeDate, TimeSource, days_and_seconds, utc};

use insd_base::Span;

/// Links the messages of one epoch: 0 to 252; `None` if they are not linked.
pub type Sid = Option<u8>;

/// A parameter group that can be read and written.
pub trait Group: Sized {
    /// Its number.
    const PGN: u32;
    /// Its priority where nothing else is said.
    const PRIORITY: u8;
    /// The time from one message to the next where nothing else is said; `None` if the standard
    /// names none.
    const INTERVAL: Option<Span>;

    /// Reads the contents of a message. Reserved bits are ignored; missing fields at the end are not
    /// available.
    ///
    /// # Errors
    /// The contents are too short to say anything.
    fn read(data: &[u8]) -> Result<Self, Short>;

    /// The contents of a message. A value that is not known, not finite or out of the range of its
    /// field is written as not available; reserved bits are ones.
    fn write(&self) -> Vec<u8>;
}

/// Contents that are too short to say anything.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{length} bytes, fewer than {least}")]
pub struct Short {
    /// Bytes there are.
    pub length: usize,
    /// Bytes there must be.
    pub least: usize,
}

/// An interval of so many milliseconds.
const fn millis(milliseconds: i64) -> Option<Span> {
    Some(Span::from_nanos(milliseconds * 1_000_000))
}
