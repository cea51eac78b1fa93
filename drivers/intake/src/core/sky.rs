//! What one receiver's raw messages make: orbits that are known, ranges that wait for UTC, a fix where it tells none.

use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;

use insd_base::satellites::{IonosphereModel, SatelliteId};
use insd_base::{BaseEpoch, RtkEpoch};
use insd_base::{
    Constellation, Ecef, FixQuality, GnssFix, GpsTime, Ned, SatelliteEpoch, Time, earth,
};
use insd_gnss::{
    ArrayRanged, ArrayRanging, CompassTold, Context, DopplerVelocity, Guess, OrbitRefusal, Ranged,
    Ranging, RtkLink, SinglePoint, Turns,
};
use insd_wire::gnss::navigation::Broadcast;
use nalgebra::{Matrix3, Vector3};

use crate::event::BroadcastFault;
use crate::satellites::{EpochOrder, SatelliteFollower};

/// The satellites of one receiver.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sky {
    pub(super) follower: SatelliteFollower,
    pub(super) order: EpochOrder,
    /// When the first epoch came.
    pub(super) begun: Option<Time>,
    /// What has been made of epochs whose instant on the ship's time line is not known yet.
    pub(super) waiting: VecDeque<Undated>,
    context: Context,
    ranging: Ranging,
    /// What its epochs come to against a base, once one is heard.
    link: Option<Box<RtkLink>>,
    /// Where the receiver said last that its antenna is, ECEF, m; until an epoch has told it.
    antenna: Option<Vector3<f64>>,
    is_placed: bool,
    /// What is wrong with what satellites send, until a record of theirs is good.
    sent: Faults,
    /// What is wrong with the orbits of satellites that are seen.
    orbits: Faults,
}

/// What has been made of an epoch.
#[derive(Clone, Debug)]
pub(super) struct Undated {
    pub(super) ranged: Ranged,
    pub(super) compass: Option<CompassTold>,
    /// Where there is a base: the epoch itself.
    pub(super) kept: Option<SatelliteEpoch>,
}

/// What is wrong with satellites, by satellite.
#[derive(Clone, Debug, Default)]
struct Faults(BTreeMap<SatelliteId, BroadcastFault>);

/// A satellite and what is wrong with it, if that is news; `None`: nothing any more.
pub(super) type FaultNews = (SatelliteId, Option<BroadcastFault>);

impl Faults {
    fn note(&mut self, satellite: SatelliteId, fault: Option<BroadcastFault>) -> Option<FaultNews> {
        let before = match fault {
            Some(fault) => self.0.insert(satellite, fault),
            None => self.0.remove(&satellite),
        };
        let is_same = match (before, fault) {
            (None, None) => true,
            (Some(before), Some(now)) => before.is_like(&now),
            _ => false,
        };
        (!is_same).then_some((satellite, fault))
    }
}

impl Sky {
    /// Takes what a satellite has broadcast. Returns whether it is taken, and what is news of it.
    pub(super) fn broadcast(&mut self, told: Broadcast) -> (bool, Option<FaultNews>) {
        match told {
            Broadcast::Record(record) => {
                let inserted = self.context.ephemerides.insert(record);
                let fault = inserted.err().map(BroadcastFault::Orbit);
                (fault.is_none(), self.sent.note(record.satellite(), fault))
            }
            Broadcast::Ionosphere(model) => {
                let whose = match model {
                    IonosphereModel::Klobuchar { .. } => Constellation::Gps,
                    IonosphereModel::NeQuickG { .. } => Constellation::Galileo,
                };
                self.context.ionosphere.insert(whose, model);
                (true, None)
            }
            Broadcast::LeapSeconds(_) => (true, None),
        }
    }

    /// Words of a satellite were refused.
    pub(super) fn refused(
        &mut self,
        satellite: SatelliteId,
        fault: BroadcastFault,
    ) -> Option<FaultNews> {
        self.sent.note(satellite, Some(fault))
    }

    /// The receiver told a position of its own.
    pub(super) fn hear_fix(&mut self, fix: &GnssFix) {
        if !self.is_placed {
            self.antenna = fix.position.as_ref().map(|place| earth::ecef(place).0);
        }
    }

    /// What an epoch tells.
    pub(super) fn range(&mut self, epoch: &SatelliteEpoch, turns: &Turns) -> Ranged {
        let antenna = self.antenna.filter(|_| !self.is_placed);
        let guess = Guess { antenna, turned: turns.so_far() };
        let ranged = self.ranging.take(&self.context, epoch, guess);
        self.is_placed |= ranged.point.is_ok();
        ranged
    }

    /// What the epochs of an array tell, whose first receiver this is.
    pub(super) fn range_together(
        &mut self,
        array: &mut ArrayRanging,
        epochs: &[Option<&SatelliteEpoch>],
        turns: &Turns,
    ) -> ArrayRanged {
        let antenna = self.antenna.filter(|_| !self.is_placed);
        let told = array.take(&self.context, epochs, antenna, turns);
        self.is_placed |= told.ranged.as_ref().is_some_and(|ranged| ranged.point.is_ok());
        told
    }

    /// An epoch of a base; gives what an epoch that has waited for it comes to.
    pub(super) fn hear_base(&mut self, told: &Arc<BaseEpoch>) -> Option<RtkEpoch> {
        self.link.get_or_insert_default().hear_base(&self.context, told)
    }

    /// What it takes to hold an epoch against a base, where there is one.
    pub(super) fn kept(&self, epoch: &SatelliteEpoch) -> Option<SatelliteEpoch> {
        self.link.as_ref().map(|_| epoch.clone())
    }

    /// What an epoch, or the one before, comes to against a base.
    pub(super) fn against_base(&mut self, epoch: &SatelliteEpoch, time: Time) -> Vec<RtkEpoch> {
        let Some(link) = &mut self.link else { return Vec::new() };
        link.hear_rover(&self.context, epoch, time)
    }

    /// What is news of the orbits of the satellites of an epoch. One that has told none yet is no news.
    pub(super) fn look_at_orbits(&mut self, epoch: &SatelliteEpoch) -> Vec<FaultNews> {
        let satellites = epoch.signals.chunk_by(|a, b| a.satellite == b.satellite);
        let satellites = satellites.filter_map(|signals| Some(signals.first()?.satellite));
        let mut news = Vec::new();
        for satellite in satellites {
            let fault = match self.context.ephemerides.select(satellite, epoch.tag) {
                Ok(_) => None,
                Err(OrbitRefusal::NoRecord) => continue,
                Err(refusal) => Some(BroadcastFault::Orbit(refusal)),
            };
            news.extend(self.orbits.note(satellite, fault));
        }
        news
    }
}

/// When an epoch was sampled, as well as it tells: by its tag where its clock is not known.
pub(super) fn sampled(ranged: &Ranged, tag: GpsTime) -> GpsTime {
    if ranged.point.is_ok() { ranged.sampled } else { tag }
}

/// The fix that the codes and Doppler shifts of an epoch make, at an instant of the ship's time line.
pub(super) fn fix(point: &SinglePoint, velocity: Option<&DopplerVelocity>, time: Time) -> GnssFix {
    let place = earth::geodetic(&Ecef(point.position));
    let c_ne = earth::c_ne(&place);
    let sigmas = |covariance: &Matrix3<f64>| {
        let turned = c_ne * covariance * c_ne.transpose();
        Ned(turned.diagonal().map(|variance| variance.max(0.0).sqrt()))
    };
    GnssFix {
        time,
        position: Some(place),
        velocity: velocity.map(|told| Ned(c_ne * told.velocity)),
        position_std: Some(sigmas(&point.covariance)),
        velocity_std: velocity.map(|told| sigmas(&told.covariance)),
        hdop: None,
        satellites: u16::try_from(point.used().count()).ok(),
        quality: FixQuality::Autonomous,
        lever: None,
        redated: 0.0,
        rank: 0,
    }
}
