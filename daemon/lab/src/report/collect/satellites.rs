//! Of how many satellites ranges were in use.

use std::collections::BTreeSet;

use insd_base::{SatelliteId, SatelliteInnovation, Time};

use crate::report::statistics::Statistics;

/// Satellites by epoch.
#[derive(Clone, Debug, Default)]
pub(crate) struct Satellites {
    epoch: Option<Time>,
    used: BTreeSet<SatelliteId>,
    /// Satellites of which something was used, one value for each epoch; no value where there never was one.
    pub(crate) in_use: Statistics,
}

impl Satellites {
    /// Takes what one told. What is told again of an epoch before the newest, after a late message, was counted.
    pub(crate) fn take(&mut self, told: &SatelliteInnovation) {
        if self.epoch.is_none_or(|epoch| epoch < told.time) {
            self.finish();
            self.epoch = Some(told.time);
        }
        if told.accepted && self.epoch == Some(told.time) {
            self.used.insert(told.satellite);
        }
    }

    /// Nothing more of this epoch comes.
    pub(crate) fn finish(&mut self) {
        if self.epoch.take().is_some() {
            self.in_use.add(self.used.len() as f64);
        }
        self.used.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_satellite_counts_once_in_each_epoch_and_not_where_nothing_of_it_is_used() {
        let mut own = Satellites::default();
        own.finish();
        assert_eq!(own.in_use.extremes(), None);
        let all = [(1.0, "G07", true), (1.0, "G07", true), (1.0, "G08", true), (2.0, "G08", false)];
        for (seconds, name, accepted) in all {
            own.take(&SatelliteInnovation {
                time: Time::from_seconds(seconds),
                aid: "satellite_code",
                satellite: name.parse().unwrap(),
                innovation: 0.1,
                sigma: 1.0,
                accepted,
            });
        }
        own.finish();
        assert_eq!((own.in_use.count(), own.in_use.extremes()), (2, Some((0.0, 2.0))));
    }
}
