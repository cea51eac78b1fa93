//! `insd run`: the daemon.

use std::path::PathBuf;

use insd_config::{BadInput, Config, Severity, check};

use crate::logging::Log;
use crate::run::{self, RunOptions};

/// Options of `insd run`.
#[derive(Clone, Debug, clap::Args)]
pub struct RunArgs {
    /// Configuration file
    #[arg(long, value_name = "FILE", default_value = "/etc/insd/insd.toml")]
    config: PathBuf,
    /// Also write the solutions to a file, as a replay would
    #[arg(long, value_name = "NAV.csv")]
    nav: Option<PathBuf>,
    /// Stop after so many seconds
    #[arg(long, value_name = "S")]
    seconds: Option<f64>,
}

/// Runs the command until it is told to stop.
///
/// # Errors
/// The configuration has faults, or something that is needed at the start cannot be had.
pub fn run(args: &RunArgs, log: &Log) -> anyhow::Result<()> {
    let (config, text) = Config::load(&args.config)?;
    if !log.is_told_by_environment {
        log.set(&config.log.level).map_err(BadInput)?;
    }
    for finding in check::examine(&text).findings {
        if finding.severity == Severity::Warning || finding.severity == Severity::Error {
            tracing::warn!(cause = finding.cause, "configuration: {finding}");
        }
    }
    let options = RunOptions {
        nav: args.nav.clone(),
        seconds: args.seconds,
        config: Some(args.config.clone()),
    };
    run::run(&config, &text, &options, log)
}
