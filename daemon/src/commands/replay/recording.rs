//! A raw recording, through the very same intake and engine as the daemon.

use anyhow::Context;

use super::ReplayArgs;
use super::sink::Sink;
use crate::pipeline::{Pipeline, Product};
use crate::raw_run::RawRun;
use crate::run::tell;
use crate::stored;

/// Replays a recording.
pub(super) fn run(args: &ReplayArgs) -> anyhow::Result<()> {
    let mut raw = RawRun::open(&args.dir, args.config.as_deref(), args.run)?;
    let mut engine = raw.config.engine();
    engine.output_rate = args.rate.unwrap_or(engine.output_rate);
    engine.alignment = args.alignment.config();
    engine.stored = args.stored_state.as_deref().map(stored::read).transpose()?;
    let mut pipeline = Pipeline::new(&raw.config.intake(), engine);
    let mut sink = Sink::create(args)?;
    raw.for_each(|arrival| {
        let mut written = Ok(());
        pipeline.handle(arrival, |intake, product| {
            tell(intake, &product);
            if let (Product::Engine(output), true) = (&product, written.is_ok()) {
                written = sink.take(output);
            }
        });
        written.context("cannot write the solution")
    })?;
    eprint!("{}", sink.summary(pipeline.counts(), 0, Vec::new()));
    sink.finish()
}
