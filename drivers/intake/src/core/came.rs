//! When bytes came.

use insd_base::Time;

/// When the bytes of what was told came.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Came {
    /// The first.
    pub(crate) begun: Time,
    /// The last.
    pub(crate) ended: Time,
}
