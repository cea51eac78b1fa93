//! A solution for other programs: of `nav.csv`, or of a voyage or recording that is replayed for it.

use std::path::Path;

use insd_base::{Message, Received};
use insd_config::{BadInput, VoyageCalendar};
use insd_drivers::recording::{NavRow, VoyageReader, read_header, read_nav_rows};

use super::args::ConvertArgs;
use super::start::start_utc;
use crate::commands::options;
use crate::commands::replay::{self, ReplayOptions};
use crate::export::{self, Format, ImuTrack, NoUtc, SolutionTrack};
use crate::raw_run::{RawRun, is_recording};

/// Writes it, and tells in a line what was written.
pub(super) fn write(args: &ConvertArgs, format: Format, out: &Path) -> anyhow::Result<String> {
    let calendar = calendar(args)?;
    if matches!(format, Format::Mcap | Format::Ros2bag) && calendar.is_none() {
        return Err(BadInput(NoUtc.to_string()).into());
    }
    let mut rows = rows(args)?;
    rows.sort_by_key(|row| row.solution.time);
    let name = args.recording.file_stem().unwrap_or(args.recording.as_os_str()).to_string_lossy();
    let imu = if args.imu { Some(imu(args, format)?) } else { None };
    let imu = imu.as_ref();
    export::write(&SolutionTrack { name: &name, rows: &rows, calendar, imu }, format, out)?;
    let samples = imu.map_or(String::new(), |imu| format!(" and {} samples of the IMU", imu.len()));
    Ok(format!("{} rows{samples} in {}\n", rows.len(), out.display()))
}

/// What the IMU of a voyage or recording measured.
fn imu(args: &ConvertArgs, format: Format) -> anyhow::Result<ImuTrack> {
    let recording = &args.recording;
    if !matches!(format, Format::Mcap | Format::Ros2bag) || is_nav(recording) {
        let hint = "--imu is for a voyage or recording and --to mcap or ros2bag";
        return Err(BadInput(hint.to_owned()).into());
    }
    let mut samples = Vec::new();
    let mut take = |received: Received| {
        if let Message::Imu(sample) = received.message {
            samples.push(sample);
        }
    };
    if recording.join("voyage.toml").exists() {
        let rate = read_header(recording)?.imu.rate;
        for received in VoyageReader::open(recording)? {
            take(received?);
        }
        return Ok(ImuTrack::new(samples, rate));
    }
    let mut raw = RawRun::open(recording, args.config.as_deref(), args.run)?;
    let rate = raw.config.engine().imu.rate;
    raw.hear(|_, _| {}, take)?;
    Ok(ImuTrack::new(samples, rate))
}

fn rows(args: &ConvertArgs) -> anyhow::Result<Vec<NavRow>> {
    if is_nav(&args.recording) {
        return Ok(read_nav_rows(&args.recording)?.rows);
    }
    let mut words = vec![format!("--run={}", args.run)];
    words.extend(args.config.as_ref().map(|file| format!("--config={}", file.display())));
    words.extend(["--".to_owned(), args.recording.display().to_string()]);
    Ok(replay::rows(&options::<ReplayOptions>(&words)?)?.rows.rows)
}

/// Whether it is a solution already.
fn is_nav(path: &Path) -> bool {
    path.is_file() && !is_recording(path)
}

/// UTC of the start, as it is given or as the voyage or recording tells it.
fn calendar(args: &ConvertArgs) -> anyhow::Result<Option<VoyageCalendar>> {
    let start = match &args.start_utc {
        Some(given) => Some(given.clone()),
        None if is_nav(&args.recording) => None,
        None if args.recording.join("voyage.toml").exists() => {
            Some(read_header(&args.recording)?.start_utc)
        }
        None => {
            let mut raw = RawRun::open(&args.recording, args.config.as_deref(), args.run)?;
            let intake = raw.hear(|_, _| {}, |_| {})?;
            start_utc(&intake)?
        }
    };
    let read = |text: &String| {
        let expected = "expected an instant of RFC 3339, for example 2026-05-01T08:00:00Z";
        VoyageCalendar::new(text).ok_or_else(|| BadInput(format!("{text}: {expected}")))
    };
    Ok(start.as_ref().map(read).transpose()?)
}
