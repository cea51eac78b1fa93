//! `insd simulate`: makes a voyage directory with truth.

use std::path::PathBuf;

use anyhow::Context;
use insd_drivers::recording::{Compression, write_voyage};
use insd_simulator::{Override, simulate};

use super::scenario;

/// Options of `insd simulate`.
#[derive(Clone, Debug, clap::Args)]
pub struct SimulateArgs {
    /// Scenario file, or name or number of a shipped scenario
    scenario: String,
    /// Seed of all random streams
    #[arg(long, value_name = "N")]
    seed: u64,
    /// Directory to write
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Set a key of the scenario to another value, as start.lat_deg=60; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE")]
    sets: Vec<Override>,
    /// Compress imu.csv and truth.csv
    #[arg(long)]
    compress: bool,
}

/// Runs the command.
///
/// # Errors
/// The scenario is faulty or the directory cannot be written.
pub fn run(args: &SimulateArgs) -> anyhow::Result<()> {
    let scenario = scenario::find(&args.scenario, &args.sets)?;
    let voyage = simulate(&scenario.scenario, args.seed);
    let compression = if args.compress { Compression::Zstd } else { Compression::None };
    write_voyage(&args.out, &voyage, compression).context("cannot write the voyage")?;
    eprintln!(
        "{}, seed {}: {} imu, {} gnss, {} log, {} reference, {} truth rows in {}",
        scenario.name,
        args.seed,
        voyage.imu.len(),
        voyage.gnss.len(),
        voyage.log.len(),
        voyage.reference.len(),
        voyage.truth.len(),
        args.out.display()
    );
    Ok(())
}
