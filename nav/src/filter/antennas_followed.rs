//! Several antennas as a filter follows them.

use insd_base::SatelliteId;
use insd_base::satellites::LineBias;

/// The antennas as the filter follows them.
#[derive(Clone, Debug, Default)]
pub(super) struct Antennas {
    /// Lines that are carried, in the order of their states.
    pub(super) lines: Vec<LineBias>,
    /// Of which run of integers they are.
    pub(super) run: Option<u32>,
    /// Satellites of the epoch before.
    pub(super) sky: Vec<SatelliteId>,
    /// Epochs in a row that contradict the filter.
    pub(super) contradicted: u8,
}

impl Antennas {
    /// Whether any have been heard.
    pub(super) fn is_followed(&self) -> bool {
        self.run.is_some()
    }
}
