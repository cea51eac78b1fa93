//! `insd convert`: a voyage directory out of a raw recording.

use std::path::PathBuf;

use insd_base::{Message, Received, Stamped, Time, Voyage, VoyageHeader};
use insd_config::BadInput;
use insd_drivers::recording::{Compression, write_voyage};
use insd_intake::{Intake, Intaken};

use crate::raw_run::RawRun;

/// Options of `insd convert`.
#[derive(Clone, Debug, clap::Args)]
pub struct ConvertArgs {
    /// Raw recording: one of its files, or its folder
    recording: PathBuf,
    /// Voyage directory to make
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Another configuration than the one it was made with
    #[arg(long, value_name = "FILE")]
    config: Option<PathBuf>,
    /// Of a recording that spans restarts of the program: which run, from 1
    #[arg(long, value_name = "N", default_value_t = 1)]
    run: u32,
}

/// Runs the command. Times in the voyage are those of the ship's time line, whose start in UTC is what was
/// known at the end; each row has its time of receipt.
///
/// # Errors
/// The recording cannot be read, UTC never became known in it, or the voyage cannot be written.
pub fn run(args: &ConvertArgs) -> anyhow::Result<()> {
    let mut raw = RawRun::open(&args.recording, args.config.as_deref(), args.run)?;
    let mut intake = Intake::new(&raw.config.intake());
    let mut measured = Vec::new();
    raw.for_each(|arrival| {
        intake.handle(arrival);
        while let Some(taken) = intake.poll_output() {
            if let Intaken::Measured(received) = taken {
                measured.push(received);
            }
        }
        Ok(())
    })?;
    let Some(start) = intake.utc_at(Time::START) else {
        let what = "UTC never became known: no receiver told the time";
        return Err(BadInput(format!("{}: {what}", args.recording.display())).into());
    };
    let engine = raw.config.engine();
    let mut voyage = Voyage {
        header: VoyageHeader {
            start_utc: jiff::Timestamp::from_nanosecond(start.as_nanos().into())?.to_string(),
            start: engine.start,
            initial: engine.initial,
            imu: engine.imu,
            lever_arms: engine.lever_arms,
            vessel: engine.vessel,
            time_std: engine.time_std,
        },
        imu: Vec::new(),
        gnss: Vec::new(),
        log: Vec::new(),
        reference: Vec::new(),
        truth: Vec::new(),
    };
    for received in &measured {
        enter(&mut voyage, received);
    }
    sort(&mut voyage);
    eprintln!(
        "{} IMU samples, {} fixes, {} log velocities, {} references",
        voyage.imu.len(),
        voyage.gnss.len(),
        voyage.log.len(),
        voyage.reference.len()
    );
    Ok(write_voyage(&args.out, &voyage, Compression::Zstd)?)
}

fn enter(voyage: &mut Voyage, received: &Received) {
    let arrival = Some(received.receipt);
    match &received.message {
        Message::Imu(message) => voyage.imu.push(Stamped { message: *message, arrival }),
        // a voyage directory holds one receiver
        Message::Gnss(message) if message.rank > 0 => {}
        // made of raw data, which are kept as such
        Message::Ranges(_) => {}
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
