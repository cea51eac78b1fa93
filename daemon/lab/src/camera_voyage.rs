//! The camera of a voyage directory on its way into the engine.

use std::path::Path;
use std::sync::Arc;

use insd_base::{Message, Received, Source, Time};
use insd_config::BadInput;
use insd_drivers::recording::{FileReport, ImageReader, RecordingError, StepReader};
use insd_engine::Engine;

use crate::commands::SensorOutage;

/// What is made of a camera.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum CameraWay {
    /// Tracks of points, from `features.csv`.
    #[default]
    Tracks,
    /// How it moved from image to image, by a visual odometry of another's making, from `vo.csv`: the berthing source's own method, beside which
    /// ours is held.
    Increments,
}

/// The messages of a camera, in the order in which they are received.
#[derive(Default)]
pub(crate) struct CameraVoyage {
    seen: Option<Reader>,
    last: Option<Time>,
}

/// What a camera has left.
enum Reader {
    Images(ImageReader),
    Steps(StepReader),
}

impl Reader {
    fn time(&self) -> Option<Time> {
        match self {
            Reader::Images(images) => images.time(),
            Reader::Steps(steps) => steps.time(),
        }
    }

    fn next_message(&mut self) -> Result<Option<Message>, RecordingError> {
        Ok(match self {
            Reader::Images(images) => {
                images.next_frame()?.map(|frame| Message::Camera(Arc::new(frame)))
            }
            Reader::Steps(steps) => steps.next_step()?.map(Message::Odometry),
        })
    }
}

impl CameraVoyage {
    /// Opens what a camera has left of a voyage.
    ///
    /// # Errors
    /// A file that is there cannot be read, or one that is asked for is not there.
    pub(crate) fn open(dir: &Path, way: CameraWay) -> anyhow::Result<Self> {
        let seen = match way {
            CameraWay::Tracks => ImageReader::open(dir)?.map(Reader::Images),
            CameraWay::Increments => {
                let steps = StepReader::open(dir)?.ok_or_else(|| {
                    let dir = dir.display();
                    BadInput(format!("{dir}: no vo.csv, which --camera increments needs"))
                })?;
                Some(Reader::Steps(steps))
            }
        };
        Ok(CameraVoyage { seen, last: None })
    }

    /// What is received next, if that is up to an instant.
    fn next_until(&mut self, receipt: Time) -> anyhow::Result<Option<Received>> {
        let Some(seen) = &mut self.seen else { return Ok(None) };
        if seen.time().is_none_or(|time| time > receipt) {
            return Ok(None);
        }
        let Some(message) = seen.next_message()? else { return Ok(None) };
        let receipt = self.last.map_or(message.time(), |last| last.max(message.time()));
        self.last = Some(receipt);
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
        while let Some(received) = self.next_until(receipt)? {
            if outages.iter().any(|outage| outage.drops(&received)) {
                dropped += 1;
            } else {
                engine.handle(&received);
            }
        }
        Ok(dropped)
    }

    /// What was read and skipped.
    pub(crate) fn report(&self) -> Option<&FileReport> {
        self.seen.as_ref().map(|seen| match seen {
            Reader::Images(images) => images.report(),
            Reader::Steps(steps) => steps.report(),
        })
    }
}
