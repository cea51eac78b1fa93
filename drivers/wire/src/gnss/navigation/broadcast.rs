//! What is made of the words of satellites, and why words are refused.

use std::fmt;

use insd_base::satellites::{BroadcastRecord, IonosphereModel};

/// Something that a satellite has told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Broadcast {
    /// Its orbit and its clock.
    Record(BroadcastRecord),
    /// The ionosphere.
    Ionosphere(IonosphereModel),
    /// GPS - UTC at the time of reception, s.
    LeapSeconds(i8),
}

/// Why words say nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WordsRefusal {
    /// Fewer words than the message has.
    Short {
        /// Words that it has.
        needed: usize,
        /// Words that there are.
        found: usize,
    },
    /// A parity or a sum is wrong, or it does not begin as it should.
    Damaged,
    /// The halves of a page do not belong together.
    Halves,
    /// Numbers that are no orbit of a satellite of navigation.
    Implausible,
}

impl fmt::Display for WordsRefusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            WordsRefusal::Short { needed, found } => {
                write!(f, "{needed} words expected, {found} found")
            }
            WordsRefusal::Damaged => f.write_str("a parity, a sum or the start is wrong"),
            WordsRefusal::Halves => f.write_str("two halves that are not of one page"),
            WordsRefusal::Implausible => f.write_str("no orbit of a satellite of navigation"),
        }
    }
}

impl std::error::Error for WordsRefusal {}
