//! Sensors that are watched: what they say goes to whoever compares it, and to nobody else.

use insd_base::{ExternalReference, Span};

use super::{Came, Core};
use crate::intaken::Intaken;
use crate::status::ShownPart;
use crate::watched::{Watched, WatchedValue};

impl Core {
    /// A heading or a position of a watched sensor.
    pub(super) fn watch_reference(&mut self, index: usize, reference: &ExternalReference) {
        let time = reference.time;
        let heading = reference.heading.map(WatchedValue::Heading);
        let position = reference.position.map(WatchedValue::Position);
        let told = [(heading, reference.heading_std), (position, reference.position_std)];
        for (value, std) in told {
            if let Some(value) = value {
                self.watch(Watched { sensor: index, time, value, std });
            }
        }
    }

    /// Something that is shown; how she leans is compared where the sensor is watched.
    pub(super) fn shown(&mut self, index: usize, came: Came, part: ShownPart) {
        let sensor = &mut self.sensors[index];
        sensor.status.shown.enter(part);
        if let ShownPart::Tilt { roll: Some(roll), pitch: Some(pitch) } = part
            && sensor.watched
        {
            let time = came.begun - Span::from_seconds(sensor.config.latency_s);
            let value = WatchedValue::Tilt { roll, pitch };
            self.watch(Watched { sensor: index, time, value, std: None });
        }
    }

    fn watch(&mut self, watched: Watched) {
        self.sensors[watched.sensor].status.passed += 1;
        self.outputs.push_back(Intaken::Watched(watched));
    }
}
