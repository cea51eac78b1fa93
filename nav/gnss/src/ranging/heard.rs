//! A satellite as an epoch has it, before anything is made of it.

use insd_base::satellites::{HeardSatellite, OrbitRefusal, RangeRefusal, SignalStrength};
use insd_base::{BroadcastRecord, GpsTime, SatelliteId, SignalObservation};
use nalgebra::Vector3;

use crate::context::Context;
use crate::sight::Sight;
use crate::signals::best_of_each_band;
use crate::single_point::{SinglePoint, Verdict};

/// The range that puts a satellite without a code into the sky, m: within the times that any range takes it moves by less than a kilometre.
const NOMINAL: f64 = 2.4e7;

/// A satellite of an epoch.
pub(super) struct Heard<'a> {
    pub(super) satellite: SatelliteId,
    signals: &'a [SignalObservation],
    /// The best signal with a code of each band.
    pub(super) best: Vec<&'a SignalObservation>,
    /// Its record, and where it is.
    pub(super) orbit: Result<(&'a BroadcastRecord, Sight), OrbitRefusal>,
}

impl<'a> Heard<'a> {
    /// The satellite of some signals; `None` of none.
    pub(super) fn new(
        context: &'a Context,
        tag: GpsTime,
        signals: &'a [SignalObservation],
    ) -> Option<Self> {
        let satellite = signals.first()?.satellite;
        let best = best_of_each_band(signals);
        let code = best.first().and_then(|signal| signal.code).unwrap_or(NOMINAL);
        let record = context.ephemerides.select(satellite, tag);
        let orbit = record.map(|record| (record, Sight::new(record, tag, code)));
        Some(Self { satellite, signals, best, orbit })
    }

    /// What is told of it to those who look on.
    pub(super) fn told(
        &self,
        antenna: Option<&Vector3<f64>>,
        refused: Option<RangeRefusal>,
        point: Option<&SinglePoint>,
    ) -> HeardSatellite {
        let sight = self.orbit.as_ref().ok().map(|(_, sight)| sight);
        let mut witnesses = point.into_iter().flat_map(|point| &point.satellites);
        let own = witnesses.find(|witness| witness.satellite == self.satellite);
        HeardSatellite {
            satellite: self.satellite,
            direction: sight.zip(antenna).map(|(sight, antenna)| sight.direction(antenna)),
            signals: self.strengths(),
            refused,
            is_outlier: own.is_some_and(|witness| witness.verdict == Verdict::Faulty),
        }
    }

    /// Of bands without a code the signal that comes first.
    fn strengths(&self) -> Vec<SignalStrength> {
        let mut all = self.best.clone();
        for signal in self.signals {
            if !all.iter().any(|known| known.signal.band == signal.signal.band) {
                all.push(signal);
            }
        }
        all.sort_by_key(|signal| signal.signal.band);
        all.iter().map(|signal| SignalStrength { signal: signal.signal, cn0: signal.cn0 }).collect()
    }
}
