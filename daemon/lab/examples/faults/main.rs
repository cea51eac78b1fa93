//! Voyages with a sensor that lies: what it costs, who is told, and whether the right one is named.
//!
//! `faults [DRAWS] [KIND]`: each kind of `insd_simulator::lies`, or those whose name begins so, with both
//! grades of IMU and every suite of sensors, so many times; then, or of the kind `honest` alone, the same hours with honest
//! sensors. `scenarios` sails the shipped voyages with honest sensors instead. In the environment
//! `CASES=1` tells each case, `ONLY="Mems log"` takes one grade and suite, `TRACE=1` tells each second, `SEED=3` takes one of
//! the draws. Options as those of `insd campaign` sail it in parts and put parts together.

mod cases;
mod sail;
mod scenarios;
mod score;

use clap::Parser as _;
use insd_lab::parts::PartsArgs;

/// What is sailed.
#[derive(Debug, clap::Parser)]
struct Args {
    /// Voyages of each kind, grade and suite
    #[arg(default_value_t = 5)]
    draws: u64,
    /// Kinds whose name begins so, `honest`, or `scenarios`
    #[arg(default_value = "")]
    kind: String,
    #[command(flatten)]
    parts: PartsArgs,
}

fn main() -> anyhow::Result<()> {
    let args = Args::parse();
    if args.kind == "scenarios" {
        return scenarios::sail_all(args.draws, &args.parts);
    }
    cases::sail_all(args.draws, &args.kind, &args.parts)
}
