//! Who was last heard beside the receiver, and of what.

use insd_base::Time;

/// When logs and references were last used.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Heard {
    /// Any of them.
    pub(super) relative: Option<Time>,
    /// One that tells how she moves, not where she points.
    pub(super) motion: Option<Time>,
    /// A speed through the water.
    pub(super) water: Option<Time>,
    /// A reference's position.
    pub(super) position: Option<Time>,
    /// A log's motion across; and when it was last assumed instead.
    pub(super) across: Option<Time>,
    pub(super) held: Option<Time>,
}
