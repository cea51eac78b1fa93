//! Distances of docking aids: each is timed by its receipt and the age that the device tells.

use insd_base::{Message, RangingReading, Source, Span, Stamp};

use super::{Came, Core};
use crate::event::Refusal;
use crate::ranging::{DockingAid, HeadDistance};

impl Core {
    pub(super) fn distance(
        &mut self,
        index: usize,
        stamp: &Stamp,
        came: Came,
        told: &HeadDistance,
    ) {
        let config = &self.sensors[index].config;
        let latency = config.latency_s + told.age;
        let is_it = |aid: &DockingAid| aid.spec.sensor == config.name && aid.spec.head == told.head;
        let Some(number) = self.aids.iter().position(is_it) else {
            self.refuse(index, Refusal::UnknownHead);
            return;
        };
        // one head that meets nothing says nothing of the others on its line
        let Some(distance) = told.distance else {
            self.refuse(index, Refusal::Invalid);
            return;
        };
        let now = stamp.monotonic;
        self.validity(index, now, true, 0);
        let aid = &mut self.aids[number];
        if !aid.pace.is_fresh(came.begun) {
            self.refuse(index, Refusal::TimeDoubted);
            return;
        }
        let spec = &aid.spec;
        let reading = RangingReading {
            time: came.begun - Span::from_seconds(latency),
            mark: spec.mark,
            target: spec.target,
            lever: spec.lever,
            distance,
            std: told.std.unwrap_or(spec.std),
        };
        let source = Source::Ranging(u8::try_from(number).unwrap_or(u8::MAX));
        self.pass(index, now, source, Message::Ranging(reading));
    }
}
