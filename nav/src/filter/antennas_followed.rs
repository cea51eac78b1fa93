//! Several antennas as a filter follows them.

use insd_base::SatelliteId;
use insd_base::satellites::{CompassPhases, LineBias};

/// The antennas as the filter follows them.
#[derive(Clone, Debug, Default)]
pub(super) struct Antennas {
    /// Lines that are carried, in the order of their states.
    pub(super) lines: Vec<LineBias>,
    /// Of which run of integers they are.
    pub(super) run: Option<u32>,
    /// Satellites of the epoch before: of the phases, and of the heading that the judge has heard.
    pub(super) sky: Vec<SatelliteId>,
    pub(super) heard_sky: Vec<SatelliteId>,
    /// Epochs in a row that contradict the filter.
    pub(super) contradicted: u8,
}

/// Satellites of an epoch, and whether a third of them are others than before.
pub(super) fn sky_of(told: &CompassPhases, before: &[SatelliteId]) -> (Vec<SatelliteId>, bool) {
    let mut sky: Vec<_> = told.signals.iter().map(|signal| signal.satellite).collect();
    sky.sort_unstable();
    sky.dedup();
    let stayed = sky.iter().filter(|satellite| before.contains(satellite)).count();
    let is_other = 3 * stayed < 2 * sky.len().max(before.len());
    (sky, is_other)
}

impl Antennas {
    /// Whether any have been heard.
    pub(super) fn is_followed(&self) -> bool {
        self.run.is_some()
    }
}
