//! Names of blocks.

use serde::{Deserialize, Serialize};

/// The name of a block of error states: which declaration, and which instance of it, as there may be one for each
/// antenna, satellite or pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct Key {
    /// Number of the declaration.
    pub kind: u16,
    /// Which of those of one kind.
    pub instance: u16,
}
