//! Who was heard for the first time when: antennas that are a compass, and docking aids. What the installer has told of them nobody has borne out.

use insd_base::Time;

use super::aid::DOCKING_AIDS;

/// Logarithm of how many of them are wrong from the begin: one in a hundred.
pub(super) const MISTAKEN: f64 = -4.6;

/// When each was heard first.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Newcomers {
    pub(super) antennas: Option<Time>,
    pub(super) docking: [Option<Time>; DOCKING_AIDS],
}
