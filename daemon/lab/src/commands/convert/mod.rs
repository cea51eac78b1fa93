//! `insd convert`: a voyage directory, or files of RINEX, out of a raw recording; a solution in the formats of other programs.

mod args;
mod raw;
mod solution;
mod start;

use std::path::Path;

use anyhow::Context as _;
use insd_base::{Arrival, Message, Received, Stamped, Voyage, VoyageHeader};
use insd_config::BadInput;
use insd_drivers::recording::{Compression, write_raw, write_voyage};
use insd_intake::Intake;
use insd_rinex::{write_navigation, write_observations};

pub use self::args::ConvertArgs;
use self::start::start_utc;
use crate::raw_receivers::{RawReceiver, RawReceivers};
use crate::raw_run::RawRun;

/// Runs the command. Times in the voyage are those of the ship's time line, whose start in UTC is what was
/// known at the end; each row has its time of receipt. Times in RINEX are those of the receiver's own clock.
///
/// # Errors
/// The recording cannot be read, UTC never became known in it, no receiver sent raw messages and RINEX is wanted, or the files cannot be written.
pub fn run(args: &ConvertArgs) -> anyhow::Result<()> {
    eprint!("{}", write(args)?);
    Ok(())
}

/// Does what the command is asked for, and tells in lines what was written.
///
/// # Errors
/// As [`run`].
pub fn write(args: &ConvertArgs) -> anyhow::Result<String> {
    if let (Some(format), Some(out)) = (args.to, &args.out) {
        return solution::write(args, format, out);
    }
    let mut raw = RawRun::open(&args.recording, args.config.as_deref(), args.run)?;
    let mut receivers = RawReceivers::new(&raw.config.intake());
    let mut measured = Vec::new();
    let arrived = |arrival: &Arrival, intake: &Intake| {
        let utc = intake.utc_at(arrival.stamp.monotonic);
        receivers.take(arrival, Some(utc.unwrap_or(arrival.stamp.system).to_gps()));
    };
    let intake = raw.hear(arrived, |received| {
        if args.out.is_some() {
            measured.push(received);
        }
    })?;
    let mut told = String::new();
    if let Some(folder) = &args.rinex {
        told.push_str(&rinex(&receivers, folder, &args.recording)?);
    }
    if let Some(out) = &args.out {
        let antennas = raw::antennas(receivers.told());
        voyage(args, &raw, &intake, &measured, out, &antennas)?;
        told.push_str(&summary(&measured, &antennas));
    }
    Ok(told)
}

/// Writes the files of each receiver.
fn rinex(receivers: &RawReceivers, folder: &Path, recording: &Path) -> anyhow::Result<String> {
    let told: Vec<&RawReceiver> = receivers.told().collect();
    if told.is_empty() {
        let what = "no receiver sent raw messages";
        return Err(BadInput(format!("{}: {what}", recording.display())).into());
    }
    let fault = |path: &Path| format!("{}: cannot be written", path.display());
    std::fs::create_dir_all(folder).with_context(|| fault(folder))?;
    let mut lines = String::new();
    for own in told {
        let name = plain(&own.name);
        let models: Vec<_> = own.ionosphere.iter().map(|(whose, own)| (*whose, *own)).collect();
        let texts = [
            ("obs", write_observations(&own.header(), &own.epochs)),
            ("nav", write_navigation(&own.records, &models, own.leap_seconds)),
        ];
        for (extension, text) in texts {
            let path = folder.join(format!("{name}.{extension}"));
            std::fs::write(&path, text).with_context(|| fault(&path))?;
        }
        let (epochs, records) = (own.epochs.len(), own.records.len());
        lines.push_str(&format!(
            "{}: {epochs} epochs, {records} orbits, {} refused\n",
            own.name, own.refused
        ));
    }
    Ok(lines)
}

/// A name that is one of a file.
fn plain(name: &str) -> String {
    let good = |c: char| if c.is_ascii_alphanumeric() || "-_".contains(c) { c } else { '-' };
    name.chars().map(good).collect()
}

fn voyage(
    args: &ConvertArgs,
    raw: &RawRun,
    intake: &Intake,
    measured: &[Received],
    out: &Path,
    antennas: &[&RawReceiver],
) -> anyhow::Result<()> {
    let Some(start_utc) = start_utc(intake)? else {
        let what = "UTC never became known: no receiver told the time";
        return Err(BadInput(format!("{}: {what}", args.recording.display())).into());
    };
    let engine = raw.config.engine();
    let files = raw::files(antennas, engine.lever_arms.gnss, measured)?;
    let mut lever_arms = engine.lever_arms;
    // that of the first antenna, where there is raw GNSS
    lever_arms.gnss = antennas.first().and_then(|own| own.lever).unwrap_or(lever_arms.gnss);
    let mut voyage = Voyage {
        header: VoyageHeader {
            start_utc,
            start: engine.start,
            initial: engine.initial,
            imu: engine.imu,
            lever_arms,
            vessel: engine.vessel,
            time_std: engine.time_std,
        },
        imu: Vec::new(),
        gnss: Vec::new(),
        log: Vec::new(),
        reference: Vec::new(),
        truth: Vec::new(),
    };
    for received in measured {
        enter(&mut voyage, received);
    }
    sort(&mut voyage);
    write_voyage(out, &voyage, Compression::Zstd)?;
    let files = Some(&files).filter(|_| !antennas.is_empty());
    Ok(write_raw(out, files, Compression::Zstd)?)
}

/// What was written, in lines.
fn summary(measured: &[Received], antennas: &[&RawReceiver]) -> String {
    let count = |is_one: fn(&Message) -> bool| {
        measured.iter().filter(|received| is_one(&received.message)).count()
    };
    let mut lines = format!(
        "{} IMU samples, {} fixes, {} log velocities, {} references\n",
        count(|message| matches!(message, Message::Imu(_))),
        count(|message| matches!(message, Message::Gnss(fix) if fix.rank == 0)),
        count(|message| matches!(message, Message::Log(_))),
        count(|message| matches!(message, Message::Reference(_))),
    );
    for (own, number) in antennas.iter().zip(1..) {
        let (epochs, orbits) = (own.epochs.len(), own.records.len());
        lines.push_str(&format!(
            "raw/a{number}.obs: {}, {epochs} epochs, {orbits} orbits\n",
            own.name
        ));
    }
    let of_base = raw::of_base(measured);
    if let Some(first) = of_base.first().filter(|_| !antennas.is_empty()) {
        let moves = if first.is_moving { ", which moves" } else { "" };
        lines.push_str(&format!("raw/base.obs: {} epochs of a base{moves}\n", of_base.len()));
    }
    lines
}

fn enter(voyage: &mut Voyage, received: &Received) {
    let arrival = Some(received.receipt);
    match &received.message {
        Message::Imu(message) => voyage.imu.push(Stamped { message: *message, arrival }),
        // a voyage directory holds one receiver
        Message::Gnss(message) if message.rank > 0 => {}
        // made of raw data, which are kept as such; and no file of a voyage holds docking aids
        Message::Ranges(_) | Message::Base(_) | Message::Rtk(_) => {}
        Message::Compass(_) | Message::Ranging(_) => {}
        Message::Camera(_) | Message::Odometry(_) => {}
        Message::Gnss(message) => voyage.gnss.push(Stamped { message: *message, arrival }),
        Message::Log(message) => voyage.log.push(Stamped { message: *message, arrival }),
        Message::Reference(message) => {
            voyage.reference.push(Stamped { message: *message, arrival });
        }
    }
}

/// A voyage's rows are in order of validity, whatever order they came in.
fn sort(voyage: &mut Voyage) {
    voyage.imu.sort_by_key(|row| row.message.time);
    voyage.gnss.sort_by_key(|row| row.message.time);
    voyage.log.sort_by_key(|row| row.message.time);
    voyage.reference.sort_by_key(|row| row.message.time);
}
