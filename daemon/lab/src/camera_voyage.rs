//! The camera of a voyage directory on its way into the engine.

use std::path::Path;
use std::sync::Arc;

use insd_base::{Message, Received, Source, Time};
use insd_drivers::recording::{FileReport, ImageReader};
use insd_engine::Engine;

use crate::commands::SensorOutage;

/// The messages of a camera, in the order in which they are received.
#[derive(Default)]
pub(crate) struct CameraVoyage {
    images: Option<ImageReader>,
    last: Option<Time>,
}

impl CameraVoyage {
    /// Opens what a camera has left of a voyage.
    ///
    /// # Errors
    /// A file that is there cannot be read.
    pub(crate) fn open(dir: &Path) -> anyhow::Result<Self> {
        Ok(CameraVoyage { images: ImageReader::open(dir)?, last: None })
    }

    /// What is received next, if that is up to an instant.
    fn next_until(&mut self, receipt: Time) -> anyhow::Result<Option<Received>> {
        let Some(images) = &mut self.images else { return Ok(None) };
        if images.time().is_none_or(|time| time > receipt) {
            return Ok(None);
        }
        let Some(frame) = images.next_frame()? else { return Ok(None) };
        let receipt = self.last.map_or(frame.time, |last| last.max(frame.time));
        self.last = Some(receipt);
        let message = Message::Camera(Arc::new(frame));
        Ok(Some(Received { receipt, source: Source::Camera(0), message }))
    }

    /// Passes on what is received up to an instant, but for outages; returns how many messages these drop.
    ///
    /// # Errors
    /// A file cannot be read on.
    pub(crate) fn pass_on(
        &mut self,
        receipt: Time,
        engine: &mut Engine,
        outages: &[SensorOutage],
    ) -> anyhow::Result<u64> {
        let mut dropped = 0;
        while let Some(image) = self.next_until(receipt)? {
            if outages.iter().any(|outage| outage.drops(&image)) {
                dropped += 1;
            } else {
                engine.handle(&image);
            }
        }
        Ok(dropped)
    }

    /// What was read and skipped.
    pub(crate) fn report(&self) -> Option<&FileReport> {
        self.images.as_ref().map(ImageReader::report)
    }
}
