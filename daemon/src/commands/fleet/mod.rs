//! `insd fleet`: what is done ashore with what ships tell.

mod broker;
mod simulate;
mod sink;

use clap::Subcommand;
use insd_fleet::sink::postgres::schema;
use insd_lab::terminal::print;

/// Commands about fleets.
#[derive(Debug, Subcommand)]
pub enum FleetCommand {
    /// Take in what ships tell, into PostgreSQL or as line protocol, and show all of them on one sheet
    Sink(sink::SinkArgs),
    /// Be many ships: a load for a broker and a sink
    Simulate(simulate::SimulateFleetArgs),
    /// Print the tables of the sink as SQL
    Schema,
}

/// Runs the command.
///
/// # Errors
/// Bad input, or what the world says.
pub fn run(command: FleetCommand) -> anyhow::Result<()> {
    match command {
        FleetCommand::Sink(args) => sink::run(&args),
        FleetCommand::Simulate(args) => simulate::run(&args),
        FleetCommand::Schema => Ok(print(&schema())?),
    }
}
