//! The voyage that the simulated ship makes.

use std::path::Path;

use insd_base::{CameraFrame, Message, Stamped, Time, Voyage};
use insd_drivers::recording::{ImageReader, VoyageReader, read_truth};
use insd_simulator::{Override, footage, simulate};

use crate::scenario;

/// What a ship measures, and what her camera sees.
pub(super) struct Found {
    pub(super) voyage: Voyage,
    /// In order of time; none without a camera.
    pub(super) frames: Vec<CameraFrame>,
}

/// A voyage directory, or a voyage of a scenario; what her camera sees is long in the making, and there only if it `is_filmed`.
pub(super) fn find(
    word: &str,
    seed: u64,
    sets: &[Override],
    is_filmed: bool,
) -> anyhow::Result<Found> {
    let path = Path::new(word);
    if path.is_dir() {
        let frames = if is_filmed { read_images(path)? } else { Vec::new() };
        return Ok(Found { voyage: read(path)?, frames });
    }
    let scenario = scenario::find(word, sets)?.scenario;
    let footage = is_filmed.then(|| footage(&scenario, seed)).flatten();
    let frames = footage.map(|own| own.frames).unwrap_or_default();
    Ok(Found { voyage: simulate(&scenario, seed), frames })
}

fn read_images(dir: &Path) -> anyhow::Result<Vec<CameraFrame>> {
    let mut frames = Vec::new();
    if let Some(mut images) = ImageReader::open(dir)? {
        while let Some(frame) = images.next_frame()? {
            frames.push(frame);
        }
    }
    Ok(frames)
}

fn read(dir: &Path) -> anyhow::Result<Voyage> {
    let mut reader = VoyageReader::open(dir)?;
    let header = reader.header().clone();
    let has_truth = ["truth.csv", "truth.csv.zst"].iter().any(|name| dir.join(name).exists());
    let mut voyage = Voyage {
        header,
        imu: Vec::new(),
        gnss: Vec::new(),
        log: Vec::new(),
        reference: Vec::new(),
        truth: if has_truth { read_truth(&dir.join("truth.csv"))? } else { Vec::new() },
    };
    for received in &mut reader {
        match received?.message {
            Message::Imu(own) => voyage.imu.push(Stamped::prompt(own)),
            Message::Gnss(own) => voyage.gnss.push(Stamped::prompt(own)),
            Message::Log(own) => voyage.log.push(Stamped::prompt(own)),
            Message::Reference(own) => voyage.reference.push(Stamped::prompt(own)),
            // no file of a voyage holds them
            Message::Ranges(_) | Message::Base(_) | Message::Rtk(_) => {}
            Message::Compass(_) | Message::Ranging(_) => {}
            Message::Camera(_) | Message::Odometry(_) => {}
        }
    }
    Ok(voyage)
}

/// When the IMU falls silent.
pub(super) fn end(voyage: &Voyage) -> Time {
    voyage.imu.last().map_or(Time::START, |last| last.message.time)
}

/// The images from an instant on and before another.
pub(super) fn images(frames: &[CameraFrame], from: Time, to: Time) -> &[CameraFrame] {
    part(frames, |own| own.time, from, to)
}

fn part<T>(all: &[T], time: impl Fn(&T) -> Time, from: Time, to: Time) -> &[T] {
    let first = all.partition_point(|own| time(own) < from);
    let end = all.partition_point(|own| time(own) < to);
    all.get(first..end).unwrap_or_default()
}

/// What is measured from an instant on and before another.
pub(super) fn window(voyage: &Voyage, from: Time, to: Time) -> Voyage {
    Voyage {
        header: voyage.header.clone(),
        imu: part(&voyage.imu, |own| own.message.time, from, to).to_vec(),
        gnss: part(&voyage.gnss, |own| own.message.time, from, to).to_vec(),
        log: part(&voyage.log, |own| own.message.time, from, to).to_vec(),
        reference: part(&voyage.reference, |own| own.message.time, from, to).to_vec(),
        truth: part(&voyage.truth, |own| own.time, from, to).to_vec(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn windows_together_are_the_voyage() {
        let scenario = scenario::find("01", &[]).unwrap().scenario.with_duration(3.0);
        let voyage = simulate(&scenario, 1);
        let at = Time::from_seconds;
        let parts = [(0.0, 1.25), (1.25, 2.5), (2.5, 9.0)];
        let windows = parts.map(|(from, to)| window(&voyage, at(from), at(to)));
        let imu: Vec<_> = windows.iter().flat_map(|part| part.imu.clone()).collect();
        let log: Vec<_> = windows.iter().flat_map(|part| part.log.clone()).collect();
        assert!(imu == voyage.imu && log == voyage.log);
        assert_eq!(end(&voyage), voyage.imu.last().unwrap().message.time);
    }
}
