//! The sky as it was heard last, and what became of each satellite.

use std::sync::Arc;

use insd_base::Time;
use insd_base::satellites::{
    BaseEpoch, HeardSatellite, SatelliteRanges, SatelliteUse, Sky, SkySatellite,
};
use insd_nav::Navigator;

use crate::Engine;
use crate::ship::Ship;

impl Engine {
    /// The satellites of the last epoch that ranges were made of, with what becomes of each; `None` while no receiver tells
    /// what it measures of them. Put together at every call.
    #[must_use]
    pub fn sky(&self) -> Option<Sky> {
        let told = self.last_ranges.as_deref()?;
        let one = |heard: &HeardSatellite| SkySatellite {
            satellite: heard.satellite,
            direction: heard.direction,
            signals: heard.signals.clone(),
            fate: self.fate_of(told, heard),
            is_outlier: heard.is_outlier,
        };
        let mut satellites: Vec<_> = told.heard.iter().map(one).collect();
        satellites.sort_by_key(|own| own.satellite);
        Some(Sky { time: told.time, satellites })
    }

    /// When the last epoch that ranges were made of was sampled: that of [`Engine::sky`].
    #[must_use]
    pub fn sky_time(&self) -> Option<Time> {
        self.last_ranges.as_deref().map(|told| told.time)
    }

    fn fate_of(&self, told: &SatelliteRanges, heard: &HeardSatellite) -> SatelliteUse {
        if let Some(refused) = heard.refused {
            return SatelliteUse::Refused(refused);
        }
        let range = told.ranges.iter().find(|range| range.satellite == heard.satellite);
        let navigator = self.ship().filter(|ship| ship.has_one_heading()).and_then(Ship::likeliest);
        let filter = navigator.map(Navigator::filter);
        filter.zip(range).map_or(SatelliteUse::Waiting, |(filter, range)| filter.fate_of(range))
    }

    /// What a base measured last, in differences to which the ranges of the ship are held.
    #[must_use]
    pub fn base(&self) -> Option<&BaseEpoch> {
        self.last_base.as_deref()
    }

    /// Takes note of what a base measured. What it comes to with the epochs on board is another message ([`insd_base::Message::Rtk`]).
    pub(crate) fn hear_base(&mut self, told: &Arc<BaseEpoch>) {
        self.last_base = Some(Arc::clone(told));
    }

    /// Takes note of an epoch, and counts the satellites that it has no ranges of.
    pub(crate) fn hear_satellites(&mut self, told: &Arc<SatelliteRanges>) {
        for refused in told.heard.iter().filter_map(|heard| heard.refused) {
            *self.counts.unranged.entry(refused.as_str()).or_insert(0) += 1;
        }
        self.last_ranges = Some(Arc::clone(told));
    }
}
