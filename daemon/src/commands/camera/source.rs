//! Where images come from.

use std::os::unix::fs::FileTypeExt;
use std::path::PathBuf;
use std::time::Duration;

use insd_capture::{
    CaptureFault, ImageFolder, LiveCamera, PipedSource, TimedImage, on_one_core, start_child,
    start_device,
};
use insd_config::BadInput;
use insd_vision::{CameraCalibration, Hints, ImageCounts, Tracked};

use super::options::CameraOptions;

use crate::clock::{Clock, HostClock};

/// The camera's images.
#[derive(Clone, Debug, clap::Args)]
pub(super) struct SourceOptions {
    /// A folder with times.csv (t_s,file) and its pictures (PNG, PGM), or a device: /dev/video0
    #[arg(required_unless_present = "pipe")]
    source: Option<PathBuf>,
    /// A command that writes raw grey images to its standard output, as gst-launch-1.0 -q ... ! video/x-raw,format=GRAY8 ! fdsink
    #[arg(long, value_name = "COMMAND", conflicts_with = "source")]
    pipe: Option<String>,
    /// How long to look at a camera that lives, s
    #[arg(long, value_name = "S", default_value_t = 10.0)]
    seconds: f64,
}

/// How long a camera may be silent, at most, before it is looked at whether time is over.
const PATIENCE: Duration = Duration::from_millis(200);

impl SourceOptions {
    /// Hands over image by image; those that cannot be read are told. The number of images that nobody had time for.
    fn for_each(&self, size: [u32; 2], mut take: impl FnMut(TimedImage)) -> anyhow::Result<u64> {
        let host = HostClock::start();
        let now = move || host.now().monotonic;
        let live = match (&self.source, &self.pipe) {
            (None, None) => return Err(BadInput("no images named".to_owned()).into()),
            (_, Some(command)) => {
                let command = command.split_whitespace().map(str::to_owned).collect();
                start_child(&PipedSource { command, size }, now)?
            }
            (Some(path), None) if path.metadata().is_ok_and(|m| m.file_type().is_char_device()) => {
                start_device(path, size, now)?
            }
            (Some(path), None) => {
                let folder =
                    ImageFolder::open(path).map_err(|fault| BadInput(fault.to_string()))?;
                for image in folder {
                    image.map_or_else(|fault: CaptureFault| eprintln!("insd: {fault}"), &mut take);
                }
                return Ok(0);
            }
        };
        Ok(self.watch(&live, take))
    }

    /// Follows points from image to image; `seen` is given each image that was used. The images by what became of them, and the number of those that
    /// nobody had time for.
    pub(super) fn follow(
        &self,
        options: &CameraOptions,
        camera: &CameraCalibration,
        mut seen: impl FnMut(TimedImage, &Tracked, &Hints) + Send,
    ) -> anyhow::Result<(ImageCounts, u64)> {
        let mut eyes = options.front_end(camera)?;
        let attitudes = options.attitudes()?;
        let dropped = on_one_core(|| {
            self.for_each(camera.size, |image| {
                let hints = attitudes.hints(image.time, eyes.newest());
                if let Ok(tracked) = eyes.take(&image.picture(), &hints) {
                    seen(image, &tracked, &hints);
                }
            })
        })?;
        Ok((eyes.counts().clone(), dropped))
    }

    fn watch(&self, live: &LiveCamera, mut take: impl FnMut(TimedImage)) -> u64 {
        let clock = Clock::start();
        while clock.elapsed().as_secs_f64() < self.seconds {
            match live.next(PATIENCE) {
                Ok(image) => image.into_iter().for_each(&mut take),
                Err(_) => break,
            }
        }
        live.dropped()
    }
}
