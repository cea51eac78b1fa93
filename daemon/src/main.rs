//! The program: parses the command line, runs one command, turns its outcome into an exit status.

use std::io::{self, IsTerminal};
use std::process::ExitCode;

use clap::Parser;
use insd::cli::Cli;
use tracing_subscriber::EnvFilter;

fn main() -> ExitCode {
    let cli = Cli::parse();
    let filter =
        EnvFilter::try_from_default_env().unwrap_or_else(|_| EnvFilter::new(cli.log_level()));
    tracing_subscriber::fmt()
        .with_env_filter(filter)
        .with_ansi(io::stderr().is_terminal())
        .with_writer(io::stderr)
        .init();
    match cli.run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(fault) => {
            eprintln!("insd: {fault:#}");
            insd::cli::exit_code(&fault)
        }
    }
}
