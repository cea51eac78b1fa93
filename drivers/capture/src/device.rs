//! A camera of V4L2: `/dev/video0`.

use std::io;
use std::path::Path;

use insd_base::Time;
use linuxvideo::format::{PixFormat, PixelFormat};
use linuxvideo::stream::ReadStream;
use linuxvideo::{BufType, Device};

use crate::fault::CaptureFault;
use crate::folder::TimedImage;
use crate::live::{Hand, LiveCamera};

/// Formats that are understood, best first, and after how many bytes the next pixel's luminance comes.
const FORMATS: [(PixelFormat, usize); 2] =
    [(PixelFormat::from_fourcc(*b"GREY"), 1), (PixelFormat::YUYV, 2)];

/// Starts a camera that gives `GREY` or `YUYV`, of which the luminance is taken.
///
/// Images are stamped by `now` when the driver hands them over: the stamps of the kernel are not given on by `linuxvideo` 0.3.5. Exposure
/// and transfer come before that, by the same time for each image, which is what the filter's delay of the camera is for.
///
/// # Errors
/// The device cannot be opened, gives other images, or not of this size.
pub fn start_device(
    path: &Path,
    size: [u32; 2],
    now: impl Fn() -> Time + Send + 'static,
) -> Result<LiveCamera, CaptureFault> {
    let (mut stream, stride) = open(path, size)?;
    LiveCamera::start(&path.display().to_string(), move |hand| {
        let image = |pixels| TimedImage { time: now(), size, pixels };
        while luminance(&mut stream, stride, &image, hand).unwrap_or(false) {}
    })
}

fn open(path: &Path, size: [u32; 2]) -> Result<(ReadStream, usize), CaptureFault> {
    let io = |fault: io::Error| CaptureFault::io(&path.display(), fault);
    let source =
        |reason: String| CaptureFault::Source { place: path.display().to_string(), reason };
    let device = Device::open(path).map_err(io)?;
    let gives = |format: PixelFormat| {
        device.formats(BufType::VIDEO_CAPTURE).any(|f| f.is_ok_and(|f| f.pixel_format() == format))
    };
    let chosen = FORMATS.into_iter().find(|(format, _)| gives(*format));
    let (format, stride) =
        chosen.ok_or_else(|| source("gives neither GREY nor YUYV".to_owned()))?;
    let capture = device.video_capture(PixFormat::new(size[0], size[1], format)).map_err(io)?;
    let given = [capture.format().width(), capture.format().height()];
    if given != size || capture.format().pixel_format() != format {
        return Err(source(format!(
            "gives {} x {} px, not {} x {}",
            given[0], given[1], size[0], size[1]
        )));
    }
    Ok((capture.into_stream().map_err(io)?, stride))
}

/// Waits for one image and hands it over; whether more are wanted.
fn luminance(
    stream: &mut ReadStream,
    stride: usize,
    image: &impl Fn(Vec<u8>) -> TimedImage,
    hand: &Hand,
) -> io::Result<bool> {
    stream.dequeue(|buffer| {
        // one that the driver calls damaged comes torn, so that it is counted
        let whole = if buffer.is_error() { &[] } else { &buffer[..] };
        Ok(hand.over(image(whole.iter().step_by(stride).copied().collect())))
    })
}
