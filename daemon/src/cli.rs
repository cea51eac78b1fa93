//! The command line.

use std::io;
use std::process::ExitCode;
use std::sync::Arc;

use clap::{CommandFactory, Parser, Subcommand};
use insd_config::Config;
use insd_lab::blame;
use insd_lab::commands::{
    batch, campaign, convert, evaluate, feed, integrity, learn, limit, replay, report, simulate,
    smooth,
};
use insd_lab::demo;

use crate::clock::HostClock;
#[cfg(feature = "vision")]
use crate::commands::camera;
use crate::commands::{
    check_config, doctor, example_config, fleet, generate, monitor, ports, run, sniff,
};
use crate::logging::Log;
use crate::run::open_demo;

/// Exit status when the input is to blame.
const BAD_INPUT: u8 = 2;
/// Exit status of a solution that misled beyond the alert limit.
const HAZARDOUS: u8 = 3;
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
    /// Navigate: read the ship's sensors, feed her equipment
    Run(run::RunArgs),
    /// Show in this terminal what a running daemon's status page shows
    Monitor(monitor::MonitorArgs),
    /// Show a simulated ship navigating in real time, with NMEA on a pseudo terminal
    Demo(demo::DemoArgs),
    /// Make a voyage directory with truth from a scenario
    Simulate(simulate::SimulateArgs),
    /// Run a recorded voyage through the navigator
    Replay(replay::ReplayArgs),
    /// Run a recorded voyage through the navigator and back again: each instant with what was measured before and after it
    Smooth(smooth::SmoothArgs),
    /// Make one self-contained page of a recording: track, attitude, errors claimed, aids, alerts
    Report(report::ReportArgs),
    /// Make a voyage directory of a raw recording
    Convert(convert::ConvertArgs),
    /// Compare a solution with truth
    Evaluate(evaluate::EvaluateArgs),
    /// Compare errors with the protection levels that were told: Stanford chart and counts
    Integrity(integrity::IntegrityArgs),
    /// Run a scenario with many seeds and score errors and claims
    Campaign(campaign::CampaignArgs),
    /// Run an archive of voyages and raw recordings through the navigator: one line for each
    Batch(batch::BatchArgs),
    /// Learn from recorded voyages what repeats of the errors of log and IMU
    Learn(learn::LearnArgs),
    /// How well the optimal filter could do in a scenario
    Limit(limit::LimitArgs),
    /// Look for faults in a configuration: tells all of them, and what it amounts to
    CheckConfig(check_config::CheckConfigArgs),
    /// Look at a configuration and at this computer: devices, permissions, what arrives at each port
    Doctor(doctor::DoctorArgs),
    /// Print a commented configuration to start from
    ExampleConfig(example_config::ExampleConfigArgs),
    /// Be the sensors of a simulated ship, in real time, each on a pseudo terminal
    Feed(feed::FeedArgs),
    /// Ashore: take in what ships tell a broker, show all of them on one sheet, simulate a fleet
    #[command(subcommand)]
    Fleet(fleet::FleetCommand),
    /// List the ports of this computer, with the names to use in a configuration
    Ports(ports::PortsArgs),
    /// Listen to ports and tell what comes: formats, rates, damage, what may be wrong
    Sniff(sniff::SniffArgs),
    /// Look through a camera: how well points are followed, and tracks for a recording
    #[cfg(feature = "vision")]
    Camera(camera::CameraArgs),
    /// Write manual pages or completions for shells
    #[command(hide = true)]
    Generate(generate::GenerateArgs),
}

impl Cli {
    /// What is logged where the environment (`RUST_LOG`) says nothing: services tell what happens,
    /// the other commands only what is wrong.
    #[must_use]
    pub fn log_level(&self) -> &'static str {
        let is_service = matches!(self.command, Command::Run(_) | Command::Fleet(_));
        if is_service { "info" } else { "warn" }
    }

    /// Runs the command.
    ///
    /// # Errors
    /// Whatever the command meets; [`exit_code`] tells bad input from other failures.
    pub fn run(self, log: &Log) -> anyhow::Result<()> {
        match self.command {
            Command::Run(args) => run::run(&args, log),
            Command::Monitor(args) => monitor::run(&args),
            #[cfg(feature = "vision")]
            Command::Camera(args) => camera::run(&args),
            Command::Convert(args) => convert::run(&args),
            Command::Demo(args) => {
                let open = |config: &Config, text: &str| open_demo(config, text, log);
                demo::run(args, Arc::new(HostClock::start()), open)
            }
            Command::Simulate(args) => simulate::run(&args),
            Command::Replay(args) => replay::run(&args, crate::run::tell),
            Command::Smooth(args) => smooth::run(&args, crate::run::tell),
            Command::Report(args) => report::run(&args),
            Command::Evaluate(args) => evaluate::run(&args),
            Command::Integrity(args) => integrity::run(&args),
            Command::Campaign(args) => campaign::run(&args),
            Command::Batch(args) => batch::run(&args),
            Command::Learn(args) => learn::run(&args),
            Command::Limit(args) => limit::run(&args),
            Command::CheckConfig(args) => check_config::run(&args),
            Command::Doctor(args) => doctor::run(&args),
            Command::ExampleConfig(args) => example_config::run(&args),
            Command::Feed(args) => feed::run(&args, &HostClock::start()),
            Command::Fleet(command) => fleet::run(command),
            Command::Generate(args) => generate::run(&args, &Cli::command()),
            Command::Ports(args) => ports::run(&args),
            Command::Sniff(args) => sniff::run(&args),
        }
    }
}

/// Whether a reader of standard output has seen enough: `insd ... | head`. That is nobody's fault.
#[must_use]
pub fn is_enough(fault: &anyhow::Error) -> bool {
    fault.chain().any(|cause| {
        let io = cause.downcast_ref::<io::Error>();
        io.is_some_and(|fault| fault.kind() == io::ErrorKind::BrokenPipe)
    })
}

/// 2 for bad input, 3 for a solution that was hazardous, 1 for everything else.
#[must_use]
pub fn exit_code(fault: &anyhow::Error) -> ExitCode {
    if fault.is::<integrity::Hazardous>() {
        return ExitCode::from(HAZARDOUS);
    }
    ExitCode::from(if blame::is_bad_input(fault) { BAD_INPUT } else { FAILURE })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_well_formed() {
        Cli::command().debug_assert();
    }
}
