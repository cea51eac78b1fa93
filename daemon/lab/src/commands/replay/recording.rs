//! A raw recording, through the very same intake and engine as the daemon.

use anyhow::Context;
use insd_config::stored;
use insd_vessel::{Names, Pipeline, Product};

use super::args::{ReplayOptions, Tell};
use super::destination::{Destination, Replayed};
use super::sent::Sent;
use super::sink::Sink;
use crate::commands::smooth::Afterwards;
use crate::raw_run::RawRun;

/// Replays a recording.
pub(super) fn run(
    args: &ReplayOptions,
    tell: Tell,
    afterwards: Option<Afterwards>,
    destination: Destination,
) -> anyhow::Result<Replayed> {
    let mut raw = RawRun::open(&args.dir, args.config.as_deref(), args.run)?;
    let mut engine = raw.config.engine();
    engine.output_rate = args.rate.unwrap_or(engine.output_rate);
    engine.smoothing = afterwards.as_ref().map(|own| own.interval);
    engine.alignment = args.alignment.config();
    engine.stored = args.stored_state.as_deref().map(stored::read).transpose()?;
    let mut pipeline = Pipeline::new(raw.config.plan_with(engine), raw.config.clone());
    let names = Names::of(&raw.config.intake());
    let mut sink = Sink::create(args, afterwards, destination)?;
    let sent = args.sent.as_deref().map(|folder| Sent::create(folder, &raw.config));
    let mut sent = sent.transpose()?;
    let runs = raw.for_each_of_run(|arrival| {
        sink.hear(arrival.stamp.monotonic);
        let mut written = Ok(());
        pipeline.handle(arrival, |product| {
            tell(&names, &product);
            if written.is_ok() {
                written = match (&product, &mut sent) {
                    (Product::Engine(output), _) => sink.take(output),
                    (Product::Spoken(spoken), Some(sent)) => sent.take(spoken),
                    _ => Ok(()),
                };
            }
        });
        written.context("cannot write what comes of it")?;
        sink.look(pipeline.engine_in_use()).context("cannot write the sky")
    })?;
    if !sink.read(raw.read(), runs, raw.header().map(|header| &header.program)) {
        raw.tell_other_runs(runs);
    }
    sink.smooth(pipeline.engine_in_use());
    sink.say(pipeline.counts(), 0, Vec::new());
    sent.map_or(Ok(()), Sent::finish)?;
    sink.finish()
}
