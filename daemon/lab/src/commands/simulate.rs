//! `insd simulate`: makes a voyage directory with truth.

use std::path::{Path, PathBuf};

use anyhow::Context;
use insd_drivers::recording::{Compression, write_camera, write_raw, write_voyage};
use insd_simulator::{Override, footage, raw_gnss, simulate};

use super::camera;
use super::raw_gnss::files;
use crate::scenario;

/// Options of `insd simulate`.
#[derive(Clone, Debug, clap::Args)]
pub struct SimulateArgs {
    /// Scenario file, or name or number of a shipped scenario
    #[arg(required_unless_present = "list")]
    scenario: Option<String>,
    /// Tell which scenarios are shipped
    #[arg(long, conflicts_with_all = ["scenario", "seed", "out", "sets", "compress"])]
    list: bool,
    /// Seed of all random streams
    #[arg(long, value_name = "N", required_unless_present = "list")]
    seed: Option<u64>,
    /// Directory to write
    #[arg(long, value_name = "DIR", required_unless_present = "list")]
    out: Option<PathBuf>,
    /// Set a key of the scenario to another value, as start.lat_deg=60; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE")]
    sets: Vec<Override>,
    /// Compress imu.csv, truth.csv, raw GNSS and what a camera tells
    #[arg(long)]
    compress: bool,
}

/// Runs the command.
///
/// # Errors
/// The scenario is faulty or the directory cannot be written.
pub fn run(args: &SimulateArgs) -> anyhow::Result<()> {
    match (&args.scenario, args.seed, &args.out) {
        (Some(word), Some(seed), Some(out)) => {
            let compression = if args.compress { Compression::Zstd } else { Compression::None };
            let scenario = scenario::find(word, &args.sets)?;
            let written = write(&scenario, seed, out, compression)?;
            eprintln!("{written}");
            Ok(())
        }
        _ => Ok(crate::terminal::print(&scenario::list())?),
    }
}

/// Writes the voyage of a scenario, and tells in a line what it holds.
///
/// # Errors
/// The directory cannot be written.
pub fn write(
    scenario: &scenario::Named,
    seed: u64,
    out: &Path,
    compression: Compression,
) -> anyhow::Result<String> {
    let voyage = simulate(&scenario.scenario, seed);
    write_voyage(out, &voyage, compression).context("cannot write the voyage")?;
    let raw = raw_gnss(&scenario.scenario, seed).map(|raw| files(&raw)).transpose()?;
    write_raw(out, raw.as_ref(), compression).context("cannot write the raw GNSS")?;
    let footage = footage(&scenario.scenario, seed);
    let seen = footage.as_ref().map(camera::files).transpose()?;
    write_camera(out, seen.as_ref(), compression).context("cannot write the camera's files")?;
    let antennas = raw.map(|raw| format!(", {} antennas raw", raw.antennas.len()));
    let images = footage.map(|footage| format!(", {} images", footage.frames.len()));
    Ok(format!(
        "{}, seed {}: {} imu, {} gnss, {} log, {} reference, {} truth rows{}{} in {}",
        scenario.name,
        seed,
        voyage.imu.len(),
        voyage.gnss.len(),
        voyage.log.len(),
        voyage.reference.len(),
        voyage.truth.len(),
        antennas.unwrap_or_default(),
        images.unwrap_or_default(),
        out.display()
    ))
}
