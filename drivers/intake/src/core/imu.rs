//! Samples of IMUs.

use insd_base::{Message, Source, Span, Stamp, Time};
use insd_wire::gnss::EpochTime;
use insd_wire::imu::ImuReading;

use super::{Came, Core};
use crate::choice::Quantity;
use crate::event::{Happening, Refusal};
use crate::intaken::Intaken;
use crate::sensor::{ImuChange, TimeBase};

impl Core {
    pub(super) fn imu(&mut self, index: usize, stamp: &Stamp, came: Came, sample: &ImuReading) {
        let now = stamp.monotonic;
        let sensor = &mut self.sensors[index];
        let pulls = sensor.gravity.bears(&sample.motion, 1.0 / sensor.config.rate_hz);
        let (live, told) = (sensor.live, sample.valid);
        let sample = &ImuReading { valid: told && pulls, ..*sample };
        self.validity(index, now, sample.valid, sample.status);
        let sensor = &mut self.sensors[index];
        sensor.status.temperature = sample.temperature.or(sensor.status.temperature);
        let Some(imu) = &mut sensor.imu else { return };
        let mut ready = Vec::new();
        let changes = imu.take(sample, came.begun, &self.utc, &mut ready);
        if let (Some(utc), None) = (sample.utc, changes[1]) {
            let priority = sensor.config.priority.saturating_add(100);
            let latency = Span::from_seconds(sensor.config.latency_s);
            if let Some(gps) = self.utc.resolve(&EpochTime::Utc(utc), stamp, live) {
                self.utc.message((priority, index), gps, came.begun, latency);
            }
        }
        for change in changes.into_iter().flatten() {
            self.tell_imu(index, now, change);
        }
        if !sample.valid {
            self.refuse(index, if told { Refusal::Gravity } else { Refusal::Invalid });
        }
        if self.sensors[index].config.time == TimeBase::Utc && sample.utc.is_none() {
            self.refuse(index, Refusal::NoTime);
        }
        let used = self.choose(Quantity::Inertial, index, sample.valid, now);
        let own = &mut self.sensors[index];
        let celsius = sample.temperature.and_then(|told| own.warmth.take(now, told));
        if let Some(celsius) = celsius.filter(|_| used) {
            self.outputs.push_back(Intaken::Temperature(now, celsius));
        }
        let number = self.sensors[index].number;
        for sample in ready {
            if used {
                self.turns.hear(&sample);
                self.pass(index, now, Source::Imu(number), Message::Imu(sample));
            } else {
                self.refuse(index, Refusal::NotChosen);
            }
        }
    }

    pub(super) fn tell_imu(&mut self, index: usize, now: Time, change: ImuChange) {
        let what = match change {
            ImuChange::Lost(count) => {
                self.sensors[index].status.lost += count;
                Happening::SamplesLost { sensor: index, count }
            }
            ImuChange::ClockStepped(by) => Happening::DeviceClockStepped { sensor: index, by },
        };
        self.tell(now, what);
    }
}
