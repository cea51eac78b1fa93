//! The program: parses the command line, runs one command, turns its outcome into an exit status.

use std::process::ExitCode;

use clap::Parser;
use insd::cli::Cli;
use insd::logging::Log;

fn main() -> ExitCode {
    let cli = Cli::parse();
    let log = Log::start(cli.log_level());
    match cli.run(&log) {
        Ok(()) => ExitCode::SUCCESS,
        Err(fault) if insd::cli::is_enough(&fault) => ExitCode::SUCCESS,
        Err(fault) => {
            eprintln!("insd: {fault:#}");
            insd::cli::exit_code(&fault)
        }
    }
}
