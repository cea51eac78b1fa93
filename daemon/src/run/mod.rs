//! The daemon at work: ports, one engine thread, outputs, recording.

mod alert_journal;
mod bus;
mod connections;
mod control;
mod demo;
mod fleet;
mod headline;
mod heart;
mod journal;
mod manager;
mod outputs;
mod page;
mod priority;
mod report;
mod service;
mod showcase;
mod time_out;
mod told;
mod worker;

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

use anyhow::Context;
use insd_base::Span;
use insd_config::{Config, OutputFile, RecordingSection, StateSection};
use insd_drivers::ports::{self, Surroundings};
use insd_drivers::raw::{RawHeader, RawWriter, Recorder, RecordingConfig};
use insd_drivers::recording::NavWriter;
use insd_web::SECURITY;
use tokio::sync::oneshot;

use crate::clock::{HostClock, boot_now};
use crate::logging::Log;
use crate::state::{self, Folders, Remains, Saver};

use alert_journal::AlertJournal;
use connections::Connections;
pub use demo::open as open_demo;
use fleet::Fleets;
pub(crate) use fleet::login;
use headline::Headline;
use heart::Heart;
use journal::{Audience, Journal};
use manager::Manager;
use service::Service;
use showcase::Origin;
pub use told::tell;
use worker::{Agenda, Worker};

/// Bytes that may wait for the engine at one port.
const WAITING: usize = 256 * 1024;

/// What the command line adds to the configuration.
#[derive(Clone, Debug, Default)]
pub struct RunOptions {
    /// Also write the solutions as `nav.csv`.
    pub nav: Option<PathBuf>,
    /// Stop after so many seconds.
    pub seconds: Option<f64>,
    /// The file of the configuration, to be read again when that is asked for.
    pub config: Option<PathBuf>,
}

/// Runs until it is told to stop. `text` is that of the configuration.
///
/// # Errors
/// Something that is needed at the start cannot be had. Ports that are absent are no error.
pub fn run(config: &Config, text: &str, options: &RunOptions, log: &Log) -> anyhow::Result<()> {
    let clock = HostClock::start();
    let remains = remains(&config.state, &clock);
    let priority = config.ship.priority.filter(|priority| *priority > 0);
    let runtime = runtime(priority).context("cannot start the runtime")?;
    let (queue, receiver) = ports::queue(WAITING);
    let surroundings = Surroundings { clock: Arc::new(clock), queue, judge: Some(told::judge()) };
    let guard = runtime.enter();
    let pipeline = config.pipeline();
    let made = pipeline.outputs().station().ports();
    let connections = Connections::open(config, made, &surroundings, runtime.handle());
    drop(surroundings);
    let (commander, controls) = control::channel();
    let (headline, status) = Headline::new();
    let (configuration, hash) = (options.config.clone(), showcase::hash(text));
    let (version, file) =
        (env!("CARGO_PKG_VERSION"), configuration.as_ref().map(|own| own.display()));
    tracing::info!(target: SECURITY, version, file = file.map(tracing::field::display), hash, "insd starts");
    let page = page::open(config, Origin { clock, started: clock.now(), configuration, hash }, log);
    let fleets = Fleets::start(config, page.as_ref().map(|page| &page.viewer), clock);
    let page = page.map(|page| (page.showcase, (page.orders, page.handle)));
    let (showcase, (orders, _page)) =
        page.map_or((None, (None, None)), |(own, rest)| (Some(own), rest));
    let heart = Heart::default();
    let worker = Worker {
        connections,
        pipeline,
        receiver,
        controls,
        recorder: config.recording.as_ref().map(|own| start_recorder(own, text)).transpose()?,
        saver: start_saver(&config.state)?,
        fleets,
        nav: options.nav.as_deref().map(open_nav).transpose()?,
        journal: Journal::start(audience(headline, showcase))
            .context("cannot start the journal")?,
        clock,
        heart: heart.clone(),
        agenda: Agenda::default(),
        text: text.to_owned(),
    };
    let stop = Arc::new(AtomicBool::new(false));
    let (thread, ended) = start_engine(worker, remains, priority, &stop)?;
    let service = Service {
        config: options.config.clone(),
        log: log.clone(),
        commander,
        manager: Manager::start().context("cannot start to speak to the manager")?,
        heart,
        headline: status,
        ended,
        orders,
        limit: options.seconds.map(|seconds| Duration::from_secs_f64(seconds.clamp(0.0, 1e9))),
    };
    let attended = runtime.block_on(service.attend());
    stop.store(true, Ordering::Relaxed);
    let finished = thread.join().map_err(|_| anyhow::anyhow!("the engine thread panicked"))?;
    drop(guard);
    runtime.shutdown_timeout(Duration::from_secs(1));
    finished.and(attended.context("cannot wait for signals"))
}

fn runtime(priority: Option<u8>) -> std::io::Result<tokio::runtime::Runtime> {
    tokio::runtime::Builder::new_multi_thread()
        .worker_threads(2)
        .on_thread_start(move || hasten(priority.map(|priority| priority.saturating_sub(1).max(1))))
        .enable_all()
        .build()
}

/// Who is told of the navigation.
fn audience(headline: Headline, showcase: Option<showcase::Showcase>) -> Vec<Box<dyn Audience>> {
    let mut all: Vec<Box<dyn Audience>> =
        vec![Box::new(headline), Box::new(AlertJournal::default())];
    all.extend(showcase.map(|showcase| Box::new(showcase) as Box<dyn Audience>));
    all
}

/// Starts the engine's thread; what is handed back with it is gone when the thread has ended, however it did.
fn start_engine(
    worker: Worker,
    remains: Remains,
    priority: Option<u8>,
    stop: &Arc<AtomicBool>,
) -> std::io::Result<(JoinHandle<anyhow::Result<()>>, oneshot::Receiver<()>)> {
    let (alive, ended) = oneshot::channel();
    let stop = Arc::clone(stop);
    let work = move || {
        let _alive: oneshot::Sender<()> = alive;
        hasten(priority);
        worker.run(remains, &stop)
    };
    let thread = std::thread::Builder::new().name("engine".to_owned()).spawn(work)?;
    Ok((thread, ended))
}

/// What the run before has left in the folders of the state.
fn remains(config: &StateSection, clock: &HostClock) -> Remains {
    if !config.enabled {
        return Remains::default();
    }
    let folders: Vec<PathBuf> =
        config.runtime_folder().into_iter().chain(config.folder()).collect();
    state::remains(&folders, &boot_now(&clock.now()))
}

fn start_saver(config: &StateSection) -> anyhow::Result<Option<Saver>> {
    let (memory, disk) = (config.runtime_folder(), config.folder());
    if !config.enabled || (memory.is_none() && disk.is_none()) {
        return Ok(None);
    }
    let interval = Span::from_seconds(config.interval_s);
    let saver = Saver::start(&Folders { memory, disk, interval });
    Ok(Some(saver.context("cannot start to save the state")?))
}

/// A thread that may not go before others still does its work, only later on a busy computer.
fn hasten(priority: Option<u8>) {
    if let Some(Err(fault)) = priority.map(priority::raise) {
        tracing::info!(fault, "no real-time priority: what is sent may be late on a busy computer");
    }
}

fn start_recorder(config: &RecordingSection, text: &str) -> anyhow::Result<Recorder> {
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
