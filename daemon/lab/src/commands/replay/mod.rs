//! `insd replay`: a recorded voyage through the same engine as the daemon, without a clock.

mod args;
mod destination;
mod recording;
mod sent;
mod sink;
mod sky_log;
mod states_log;
mod sums;
mod voyage;
mod without;

use insd_config::BadInput;

use super::smooth::Afterwards;

pub use args::{ReplayArgs, ReplayOptions, Tell};
pub(in crate::commands) use destination::Destination;
pub use destination::Replayed;
pub use sums::ReplaySums;
pub(in crate::commands) use sums::{Summed, Summing};

/// Runs the command. What it writes is a function of the recording and the options alone.
///
/// # Errors
/// The recording cannot be read or the output not written.
pub fn run(args: &ReplayArgs, tell: Tell) -> anyhow::Result<()> {
    let destination = Destination::file(&args.out)?;
    run_to_end(&args.options, tell, None, destination).map(drop)
}

/// The rows that the command would write, and what it would say.
///
/// # Errors
/// The recording cannot be read, or what else is to be written cannot be.
pub fn rows(options: &ReplayOptions) -> anyhow::Result<Replayed> {
    run_to_end(options, |_, _| {}, None, Destination::memory())
}

/// What the replay comes to in counts and sums, with its rows if they are to be kept.
pub(super) fn summed(
    options: &ReplayOptions,
    summing: Summing,
    keeps_rows: bool,
) -> anyhow::Result<Replayed> {
    run_to_end(options, |_, _| {}, None, Destination::summing(summing, keeps_rows))
}

/// A replay to a file, and back again.
pub(super) fn run_and_smooth(
    args: &ReplayArgs,
    tell: Tell,
    afterwards: Afterwards,
) -> anyhow::Result<()> {
    let destination = Destination::file(&args.out)?;
    run_to_end(&args.options, tell, Some(afterwards), destination).map(drop)
}

fn run_to_end(
    args: &ReplayOptions,
    tell: Tell,
    afterwards: Option<Afterwards>,
    destination: Destination,
) -> anyhow::Result<Replayed> {
    if args.dir.join("voyage.toml").exists() || !crate::raw_run::is_recording(&args.dir) {
        return voyage::run(args, afterwards, destination);
    }
    let only_voyages = [
        ("--outage", !args.outages.is_empty()),
        ("--without", !args.without.is_empty()),
        ("--log-model", args.log_model.is_some()),
        ("--save-state", args.save_state.is_some()),
    ];
    if let Some((option, _)) = only_voyages.iter().find(|(_, given)| *given) {
        let hint = "make a voyage of it with `insd convert` first";
        return Err(BadInput(format!("{option} is for voyage directories: {hint}")).into());
    }
    recording::run(args, tell, afterwards, destination)
}
