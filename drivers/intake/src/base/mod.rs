//! A base station: what it measures and where it is, put together and looked at.
//!
//! Nothing of it is ever taken for what the ship's own receivers say: it is another role of sensors, takes part in no
//! choice, and its epochs are messages of their own ([`insd_base::Message::Base`]).

mod place;
mod settings;
mod status;

pub use settings::BaseSettings;
pub use status::{BaseNews, BaseStatus};

use insd_base::{BaseEpoch, Ecef, Geodetic, GpsTime, SatelliteEpoch, Time};
use insd_wire::gnss::Locks;
use insd_wire::gnss::rtcm::{BaseStation, Correction, MsmCollector};

use crate::event::Refusal;
use crate::satellites::EpochOrder;
use place::Place;

/// Epochs without a position after which it is told that none comes.
const UNPLACED: u32 = 60;

/// One base at work.
#[derive(Clone, Debug)]
pub(crate) struct Base {
    collector: MsmCollector,
    locks: Locks,
    order: EpochOrder,
    place: Place,
    /// Epochs so far without a position.
    unplaced: u32,
    pub(crate) status: BaseStatus,
}

/// What a frame has told.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum BaseTold {
    /// An epoch in its order, signals in theirs.
    Epoch(SatelliteEpoch),
    /// News of the station.
    News(BaseNews),
    /// Something is refused.
    Refused(Refusal),
}

impl Base {
    pub(crate) fn new(settings: BaseSettings) -> Self {
        Base {
            collector: MsmCollector::new(),
            locks: Locks::default(),
            order: EpochOrder::default(),
            place: Place::new(settings),
            unplaced: 0,
            status: BaseStatus::default(),
        }
    }

    /// Takes a frame that was received at an instant of both scales; where the ship is, if it is known.
    pub(crate) fn take(
        &mut self,
        frame: &[u8],
        (now, received): (Time, GpsTime),
        ship: Option<&Geodetic>,
    ) -> Vec<BaseTold> {
        let Ok(corrections) = self.collector.take(frame, received) else {
            return vec![BaseTold::Refused(Refusal::Malformed)];
        };
        let mut told = Vec::new();
        for correction in corrections {
            match correction {
                Correction::Epoch(epoch) => told.push(self.epoch(epoch)),
                Correction::Base(station) => told.extend(self.station(&station, now)),
                // satellites tell the ship their orbits themselves
                Correction::Record(_) => self.status.records += 1,
            }
        }
        let distance = ship.and_then(|ship| self.place.look_at_distance(ship));
        self.status.distance = self.place.distance();
        told.extend(distance.map(BaseTold::News));
        told
    }

    fn epoch(&mut self, mut epoch: SatelliteEpoch) -> BaseTold {
        if !self.order.admit(epoch.tag) {
            return BaseTold::Refused(Refusal::Repeated);
        }
        epoch.signals.sort_by_key(|signal| (signal.satellite, signal.signal));
        epoch.signals.dedup_by_key(|signal| (signal.satellite, signal.signal));
        self.locks.mark(&mut epoch);
        BaseTold::Epoch(epoch)
    }

    fn station(&mut self, told: &BaseStation, now: Time) -> Vec<BaseTold> {
        self.status.stations += 1;
        let news = self.place.hear(told, now);
        let is_refused =
            self.place.is_implausible().then_some(BaseTold::Refused(Refusal::BasePlace));
        self.status.station = Some(told.station);
        self.status.position = self.place.at(now);
        news.into_iter().map(BaseTold::News).chain(is_refused).collect()
    }

    /// An epoch for the navigator, and news if nobody tells where the base is.
    pub(crate) fn offer(
        &mut self,
        epoch: SatelliteEpoch,
        time: Time,
        now: Time,
    ) -> (BaseEpoch, Option<BaseNews>) {
        let position = self.place.at(now);
        self.unplaced = if position.is_some() { 0 } else { self.unplaced.saturating_add(1) };
        let satellites = epoch.signals.chunk_by(|a, b| a.satellite == b.satellite).count();
        self.status.epochs += 1;
        self.status.newest = Some(time);
        self.status.satellites = u16::try_from(satellites).unwrap_or(u16::MAX);
        self.status.signals = u16::try_from(epoch.signals.len()).unwrap_or(u16::MAX);
        self.status.position = position;
        let news = (self.unplaced == UNPLACED).then_some(BaseNews::Unplaced);
        let (station, is_moving) = (self.status.station, self.place.is_moving());
        let is_surveyed = self.place.is_surveyed();
        let position = position.map(Ecef);
        (BaseEpoch { time, station, position, is_surveyed, is_moving, epoch }, news)
    }
}

#[cfg(test)]
mod tests;
