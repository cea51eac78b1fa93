//! The daemon at work: ports, one engine thread, outputs, recording.

mod bus;
mod outputs;
mod priority;
mod time_out;
mod told;

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::RecvTimeoutError;
use std::time::Duration;

use anyhow::Context;
use insd_base::{Arrival, Input, PortId, Span, Stamp, Time};
use insd_drivers::can::{self, CanConfig};
use insd_drivers::ports::{self, PortConfig, PortHandle, Receiver, Surroundings};
use insd_drivers::raw::{RawHeader, RawWriter, Recorder, RecordingConfig};
use insd_drivers::recording::NavWriter;
use insd_engine::Output;

use crate::clock::HostClock;
use crate::config::{Config, PortSection, Recording};
use crate::output_file::OutputFile;
use crate::pipeline::{Pipeline, Product};
use crate::speaker::Spoken;

use bus::{Buses, NodeOfPort};
use outputs::Outputs;
use time_out::TimeOut;
pub use told::tell;

/// Bytes that may wait for the engine at one port.
const WAITING: usize = 256 * 1024;
/// Longest wait for an arrival: time passes even when nothing comes.
const TURN: Duration = Duration::from_millis(25);

/// The port of what comes from our own clock: none of the configuration.
const NOWHERE: PortId = PortId(u16::MAX);

/// Time between the things that are done once a second, s.
const SECOND: f64 = 1.0;
/// An epoch that begins later than this is late.
const PUNCTUAL: Span = Span::from_nanos(1_000_000);
/// Time between two accounts of what was sent, s.
const ACCOUNT: f64 = 3600.0;

/// What the command line adds to the configuration.
#[derive(Clone, Debug, Default)]
pub struct RunOptions {
    /// Also write the solutions as `nav.csv`.
    pub nav: Option<std::path::PathBuf>,
    /// Stop after so many seconds.
    pub seconds: Option<f64>,
}

/// Runs until it is told to stop.
///
/// # Errors
/// Something that is needed at the start cannot be had. Ports that are absent are no error.
pub fn run(config: &Config, text: &str, options: &RunOptions) -> anyhow::Result<()> {
    let clock = HostClock::start();
    let priority = config.ship.priority.filter(|priority| *priority > 0);
    let runtime = tokio::runtime::Builder::new_multi_thread()
        .worker_threads(2)
        .on_thread_start(move || hasten(priority.map(|priority| priority.saturating_sub(1).max(1))))
        .enable_all()
        .build()
        .context("cannot start the runtime")?;
    let (queue, receiver) = ports::queue(WAITING);
    let surroundings =
        Surroundings { clock: Arc::new(clock), queue: queue.clone(), judge: Some(told::judge()) };
    let _guard = runtime.enter();
    let (buses, nodes) = Buses::new(config);
    let handles = open_inputs(config, &nodes, &surroundings);
    let first_output = u16::try_from(config.ports.len()).unwrap_or(u16::MAX);
    let pipeline = Pipeline::new(&config.intake(), config.engine(), config.speaker());
    let made = pipeline.speaker().station().ports();
    let outputs = Outputs::open(config, made, first_output, &surroundings);
    let after_outputs = first_output.saturating_add(outputs.count());
    let time_out = TimeOut::open(config, after_outputs, &surroundings);
    let recorder = config.recording.as_ref().map(|own| start_recorder(own, text)).transpose()?;
    let stop = Arc::new(AtomicBool::new(false));
    let worker = Worker {
        pipeline,
        outputs,
        buses,
        time_out,
        recorder,
        nav: options.nav.as_deref().map(open_nav).transpose()?,
        clock,
        accounted: Time::START,
        epochs: (0, 0),
        inputs: first_output,
    };
    let thread = std::thread::Builder::new().name("engine".to_owned()).spawn({
        let stop = Arc::clone(&stop);
        move || {
            hasten(priority);
            worker.run(receiver, &stop)
        }
    })?;
    runtime.block_on(until_stopped(options.seconds));
    stop.store(true, Ordering::Relaxed);
    let finished = thread.join().map_err(|_| anyhow::anyhow!("the engine thread panicked"))?;
    drop((handles, queue));
    runtime.shutdown_timeout(Duration::from_secs(1));
    finished
}

/// A thread that may not go before others still does its work, only later on a busy computer.
fn hasten(priority: Option<u8>) {
    if let Some(Err(fault)) = priority.map(priority::raise) {
        tracing::info!(fault, "no real-time priority: what is sent may be late on a busy computer");
    }
}

/// Opens what is listened to. CAN ports with a node are given it.
fn open_inputs(
    config: &Config,
    nodes: &[NodeOfPort],
    surroundings: &Surroundings,
) -> Vec<PortHandle> {
    let ports = config.ports.iter().zip(config.port_configs()).zip((0..).map(PortId));
    let open = |((section, port), id): ((&PortSection, PortConfig), PortId)| {
        let surroundings = surroundings.clone();
        let node = nodes.iter().find(|node| node.port == section.name);
        let Some((bus, node)) = CanConfig::of(&port).zip(node) else {
            return ports::spawn(id, port, surroundings);
        };
        let state = node.state.clone();
        tokio::spawn(bus::watch(node.port.clone(), node.node.clone(), state));
        can::spawn(id, bus, surroundings, Some(node.node.for_port()))
    };
    ports.map(open).collect()
}

async fn until_stopped(seconds: Option<f64>) {
    use tokio::signal::unix::{SignalKind, signal};
    let limit = Duration::from_secs_f64(seconds.unwrap_or(1e9).clamp(0.0, 1e9));
    let (Ok(mut interrupt), Ok(mut terminate)) =
        (signal(SignalKind::interrupt()), signal(SignalKind::terminate()))
    else {
        tokio::time::sleep(limit).await;
        return;
    };
    tokio::select! {
        _ = interrupt.recv() => tracing::info!("interrupted"),
        _ = terminate.recv() => tracing::info!("told to stop"),
        () = tokio::time::sleep(limit) => tracing::info!("time is up"),
    }
}

fn start_recorder(config: &Recording, text: &str) -> anyhow::Result<Recorder> {
    let megabyte = 1024 * 1024;
    let recording = RecordingConfig {
        name: config.name.clone(),
        rotate_bytes: config.rotate_mb.saturating_mul(megabyte),
        rotate_span: Span::from_seconds(config.rotate_s),
        quota_bytes: config.quota_mb.map(|quota| quota.saturating_mul(megabyte)),
    };
    let program = format!("insd {}", env!("CARGO_PKG_VERSION"));
    let header = RawHeader { program, config: text.to_owned() };
    let writer = RawWriter::create(&config.folder, recording, header)?;
    Recorder::start(writer).context("cannot start the recorder")
}

fn open_nav(path: &Path) -> anyhow::Result<NavWriter<OutputFile>> {
    NavWriter::new(OutputFile::create(path)?).context("cannot write the solution")
}

/// What runs on the engine's thread.
struct Worker {
    pipeline: Pipeline,
    outputs: Outputs,
    buses: Buses,
    time_out: TimeOut,
    recorder: Option<Recorder>,
    nav: Option<NavWriter<OutputFile>>,
    clock: HostClock,
    /// When it was told last what was sent.
    accounted: Time,
    /// Epochs of the outputs, and how many of them began more than a millisecond late.
    epochs: (u64, u64),
    /// Ports from this number on are written to, and nothing of the navigation hangs on them.
    inputs: u16,
}

impl Worker {
    fn run(mut self, mut receiver: Receiver, stop: &AtomicBool) -> anyhow::Result<()> {
        let mut ticked = Time::START;
        while !stop.load(Ordering::Relaxed) {
            match receiver.recv_timeout(self.patience()) {
                Ok(arrival) => self.take(&arrival)?,
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => break,
            }
            let now = self.clock.now();
            let due = self.pipeline.next_tick(now.monotonic);
            if let Some(due) = due.filter(|due| *due <= now.monotonic) {
                self.epochs.0 += 1;
                self.epochs.1 += u64::from(now.monotonic - due > PUNCTUAL);
                self.take(&Arrival { stamp: now, port: NOWHERE, input: Input::Tick })?;
            }
            if (now.monotonic - ticked).as_seconds() >= SECOND {
                ticked = now.monotonic;
                self.tick(&now);
            }
        }
        self.finish()
    }

    /// How long to wait for an arrival: until something is due.
    fn patience(&self) -> Duration {
        let now = self.clock.now().monotonic;
        let wait = |due: Time| Duration::from_nanos((due - now).as_nanos().max(0).unsigned_abs());
        self.pipeline.next_tick(now).map_or(TURN, wait).min(TURN)
    }

    /// What is done once a second.
    fn tick(&mut self, now: &Stamp) {
        if let Some(recorder) = &mut self.recorder {
            recorder.tick(now.monotonic);
        }
        self.time_out.send(now, self.pipeline.utc_at(now.monotonic));
        if (now.monotonic - self.accounted).as_seconds() >= ACCOUNT {
            self.accounted = now.monotonic;
            self.outputs.tell();
        }
    }

    fn take(&mut self, arrival: &insd_base::Arrival) -> anyhow::Result<()> {
        if arrival.port.0 >= self.inputs && arrival.port != NOWHERE {
            self.outputs.note(arrival);
            return Ok(());
        }
        if let Some(recorder) = &mut self.recorder {
            recorder.record(arrival);
        }
        let (outputs, buses, nav) = (&mut self.outputs, &mut self.buses, &mut self.nav);
        let clock = &self.clock;
        let mut written = Ok(());
        self.pipeline.handle(arrival, |intake, product| {
            tell(intake, &product);
            match product {
                Product::Engine(Output::Solution(solution)) => {
                    if let (Some(nav), true) = (nav.as_mut(), written.is_ok()) {
                        written = nav.write(&solution);
                    }
                }
                Product::Spoken(Spoken::Messages(port, messages)) => {
                    outputs.send(port, &messages);
                }
                Product::Spoken(Spoken::Epochs(epochs)) => {
                    buses.send(&epochs, clock.now().monotonic);
                }
                _ => {}
            }
        });
        written.context("cannot write the solution")
    }

    fn finish(self) -> anyhow::Result<()> {
        self.outputs.tell();
        let skipped = self.pipeline.speaker().station().skipped();
        let (epochs, late) = self.epochs;
        tracing::info!(epochs, late, skipped, "epochs, and those begun more than 1 ms late");
        if let Some(recorder) = self.recorder {
            let state = recorder.finish();
            tracing::info!(?state, "recording ended");
        }
        match self.nav {
            Some(nav) => nav.finish().context("cannot write the solution")?.finish(),
            None => Ok(()),
        }
    }
}
