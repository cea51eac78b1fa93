//! Images and steps of a camera's front end.

use std::sync::Arc;

use insd_base::{CameraFrame, Message, Source, Span, Stamp, Time, VisualOdometry};
use insd_wire::nmea::{PinsdStep, PinsdTracks};

use super::{Came, Core};
use crate::camera::SeenImage;
use crate::event::{Happening, Refusal};

impl Core {
    pub(super) fn tracks(&mut self, index: usize, stamp: &Stamp, came: Came, told: &PinsdTracks) {
        let Some(camera) = &mut self.sensors[index].camera else { return };
        let (over, news) = camera.part(told, came.begun);
        self.tell_step_of_clock(index, stamp.monotonic);
        for image in over {
            self.image(index, stamp, image);
        }
        if let Err(reason) = news {
            self.refuse(index, reason);
        }
    }

    fn image(&mut self, index: usize, stamp: &Stamp, image: SeenImage) {
        self.validity(index, stamp.monotonic, !image.points.is_empty(), 0);
        if !image.is_whole {
            self.refuse(index, Refusal::Incomplete);
        }
        let Some(time) = image.time else {
            self.refuse(index, Refusal::NoTime);
            return;
        };
        let time = self.taken(index, time);
        let frame = CameraFrame { time, points: image.points };
        self.pass_seen(index, stamp, Message::Camera(Arc::new(frame)));
    }

    pub(super) fn step(&mut self, index: usize, stamp: &Stamp, came: Came, told: &PinsdStep) {
        let Some(camera) = &mut self.sensors[index].camera else { return };
        let step = camera.step(told, came.begun);
        self.tell_step_of_clock(index, stamp.monotonic);
        match step {
            Ok(step) => {
                self.validity(index, stamp.monotonic, true, 0);
                let [time, since] = [step.time, step.since].map(|own| self.taken(index, own));
                let step = VisualOdometry { time, since, ..step };
                self.pass_seen(index, stamp, Message::Odometry(step));
            }
            Err(reason) => self.refuse(index, reason),
        }
    }

    /// When an image was taken that the front end began to tell of at an instant at the earliest.
    fn taken(&self, index: usize, told: Time) -> Time {
        told - Span::from_seconds(self.sensors[index].config.latency_s)
    }

    fn pass_seen(&mut self, index: usize, stamp: &Stamp, message: Message) {
        let source = Source::Camera(self.sensors[index].number);
        self.pass(index, stamp.monotonic, source, message);
    }

    fn tell_step_of_clock(&mut self, index: usize, now: Time) {
        let camera = self.sensors[index].camera.as_mut();
        if let Some(by) = camera.and_then(|camera| camera.take_step()) {
            self.tell(now, Happening::DeviceClockStepped { sensor: index, by });
        }
    }
}
