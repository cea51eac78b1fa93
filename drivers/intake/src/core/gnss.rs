//! Epochs of receivers, and what else they say of time.

use insd_base::units::wrap_two_pi;
use insd_base::{ExternalReference, GnssFix, GpsTime, Message, Source, Span, Stamp, Time};
use insd_wire::gnss::{EpochTime, GnssPart, PulseOrder, PulseTime};

use super::{Came, Core, WAITING};
use crate::choice::Quantity;
use crate::config::Role;
use crate::event::Refusal;
use crate::sensor::Epoch;

impl Core {
    /// Parts of epochs that came before any date was known wait for it.
    pub(super) fn gnss(&mut self, index: usize, stamp: &Stamp, came: Came, part: &GnssPart) {
        let live = self.sensors[index].live;
        let gps = part.epoch.and_then(|epoch| self.utc.resolve(&epoch, stamp, live));
        let times = (came.begun, came.ended);
        let undated = &mut self.sensors[index].undated;
        if gps.is_none() && (part.epoch.is_some() || !undated.is_empty()) {
            if undated.len() < WAITING {
                undated.push((*part, times));
            } else {
                self.refuse(index, Refusal::NoTime);
            }
            return;
        }
        for (early, times) in std::mem::take(undated) {
            let gps = early.epoch.and_then(|epoch| self.utc.resolve(&epoch, stamp, live));
            self.part(index, stamp, times, &early, gps);
        }
        self.part(index, stamp, times, part, gps);
    }

    pub(super) fn part(
        &mut self,
        index: usize,
        stamp: &Stamp,
        (first, ended): (Time, Time),
        part: &GnssPart,
        gps: Option<GpsTime>,
    ) {
        let config = &self.sensors[index].config;
        let latency = Span::from_seconds(config.latency_s);
        let (begun, priority) = (first - latency, config.priority);
        if let Some(gps) = gps
            && !part.invalid
            && !self.utc.message((priority, index), gps, first, latency)
        {
            self.refuse(index, Refusal::TimeDoubted);
            return;
        }
        let sensor = &mut self.sensors[index];
        if let Some(epoch) = sensor.epochs.take(part, gps, begun, ended) {
            if sensor.waiting.len() == WAITING {
                sensor.waiting.pop_front();
            }
            sensor.waiting.push_back(epoch);
        }
        while let Some(epoch) = self.sensors[index].waiting.pop_front() {
            let Some(time) = self.utc.time_of(epoch.gps) else {
                self.sensors[index].waiting.push_front(epoch);
                break;
            };
            self.epoch(index, stamp.monotonic, time, &epoch);
        }
    }

    pub(super) fn epoch(&mut self, index: usize, now: Time, time: Time, epoch: &Epoch) {
        let sensor = &self.sensors[index];
        let (number, role) = (sensor.number, sensor.config.kind.role());
        let default_std = sensor.config.position_std_m;
        let lasting_std = sensor.config.position_lasting_std_m;
        let time = time - Span::from_seconds(sensor.config.delay_s);
        let fix = GnssFix { lever: sensor.config.lever(), ..epoch.fix(time) };
        self.validity(index, now, epoch.is_valid() || epoch.is_compass(), 0);
        self.sensors[index].fixed = Some(now);
        if let Some(sky) = self.sensors[index].sky.as_mut().filter(|_| epoch.is_valid()) {
            sky.hear_fix(&fix);
        }
        if let Some(position) = fix.position.filter(|_| epoch.is_valid()) {
            self.here = Some(position);
            self.variation.here(position, self.utc.utc_at(time));
        }
        if role == Role::Position {
            let std = fix.position_std.map(|std| std.0.xy().norm());
            let reference = ExternalReference {
                time,
                position: fix.position,
                position_std: std.filter(|std| std.is_finite()).or(Some(default_std)),
                position_lasting_std: lasting_std,
                ..ExternalReference::default()
            };
            self.reference(Quantity::Position, index, now, epoch.is_valid(), reference);
            return;
        }
        self.own_heading(index, now, time, epoch);
        if epoch.is_compass() {
            return;
        }
        let is_used = self.choose(Quantity::Gnss, index, epoch.is_valid(), now);
        if is_used || epoch.is_valid() {
            let fix = GnssFix { rank: self.choices[Quantity::Gnss as usize].rank(index), ..fix };
            self.pass(index, now, Source::Gnss(number), Message::Gnss(fix));
        } else {
            self.refuse(index, Refusal::Invalid);
        }
    }

    /// The heading of a receiver with several antennas, where it is used.
    fn own_heading(&mut self, index: usize, now: Time, time: Time, epoch: &Epoch) {
        let config = &self.sensors[index].config;
        let Some(heading) = epoch.part.heading.filter(|_| config.heading) else { return };
        let heading = wrap_two_pi(heading + config.heading_offset_deg.to_radians());
        let default = config.heading_std_deg.to_radians();
        let reference = ExternalReference {
            time,
            heading: Some(heading),
            heading_std: epoch.part.heading_std.or(Some(default)),
            ..ExternalReference::default()
        };
        let valid = epoch.is_valid() || epoch.is_compass();
        self.reference(Quantity::Heading, index, now, valid, reference);
    }

    /// UTC that a receiver tells beside its fixes.
    pub(super) fn clock(&mut self, index: usize, stamp: &Stamp, came: Came, epoch: &EpochTime) {
        let config = &self.sensors[index].config;
        let (priority, latency) = (config.priority, Span::from_seconds(config.latency_s));
        let live = self.sensors[index].live;
        if let Some(gps) = self.utc.resolve(epoch, stamp, live)
            && !self.utc.message((priority, index), gps, came.begun, latency)
        {
            self.refuse(index, Refusal::TimeDoubted);
        }
    }

    pub(super) fn pulse_time(&mut self, index: usize, stamp: &Stamp, pulse: &PulseTime) {
        let gps = self.utc.resolve(&pulse.instant, stamp, self.sensors[index].live);
        if let Some(gps) = gps.filter(|_| pulse.order == PulseOrder::Next) {
            self.utc.announce(gps);
        }
    }
}
