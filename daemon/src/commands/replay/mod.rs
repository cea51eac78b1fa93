//! `insd replay`: a recorded voyage through the same engine as the daemon, without a clock.

mod recording;
mod sent;
mod sink;
mod voyage;

use std::path::PathBuf;

use super::alignment::AlignmentArgs;
use super::outage::SensorOutage;
use crate::cli::BadInput;

/// Options of `insd replay`.
#[derive(Clone, Debug, clap::Args)]
pub struct ReplayArgs {
    /// Voyage directory, or a raw recording: one of its files, or its folder
    dir: PathBuf,
    /// File to write the solution to
    #[arg(long, value_name = "NAV.csv")]
    out: PathBuf,
    /// Solutions per second [default: 10; of a raw recording, those of its configuration]
    #[arg(long, value_name = "HZ", value_parser = super::rate)]
    rate: Option<f64>,
    /// For a raw recording: another configuration than the one it was made with. For a voyage: where
    /// the ports for --sent are
    #[arg(long, value_name = "FILE")]
    config: Option<PathBuf>,
    /// Also write what each port is sent, to NAME.sent, and what is known at its epochs, to epochs.csv
    #[arg(long, value_name = "FOLDER")]
    sent: Option<PathBuf>,
    /// For a raw recording that spans restarts of the program: which run, from 1
    #[arg(long, value_name = "N", default_value_t = 1)]
    run: u32,
    /// Take a sensor (imu, gnss, log, reference) away while FROM <= t_s < TO; may be repeated
    #[arg(long = "outage", value_name = "SENSOR:FROM..TO")]
    outages: Vec<SensorOutage>,
    #[command(flatten)]
    alignment: AlignmentArgs,
    /// Start warm: the state stored at the last shutdown, believed once the sensors confirm it
    #[arg(long, value_name = "FILE")]
    stored_state: Option<PathBuf>,
    /// Store the state at the end for the next start, if the ship is aligned and lies at her berth
    #[arg(long, value_name = "FILE")]
    save_state: Option<PathBuf>,
    /// Also write the innovations of all aids
    #[arg(long, value_name = "FILE.csv")]
    innovations: Option<PathBuf>,
    /// Also write what the alignment says of itself: phase, sigmas, forecast, sea
    #[arg(long, value_name = "FILE.csv")]
    alignment_log: Option<PathBuf>,
}

/// Runs the command. What it writes is a function of the recording and the options alone.
///
/// # Errors
/// The recording cannot be read or the output not written.
pub fn run(args: &ReplayArgs) -> anyhow::Result<()> {
    if args.dir.join("voyage.toml").exists() || !crate::raw_run::is_recording(&args.dir) {
        return voyage::run(args);
    }
    let only_voyages =
        [("--outage", !args.outages.is_empty()), ("--save-state", args.save_state.is_some())];
    if let Some((option, _)) = only_voyages.iter().find(|(_, given)| *given) {
        let hint = "make a voyage of it with `insd convert` first";
        return Err(BadInput(format!("{option} is for voyage directories: {hint}")).into());
    }
    recording::run(args)
}
