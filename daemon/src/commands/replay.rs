//! `insd replay`: a recorded voyage through the same engine as the daemon, without a clock.

use std::path::{Path, PathBuf};

use anyhow::Context;
use insd_base::{AlignmentStatus, Event, Innovation, Mode, Time};
use insd_drivers::recording::{NavWriter, VoyageReader};
use insd_engine::{Engine, EngineConfig, Output};

use super::alignment::AlignmentArgs;
use super::outage::SensorOutage;
use super::summary;
use crate::evaluation::{AlignmentRow, InnovationRow, RowWriter};
use crate::output_file::OutputFile;
use crate::stored;

/// Options of `insd replay`.
#[derive(Clone, Debug, clap::Args)]
pub struct ReplayArgs {
    /// Voyage directory
    dir: PathBuf,
    /// File to write the solution to
    #[arg(long, value_name = "NAV.csv")]
    out: PathBuf,
    /// Solutions per second
    #[arg(long, value_name = "HZ", default_value_t = 10.0, value_parser = super::rate)]
    rate: f64,
    /// Take a sensor (imu, gnss, log, reference) away while FROM <= t_s < TO; may be repeated
    #[arg(long = "outage", value_name = "SENSOR:FROM..TO")]
    outages: Vec<SensorOutage>,
    #[command(flatten)]
    alignment: AlignmentArgs,
    /// Start warm: the state stored at the last shutdown, believed once the sensors confirm it
    #[arg(long, value_name = "FILE")]
    stored_state: Option<PathBuf>,
    /// Store the state at the end for the next start, if the ship is aligned and lies at her berth
    #[arg(long, value_name = "FILE")]
    save_state: Option<PathBuf>,
    /// Also write the innovations of all aids
    #[arg(long, value_name = "FILE.csv")]
    innovations: Option<PathBuf>,
    /// Also write what the alignment says of itself: phase, sigmas, forecast, sea
    #[arg(long, value_name = "FILE.csv")]
    alignment_log: Option<PathBuf>,
}

/// Where the outputs of the engine go.
struct Sink {
    nav: NavWriter<OutputFile>,
    innovations: Option<RowWriter<InnovationRow, OutputFile>>,
    alignment_log: Option<RowWriter<AlignmentRow, OutputFile>>,
    alignment: Vec<AlignmentStatus>,
    modes: Vec<(Time, Mode)>,
    departures: Vec<Time>,
    resets: Vec<Time>,
    stored: Option<Event>,
    solutions: u64,
}

/// Runs the command. What it writes is a function of the voyage and the options alone.
///
/// # Errors
/// The voyage cannot be read or the output not written.
pub fn run(args: &ReplayArgs) -> anyhow::Result<()> {
    let mut reader = VoyageReader::open(&args.dir)?;
    let mut config = EngineConfig::for_voyage(reader.header(), args.rate);
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
    let summary = summary::Summary {
        solutions: sink.solutions,
        left_out: sink.nav.left_out(),
        alignment: &sink.alignment,
        modes: &sink.modes,
        departures: &sink.departures,
        resets: &sink.resets,
        stored: sink.stored.as_ref(),
        counts: engine.counts(),
        dropped,
        files: reader.skipped(),
    };
    eprint!("{summary}");
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

impl Sink {
    fn create(args: &ReplayArgs) -> anyhow::Result<Self> {
        let innovations = |path: &PathBuf| OutputFile::create(path).map(RowWriter::new);
        let log = |path: &PathBuf| OutputFile::create(path).map(RowWriter::new);
        Ok(Sink {
            nav: open_nav(&args.out)?,
            innovations: args.innovations.as_ref().map(innovations).transpose()?,
            alignment_log: args.alignment_log.as_ref().map(log).transpose()?,
            alignment: Vec::new(),
            modes: Vec::new(),
            departures: Vec::new(),
            resets: Vec::new(),
            stored: None,
            solutions: 0,
        })
    }

    fn take(&mut self, output: &Output) -> std::io::Result<()> {
        match output {
            Output::Solution(solution) => {
                self.solutions += 1;
                self.nav.write(solution)
            }
            Output::Innovation(innovation) => match &mut self.innovations {
                Some(file) => file.write(&row(innovation)),
                None => Ok(()),
            },
            Output::Alignment(status) => {
                self.alignment.push(*status);
                match &mut self.alignment_log {
                    Some(file) => file.write(&AlignmentRow::from(status)),
                    None => Ok(()),
                }
            }
            Output::Event(event) => {
                self.note(event);
                Ok(())
            }
        }
    }

    fn note(&mut self, event: &Event) {
        tracing::debug!(?event);
        match *event {
            Event::ModeChanged { time, to } => self.modes.push((time, to)),
            Event::LeftBerth { time } => self.departures.push(time),
            Event::PositionReset { time } => self.resets.push(time),
            Event::StoredStateUsed { .. } | Event::StoredStateDropped { .. } => {
                self.stored = Some(*event);
            }
            _ => {}
        }
    }

    fn finish(self) -> anyhow::Result<()> {
        self.nav.finish().context("cannot write the solution")?.finish()?;
        if let Some(file) = self.alignment_log {
            file.finish()?.finish()?;
        }
        match self.innovations {
            Some(file) => file.finish()?.finish(),
            None => Ok(()),
        }
    }
}

fn open_nav(path: &Path) -> anyhow::Result<NavWriter<OutputFile>> {
    NavWriter::new(OutputFile::create(path)?).context("cannot write the solution")
}

fn row(innovation: &Innovation) -> InnovationRow {
    InnovationRow {
        t_s: innovation.time.as_seconds(),
        aid: innovation.aid.to_owned(),
        component: innovation.component,
        innovation: innovation.innovation,
        sigma: innovation.sigma,
        accepted: innovation.accepted,
    }
}
