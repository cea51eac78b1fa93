//! Raw messages of receivers: ranges of satellites, on the ship's time line, of the receiver that is in use.

use std::sync::Arc;

use insd_base::{GnssFix, GpsTime, Message, SatelliteEpoch, Source, Span, Stamp, Time};
use insd_gnss::{CompassTold, Ranged};
use insd_wire::gnss::EpochTime;

use super::array::Arrived;
use super::sky::{self, FaultNews, Undated};
use super::{Came, Core, WAITING};
use crate::choice::Quantity;
use crate::event::{BroadcastFault, Happening, Refusal};
use crate::satellites::{RawReading, SatelliteNews, WordsFault};

/// A receiver that has told no fix for so long, s, gives none: its raw epochs make them.
const FIXLESS: f64 = 5.0;

impl Core {
    /// What a raw message says.
    pub(super) fn raw(&mut self, index: usize, stamp: &Stamp, came: Came, reading: &RawReading) {
        let about = self.utc.about(stamp);
        let reading = self.dated(index, stamp, reading);
        let sky = self.sensors[index].sky.get_or_insert_default();
        for told in sky.follower.take(&reading, about) {
            match told {
                Ok(SatelliteNews::Epoch { epoch, is_dated }) => {
                    self.satellites(index, stamp, came, &epoch, is_dated);
                }
                Ok(SatelliteNews::Broadcast(told)) => {
                    let Some(sky) = &mut self.sensors[index].sky else { continue };
                    let (is_taken, news) = sky.broadcast(told);
                    if !is_taken {
                        self.refuse(index, Refusal::Broadcast);
                    }
                    self.tell_faults(index, stamp.monotonic, news);
                }
                Err(WordsFault::Words(satellite, refusal)) => {
                    let Some(sky) = &mut self.sensors[index].sky else { continue };
                    let news = sky.refused(satellite, BroadcastFault::Words(refusal));
                    self.refuse(index, Refusal::Broadcast);
                    self.tell_faults(index, stamp.monotonic, news);
                }
                Err(WordsFault::Malformed) => self.refuse(index, Refusal::Malformed),
                Err(WordsFault::NoTime) => self.refuse(index, Refusal::NoTime),
            }
        }
    }

    /// A reading whose week is put right, where the receiver's may be behind by whole cycles.
    fn dated(&mut self, index: usize, stamp: &Stamp, reading: &RawReading) -> RawReading {
        let live = self.sensors[index].live;
        let mut reading = reading.clone();
        if let RawReading::Measured { epoch, is_dated: true, .. } = &mut reading {
            let resolved = self.utc.resolve(&EpochTime::Gps(epoch.tag), stamp, live);
            epoch.tag = resolved.unwrap_or(epoch.tag);
        }
        reading
    }

    fn satellites(
        &mut self,
        index: usize,
        stamp: &Stamp,
        came: Came,
        epoch: &SatelliteEpoch,
        is_dated: bool,
    ) {
        let sets_time = is_dated && self.is_fixless(index, came.ended);
        if !sets_time && !self.is_timely(index, came, epoch.tag) {
            self.refuse(index, Refusal::TimeDoubted);
            return;
        }
        let Some(sky) = &mut self.sensors[index].sky else { return };
        sky.begun.get_or_insert(came.ended);
        let order = sky.order;
        if !sky.order.admit(epoch.tag) {
            self.refuse(index, Refusal::Repeated);
            return;
        }
        let epoch = epoch.clone();
        let arrived = Arrived { stamp: *stamp, came, epoch, is_dated, order };
        let array = self.array.as_mut();
        let Some((array, place)) = array.and_then(|own| own.place(index).map(|at| (own, at)))
        else {
            self.measured(index, &arrived);
            return;
        };
        for together in array.take(place, arrived) {
            self.measured_together(together);
        }
    }

    /// Epochs of one instant of receivers that are an array: ranges are those of the first, or of the middle of all. Without the first each stands for itself.
    fn measured_together(&mut self, together: Vec<Option<Arrived>>) {
        let Some(mut array) = self.array.take() else { return };
        let first = array.members[0];
        let epochs: Vec<_> =
            together.iter().map(|own| own.as_ref().map(|own| &own.epoch)).collect();
        let sky = self.sensors[first].sky.as_mut().zip(together[0].as_ref());
        let ranged = sky.and_then(|(sky, arrived)| {
            let told = sky.range_together(&mut array.ranging, &epochs, &self.turns);
            Some((arrived, told.ranged?, told.compass))
        });
        let members = array.members.clone();
        self.array = Some(array);
        match ranged {
            Some((arrived, ranged, compass)) => {
                // the last of them is when all are known
                let last = together.iter().flatten().map(|own| own.stamp.monotonic).max();
                let now = last.unwrap_or(arrived.stamp.monotonic);
                self.weigh(first, now, arrived, (ranged, compass));
            }
            None => {
                for (index, arrived) in members.into_iter().zip(together) {
                    arrived.iter().for_each(|arrived| self.measured(index, arrived));
                }
            }
        }
    }

    fn measured(&mut self, index: usize, arrived: &Arrived) {
        let Some(sky) = &mut self.sensors[index].sky else { return };
        let ranged = sky.range(&arrived.epoch, &self.turns);
        self.weigh(index, arrived.stamp.monotonic, arrived, (ranged, None));
    }

    fn weigh(
        &mut self,
        index: usize,
        now: Time,
        Arrived { came, epoch, is_dated, order, .. }: &Arrived,
        (ranged, compass): (Ranged, Option<CompassTold>),
    ) {
        let Some(sky) = &mut self.sensors[index].sky else { return };
        let news = sky.look_at_orbits(epoch);
        self.tell_faults(index, now, news);
        let sampled = sky::sampled(&ranged, epoch.tag);
        let knows_time = *is_dated || ranged.point.is_ok();
        if !self.is_believed(index, *came, sampled, knows_time) {
            if let Some(sky) = &mut self.sensors[index].sky {
                sky.order = *order; // a tag that is doubted makes no later one late
            }
            self.refuse(index, Refusal::TimeDoubted);
            return;
        }
        if ranged.ranges.is_empty() {
            self.refuse(index, Refusal::NoOrbit);
        }
        self.range(index, now, (ranged, compass), epoch);
    }

    /// Whether the time of an epoch fits what is known. It sets the ship's time if it is all that the receiver tells of it.
    fn is_believed(
        &mut self,
        index: usize,
        came: Came,
        sampled: GpsTime,
        knows_time: bool,
    ) -> bool {
        if !knows_time || !self.is_fixless(index, came.ended) {
            return self.is_timely(index, came, sampled);
        }
        let config = &self.sensors[index].config;
        let latency = Span::from_seconds(config.latency_s);
        self.utc.message((config.priority, index), sampled, came.begun, latency)
    }

    /// Whether an instant fits the receipt of its message, as far as the time is known.
    fn is_timely(&self, index: usize, came: Came, instant: GpsTime) -> bool {
        let latency = Span::from_seconds(self.sensors[index].config.latency_s);
        self.utc.fits(instant, came.begun, latency)
    }

    fn is_fixless(&self, index: usize, now: Time) -> bool {
        let sensor = &self.sensors[index];
        let since = sensor.fixed.or(sensor.sky.as_ref().and_then(|sky| sky.begun));
        since.is_some_and(|since| (now - since).as_seconds() > FIXLESS)
    }

    /// Ranges wait until it is known when they were.
    fn range(
        &mut self,
        index: usize,
        now: Time,
        (ranged, compass): (Ranged, Option<CompassTold>),
        epoch: &SatelliteEpoch,
    ) {
        let Some(sky) = &mut self.sensors[index].sky else { return };
        let kept = sky.kept(epoch);
        sky.waiting.push_back(Undated { ranged, compass, kept });
        if sky.waiting.len() > WAITING {
            sky.waiting.pop_front();
            self.refuse(index, Refusal::NoTime);
        }
        while let Some(undated) = self.next_undated(index) {
            let Some(time) = self.utc.time_of(undated.ranged.sampled) else {
                if let Some(sky) = &mut self.sensors[index].sky {
                    sky.waiting.push_front(undated);
                }
                break;
            };
            self.ranged(index, now, time, undated);
        }
    }

    fn next_undated(&mut self, index: usize) -> Option<Undated> {
        self.sensors[index].sky.as_mut()?.waiting.pop_front()
    }

    fn ranged(&mut self, index: usize, now: Time, time: Time, undated: Undated) {
        let Undated { ranged, compass, kept } = undated;
        let source = Source::Gnss(self.sensors[index].number);
        if self.is_fixless(index, now) {
            self.point(index, now, time, &ranged);
        }
        // how the hull stands does not hang on whose ranges are used
        if let Some(compass) = compass {
            self.pass(index, now, source, Message::Compass(Arc::new(compass.at(time))));
        }
        if !self.may_range(index, now) {
            self.refuse(index, Refusal::NotChosen);
            return;
        }
        // satellites of which nothing can be made yet are told to those who look on
        if !ranged.ranges.is_empty() {
            self.take_ranges_of(index, now);
        }
        let told = ranged.told(time);
        self.pass(index, now, source, Message::Ranges(Arc::new(told)));
        let sky = self.sensors[index].sky.as_mut().zip(kept);
        let told = sky.map(|(sky, epoch)| sky.against_base(&epoch, time)).unwrap_or_default();
        told.into_iter().for_each(|told| self.pass(index, now, source, Message::Rtk(told)));
    }

    /// The fix of a receiver that tells none.
    fn point(&mut self, index: usize, now: Time, time: Time, ranged: &Ranged) {
        let point = ranged.point.as_ref().ok();
        self.validity(index, now, point.is_some(), 0);
        self.choose(Quantity::Gnss, index, point.is_some(), now);
        let Some(point) = point else { return };
        let fix = GnssFix {
            lever: self.sensors[index].config.lever(),
            rank: self.choices[Quantity::Gnss as usize].rank(index),
            ..sky::fix(point, ranged.velocity.as_ref(), time)
        };
        if let Some(position) = fix.position {
            self.here = Some(position);
            self.variation.here(position, self.utc.utc_at(time));
        }
        let source = Source::Gnss(self.sensors[index].number);
        self.pass(index, now, source, Message::Gnss(fix));
    }

    /// Whether ranges of a receiver count: it is the one in use; or none is, as none has satellites enough for a fix, and no other's ranges do.
    fn may_range(&self, index: usize, now: Time) -> bool {
        match self.choices[Quantity::Gnss as usize].current() {
            Some(current) => current == index,
            None => self.ranging.is_none_or(|(own, last)| {
                own == index || (now - last).as_seconds() > self.sensors[own].config.patience_s
            }),
        }
    }

    fn take_ranges_of(&mut self, index: usize, now: Time) {
        let before = self.ranging.replace((index, now)).map(|(sensor, _)| sensor);
        if before != Some(index) {
            self.tell_unused(before, now);
            self.tell(now, Happening::Ranges { sensor: index, used: true });
        }
    }

    /// Ranges that have not come for too long are told.
    pub(super) fn look_at_ranges(&mut self, now: Time) {
        let is_over = |(own, last): &mut (usize, Time)| {
            (now - *last).as_seconds() > self.sensors[*own].config.patience_s
        };
        let over = self.ranging.take_if(is_over).map(|(sensor, _)| sensor);
        self.tell_unused(over, now);
    }

    fn tell_unused(&mut self, sensor: Option<usize>, now: Time) {
        if let Some(sensor) = sensor {
            self.tell(now, Happening::Ranges { sensor, used: false });
        }
    }

    fn tell_faults(&mut self, sensor: usize, now: Time, news: impl IntoIterator<Item = FaultNews>) {
        for (satellite, fault) in news {
            self.tell(now, Happening::Satellite { sensor, satellite, fault });
        }
    }
}
