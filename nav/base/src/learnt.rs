//! What becomes of what is learnt of the sensors.

use std::fmt;

/// What is learnt of a sensor is used otherwise than before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LearntTurn {
    /// What was learnt of the log has proven better than nothing, and is used.
    LogProven,
    /// It is no better than nothing any more, and is not used.
    LogUnproven,
    /// The log is another than it was: all that was learnt of it is dropped.
    LogChanged,
}

impl fmt::Display for LearntTurn {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::LogProven => "what was learnt of the log has proven itself, and is used",
            Self::LogUnproven => "what was learnt of the log does not help any more, and is not used",
            Self::LogChanged => {
                "the log is not what it was: fouled, exchanged or turned; what was learnt of it is dropped"
            }
        })
    }
}
