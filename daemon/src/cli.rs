//! The command line.

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use insd_drivers::recording::RecordingError;

use crate::commands::{campaign, evaluate, limit, replay, simulate};
use crate::demo;

/// Exit status when the input is to blame.
const BAD_INPUT: u8 = 2;
/// Exit status of all other failures.
const FAILURE: u8 = 1;

/// Inertial navigation for ships.
#[derive(Debug, Parser)]
#[command(version, about)]
pub struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Show a simulated ship navigating in real time, with NMEA on a pseudo terminal
    Demo(demo::DemoArgs),
    /// Make a voyage directory with truth from a scenario
    Simulate(simulate::SimulateArgs),
    /// Run a recorded voyage through the navigator
    Replay(replay::ReplayArgs),
    /// Compare a solution with truth
    Evaluate(evaluate::EvaluateArgs),
    /// Run a scenario with many seeds and score errors and claims
    Campaign(campaign::CampaignArgs),
    /// How well the optimal filter could do in a scenario
    Limit(limit::LimitArgs),
}

/// The input is to blame, not the machine: ends with exit status 2.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct BadInput(pub String);

impl Cli {
    /// Runs the command.
    ///
    /// # Errors
    /// Whatever the command meets; [`exit_code`] tells bad input from other failures.
    pub fn run(self) -> anyhow::Result<()> {
        match self.command {
            Command::Demo(args) => demo::run(args),
            Command::Simulate(args) => simulate::run(&args),
            Command::Replay(args) => replay::run(&args),
            Command::Evaluate(args) => evaluate::run(&args),
            Command::Campaign(args) => campaign::run(&args),
            Command::Limit(args) => limit::run(&args),
        }
    }
}

/// 2 for bad input, 1 for everything else.
#[must_use]
pub fn exit_code(fault: &anyhow::Error) -> ExitCode {
    let is_bad_input = fault.chain().any(|cause| {
        cause.is::<BadInput>()
            || cause.is::<csv::Error>()
            || cause.downcast_ref::<RecordingError>().is_some_and(is_about_input)
    });
    ExitCode::from(if is_bad_input { BAD_INPUT } else { FAILURE })
}

fn is_about_input(fault: &RecordingError) -> bool {
    !matches!(fault, RecordingError::Write { .. })
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_well_formed() {
        Cli::command().debug_assert();
    }
}
