//! `insd replay`: a recorded voyage through the same engine as the daemon, without a clock.

mod args;
mod recording;
mod sent;
mod sink;
mod sky_log;
mod states_log;
mod voyage;
mod without;

use insd_config::BadInput;

use super::smooth::Afterwards;

pub use args::{ReplayArgs, Tell};

/// Runs the command. What it writes is a function of the recording and the options alone.
///
/// # Errors
/// The recording cannot be read or the output not written.
pub fn run(args: &ReplayArgs, tell: Tell) -> anyhow::Result<()> {
    run_to_end(args, tell, None)
}

/// The same, and back again.
pub(super) fn run_and_smooth(
    args: &ReplayArgs,
    tell: Tell,
    afterwards: Afterwards,
) -> anyhow::Result<()> {
    run_to_end(args, tell, Some(afterwards))
}

fn run_to_end(args: &ReplayArgs, tell: Tell, afterwards: Option<Afterwards>) -> anyhow::Result<()> {
    if args.dir.join("voyage.toml").exists() || !crate::raw_run::is_recording(&args.dir) {
        return voyage::run(args, afterwards);
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
    recording::run(args, tell, afterwards)
}
