//! Why the best source of a solution changes.

use std::fmt;

use crate::satellites::RtkSilence;

/// Why the best source of the solution is another one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SourceReason {
    /// A better one has come.
    Better,
    /// The better one is not heard any more, or is not used.
    Unheard,
    /// There is no RTK.
    NoRtk(RtkSilence),
}

impl fmt::Display for SourceReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Better => f.write_str("it has come"),
            Self::Unheard => f.write_str("nothing better is heard or used"),
            Self::NoRtk(why) => why.fmt(f),
        }
    }
}
