//! What `nav.csv` says of satellites: who is left out, and of how many the ranges are in use.

use std::collections::BTreeSet;

use insd_base::{SatelliteId, SatelliteInnovation, Time};

/// Ranges of longer ago are not in use, s.
const IN_USE: f64 = 5.0;

/// The satellites of one solution.
#[derive(Debug, Default)]
pub(super) struct NavSatellites {
    excluded: BTreeSet<SatelliteId>,
    /// The newest epoch of which ranges were weighed.
    epoch: Option<Time>,
    used: BTreeSet<SatelliteId>,
}

impl NavSatellites {
    /// One is left out from now on, or used again.
    pub(super) fn leave_out(&mut self, satellite: SatelliteId, is_excluded: bool) {
        if is_excluded {
            self.excluded.insert(satellite);
        } else {
            self.excluded.remove(&satellite);
        }
    }

    /// Those that are left out, in the order of their names.
    pub(super) fn excluded(&self) -> impl Iterator<Item = &SatelliteId> {
        self.excluded.iter()
    }

    /// Takes note of what was told by one.
    pub(super) fn hear(&mut self, told: &SatelliteInnovation) {
        if self.epoch.is_none_or(|epoch| epoch < told.time) {
            self.epoch = Some(told.time);
            self.used.clear();
        }
        if told.accepted && self.epoch == Some(told.time) {
            self.used.insert(told.satellite);
        }
    }

    /// Of how many satellites the ranges are in use at an instant; `None` where they never were.
    pub(super) fn used(&self, now: Time) -> Option<usize> {
        let age = (now - self.epoch?).as_seconds();
        Some(if age <= IN_USE { self.used.len() } else { 0 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(seconds: f64, aid: &'static str, name: &str, accepted: bool) -> SatelliteInnovation {
        SatelliteInnovation {
            time: Time::from_seconds(seconds),
            aid,
            satellite: name.parse().unwrap(),
            innovation: 0.1,
            sigma: 1.0,
            accepted,
        }
    }

    #[test]
    fn a_satellite_counts_once_in_each_epoch_and_not_where_it_is_left_out() {
        let mut own = NavSatellites::default();
        assert_eq!(own.used(Time::START), None);
        for (aid, name, accepted) in [
            ("satellite_code", "G07", true),
            ("satellite_phase", "G07", true),
            ("satellite_code", "E11", true),
            ("satellite_code", "C30", false),
        ] {
            own.hear(&told(1.0, aid, name, accepted));
        }
        assert_eq!(own.used(Time::from_seconds(1.0)), Some(2));
        own.hear(&told(0.5, "satellite_code", "J02", true));
        assert_eq!(own.used(Time::from_seconds(6.0)), Some(2));
        own.hear(&told(2.0, "satellite_code", "E11", true));
        assert_eq!(own.used(Time::from_seconds(2.0)), Some(1));
    }

    #[test]
    fn none_are_in_use_when_the_ranges_have_ended() {
        let mut own = NavSatellites::default();
        own.hear(&told(1.0, "satellite_code", "G07", true));
        assert_eq!(own.used(Time::from_seconds(6.1)), Some(0));
    }
}
