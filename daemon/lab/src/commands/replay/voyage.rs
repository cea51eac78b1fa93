//! A voyage directory, straight into the engine.

use std::path::Path;

use anyhow::Context;
use insd_base::{Body, Received};
use insd_config::{BadInput, Config, VoyageCalendar, stored};
use insd_drivers::recording::{TemperatureReader, VoyageReader};
use insd_engine::{Engine, EngineConfig};
use insd_vessel::Outputs;

use super::super::learn;
use super::args::ReplayOptions;
use super::destination::{Destination, Replayed};
use super::sent::Sent;
use super::sink::Sink;
use super::without::Without;
use crate::camera_table;
use crate::camera_voyage::CameraVoyage;
use crate::commands::smooth::Afterwards;
use crate::raw_table::RawTable;
use crate::raw_voyage::RawVoyage;
use crate::reference_table::ReferenceTable;

/// Solutions per second where nothing else is asked for.
const RATE: f64 = 10.0;

/// Replays a voyage.
pub(super) fn run(
    args: &ReplayOptions,
    afterwards: Option<Afterwards>,
    destination: Destination,
) -> anyhow::Result<Replayed> {
    let mut reader = VoyageReader::open(&args.dir)?;
    let mut config = asked(args, &reader, afterwards.as_ref())?;
    let mut temperature = TemperatureReader::open(&args.dir)?;
    let (table, reference) = (RawTable::read(&args.dir)?, ReferenceTable::read(&args.dir)?);
    config.models.ranges = table.model();
    let way = Without::camera(&args.without, args.camera)?;
    let mut camera =
        way.map(|way| CameraVoyage::open(&args.dir, way)).transpose()?.unwrap_or_default();
    config.models.camera = way.map(|way| camera_table::read(&args.dir, way)).transpose()?.flatten();
    let mut ports = Ports::of(args, &reader.header().start_utc)?;
    config.points = ports.as_ref().map(|ports| ports.levers.clone()).unwrap_or_default();
    let mut engine = Engine::new(config);
    let (mut sink, mut dropped) = (Sink::create(args, afterwards, destination)?, 0_u64);
    let gnss = Without::gnss(&args.without, args.gnss)?;
    let start_utc = &reader.header().start_utc;
    let mut raw = RawVoyage::open(&args.dir, gnss, &args.masks, &table, start_utc)?;
    for received in &mut reader {
        let received = reference.told(received?);
        sink.hear(received.receipt);
        for ranges in raw.until(received.receipt) {
            if args.outages.iter().any(|outage| outage.drops(&ranges)) {
                dropped += 1;
                continue;
            }
            engine.handle(&ranges);
            sink.look(&engine).context("cannot write the sky")?;
        }
        dropped += camera.pass_on(received.receipt, &mut engine, &args.outages)?;
        learn::feel(&mut engine, temperature.as_mut(), received.receipt)?;
        raw.hear(&received);
        if raw.replaces(&received) || Without::drops(&args.without, &received) {
            continue;
        }
        if args.outages.iter().any(|outage| outage.drops(&received)) {
            dropped += 1;
            continue;
        }
        engine.handle(&received);
        while let Some(output) = engine.poll_output() {
            ports.iter_mut().for_each(|ports| ports.outputs.note(&output));
            sink.take(&output).context("cannot write the solution")?;
        }
        sink.look(&engine).context("cannot write the sky")?;
        ports.iter_mut().try_for_each(|ports| ports.speak(&engine, &received))?;
    }
    ports.map_or(Ok(()), |ports| ports.sent.finish())?;
    sink.smooth(&engine);
    let warmth = temperature.as_ref().map(TemperatureReader::report);
    let files = reader.skipped().into_iter().chain(camera.report()).chain(warmth).collect();
    sink.say(engine.counts(), dropped, files);
    let replayed = sink.finish()?;
    let start_utc = &reader.header().start_utc;
    args.save_state.iter().try_for_each(|path| save(path, &engine, start_utc))?;
    Ok(replayed)
}

/// What the options ask of the engine.
fn asked(
    args: &ReplayOptions,
    reader: &VoyageReader,
    afterwards: Option<&Afterwards>,
) -> anyhow::Result<EngineConfig> {
    let mut config = EngineConfig::for_voyage(reader.header(), args.rate.unwrap_or(RATE));
    config.alignment = args.alignment.config();
    config.smoothing = afterwards.map(|own| own.interval);
    config.learning = !args.without.contains(&Without::Learning);
    config.stored = args.stored_state.as_deref().map(stored::read).transpose()?;
    config.learnt = match &args.log_model {
        Some(_) if !config.learning => {
            return Err(BadInput("--without learning leaves nothing for --log-model".into()).into());
        }
        file => file.as_deref().map(learn::read).transpose()?,
    };
    Ok(config)
}

/// The ports of a configuration, as they would be with the sensors of the voyage.
struct Ports {
    outputs: Outputs,
    sent: Sent,
    levers: Vec<Body>,
    calendar: Option<VoyageCalendar>,
}

impl Ports {
    fn of(args: &ReplayOptions, start_utc: &str) -> anyhow::Result<Option<Self>> {
        let Some(folder) = &args.sent else { return Ok(None) };
        let Some(file) = &args.config else {
            return Err(
                BadInput("--sent: the ports of which configuration? --config".into()).into()
            );
        };
        let (config, _) = Config::load(file)?;
        Ok(Some(Ports {
            outputs: Outputs::new(config.output_plan()),
            sent: Sent::create(folder, &config)?,
            levers: config.levers(),
            calendar: VoyageCalendar::new(start_utc),
        }))
    }

    /// A voyage has no clock but its messages: what is due is said when the next one is received.
    fn speak(&mut self, engine: &Engine, received: &Received) -> anyhow::Result<()> {
        self.outputs.hear(received);
        let utc = self.calendar.map(|calendar| calendar.utc(received.receipt));
        let mut written = Ok(());
        self.outputs.speak(engine, received.receipt, utc, |spoken| {
            if written.is_ok() {
                written = self.sent.take(&spoken);
            }
        });
        written.context("cannot write what is sent")
    }
}

fn save(path: &Path, engine: &Engine, start_utc: &str) -> anyhow::Result<()> {
    let Some(state) = engine.stored_state() else {
        let path = path.display();
        anyhow::bail!("{path}: no state stored, as the ship is not aligned, or not at her berth");
    };
    stored::write(path, &state, start_utc)
}
