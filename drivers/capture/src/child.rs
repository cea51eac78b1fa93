//! Images through the pipe of a child process that writes raw grey ones one after the other: `gst-launch-1.0 ... ! fdsink fd=1`.

use std::io::{self, Read};
use std::process::{Command, Stdio};

use insd_base::Time;

use crate::fault::CaptureFault;
use crate::folder::TimedImage;
use crate::live::{Hand, LiveCamera};

/// A child process and what it writes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PipedSource {
    /// The program and its arguments.
    pub command: Vec<String>,
    /// Width and height of the images that it writes, px.
    pub size: [u32; 2],
}

/// Starts a child process. A pipe tells no times: images are stamped by `now` when the last of their bytes has come.
///
/// # Errors
/// The program cannot be started, or the size is none.
pub fn start_child(
    source: &PipedSource,
    now: impl Fn() -> Time + Send + 'static,
) -> Result<LiveCamera, CaptureFault> {
    let place = source.command.join(" ");
    let bytes = source.size.iter().try_fold(1_usize, |all, side| all.checked_mul(*side as usize));
    let (Some((program, arguments)), Some(bytes @ 1..)) = (source.command.split_first(), bytes)
    else {
        let reason = "wants a command and a size".to_owned();
        return Err(CaptureFault::Source { place, reason });
    };
    let mut child = Command::new(program);
    child.args(arguments).stdin(Stdio::null()).stdout(Stdio::piped());
    let mut child = child.spawn().map_err(|fault| CaptureFault::io(&place, fault))?;
    let (size, pipe) = (source.size, child.stdout.take());
    let camera = LiveCamera::start(&place, move |hand| {
        if let Some(pipe) = pipe {
            hand_over(pipe, size, bytes, now, hand);
        }
    })?;
    Ok(camera.with_child(child))
}

fn hand_over(
    mut pipe: impl Read,
    size: [u32; 2],
    bytes: usize,
    now: impl Fn() -> Time,
    hand: &Hand,
) {
    loop {
        let mut pixels = vec![0; bytes];
        let filled = fill(&mut pipe, &mut pixels);
        let is_last = filled < bytes;
        // what is left when the pipe ends is handed on torn, so that it is counted
        pixels.truncate(filled);
        if filled > 0 && !hand.over(TimedImage { time: now(), size, pixels }) || is_last {
            return;
        }
    }
}

/// How many bytes came before the pipe ended or broke.
fn fill(pipe: &mut impl Read, buffer: &mut [u8]) -> usize {
    let mut filled = 0;
    while filled < buffer.len() {
        match pipe.read(&mut buffer[filled..]) {
            Ok(0) => break,
            Ok(count) => filled += count,
            Err(fault) if fault.kind() == io::ErrorKind::Interrupted => {}
            Err(_) => break,
        }
    }
    filled
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    const PATIENCE: Duration = Duration::from_secs(10);

    fn start(script: &str) -> LiveCamera {
        let command = ["sh", "-c", script].map(str::to_owned).to_vec();
        start_child(&PipedSource { command, size: [4, 2] }, || Time::from_seconds(1.0)).unwrap()
    }

    #[test]
    fn images_are_cut_from_the_pipe_and_the_rest_comes_torn() {
        let camera = start("printf 'aaaaaaaabbbbbbbbccc'");
        let mut images = Vec::new();
        while let Ok(image) = camera.next(PATIENCE) {
            images.extend(image);
        }
        let lengths: Vec<usize> = images.iter().map(|image| image.pixels.len()).collect();
        // two wait at most; how many were dropped depends on who was faster
        assert_eq!(lengths.len() + camera.dropped() as usize, 3);
        assert_eq!(
            (images[0].pixels.as_slice(), images[0].time),
            (&b"aaaaaaaa"[..], Time::from_seconds(1.0))
        );
    }

    #[test]
    fn a_camera_that_hangs_delays_nobody() {
        let camera = start("printf 'aaaaaaaa'; exec sleep 1000");
        assert!(camera.next(PATIENCE).unwrap().is_some());
        assert_eq!(camera.next(Duration::from_millis(20)).unwrap(), None);
    }

    #[test]
    fn a_program_that_is_not_there_is_told() {
        let command = vec!["no-such-program-of-a-camera".to_owned()];
        let told = start_child(&PipedSource { command, size: [4, 2] }, || Time::START).unwrap_err();
        assert!(told.to_string().starts_with("no-such-program-of-a-camera: "), "{told}");
        let empty = PipedSource { command: vec!["true".to_owned()], size: [0, 2] };
        assert!(start_child(&empty, || Time::START).is_err());
    }
}
