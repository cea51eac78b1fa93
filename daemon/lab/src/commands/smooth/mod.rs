//! `insd smooth`: a recording through the same engine as `insd replay`, and back again.

mod afterwards;
mod sbet;

use std::path::PathBuf;

use super::replay::{self, ReplayArgs, Tell};
pub(super) use afterwards::Afterwards;

/// Options of `insd smooth`: those of a replay, and a few.
#[derive(Clone, Debug, clap::Args)]
pub struct SmoothArgs {
    #[command(flatten)]
    replay: ReplayArgs,
    /// Also write the smoothed trajectory as surveyors' programs read it: radians, and acceleration and rates beside
    #[arg(long, value_name = "FILE.csv")]
    sbet: Option<PathBuf>,
    /// Interval between instants that are smoothed by themselves, s; in between is interpolated. A longer one takes less memory
    #[arg(long, value_name = "SECONDS", default_value_t = 1.0, value_parser = interval)]
    interval: f64,
}

/// Runs the command. What it writes is a function of the recording and the options alone.
///
/// # Errors
/// The recording cannot be read or the output not written.
pub fn run(args: &SmoothArgs, tell: Tell) -> anyhow::Result<()> {
    let afterwards = Afterwards::new(args.interval, args.sbet.clone());
    replay::run_and_smooth(&args.replay, tell, afterwards)
}

fn interval(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(interval) if (0.1..=60.0).contains(&interval) => Ok(interval),
        _ => Err("expected a number from 0.1 to 60 s".to_owned()),
    }
}
