//! A voyage directory, straight into the engine.

use std::path::Path;

use anyhow::Context;
use insd_drivers::recording::VoyageReader;
use insd_engine::{Engine, EngineConfig};

use super::ReplayArgs;
use super::sink::Sink;
use crate::stored;

/// Solutions per second where nothing else is asked for.
const RATE: f64 = 10.0;

/// Replays a voyage.
pub(super) fn run(args: &ReplayArgs) -> anyhow::Result<()> {
    let mut reader = VoyageReader::open(&args.dir)?;
    let mut config = EngineConfig::for_voyage(reader.header(), args.rate.unwrap_or(RATE));
    config.alignment = args.alignment.config();
    config.stored = args.stored_state.as_deref().map(stored::read).transpose()?;
    let mut engine = Engine::new(config);
    let mut sink = Sink::create(args)?;
    let mut dropped = 0_u64;
    for received in &mut reader {
        let received = received?;
        if args.outages.iter().any(|outage| outage.drops(&received)) {
            dropped += 1;
            continue;
        }
        engine.handle(&received);
        while let Some(output) = engine.poll_output() {
            sink.take(&output).context("cannot write the solution")?;
        }
    }
    eprint!("{}", sink.summary(engine.counts(), dropped, reader.skipped()));
    sink.finish()?;
    match &args.save_state {
        Some(path) => save(path, &engine, &reader.header().start_utc),
        None => Ok(()),
    }
}

fn save(path: &Path, engine: &Engine, start_utc: &str) -> anyhow::Result<()> {
    let Some(state) = engine.stored_state() else {
        eprintln!("no state stored: the ship is not aligned, or not at her berth");
        return Ok(());
    };
    stored::write(path, &state, start_utc)
}
