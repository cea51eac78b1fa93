//! `insd learn`: what repeats of the errors of log and IMU, learnt from voyages and raw recordings.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::Context;
use indicatif::{ProgressBar, ProgressStyle};
use insd_base::{Arrival, Input, Order, Time};
use insd_config::{BadInput, learning};
use insd_drivers::recording::{TemperatureReader, VoyageReader};
use insd_engine::{Engine, EngineConfig};
use insd_learning::{KeptModel, words};
use insd_vessel::Pipeline;

use crate::raw_run::{RawRun, is_recording};

/// Messages between two looks at the progress.
const STRIDE: u32 = 20_000;

/// Options of `insd learn`.
#[derive(Clone, Debug, clap::Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub struct LearnArgs {
    /// Voyage directories and raw recordings, in the order in which they were made
    #[arg(required = true, value_name = "VOYAGE")]
    voyages: Vec<PathBuf>,
    /// The model: gone on from if it is there, and written
    #[arg(long, required = true, value_name = "FILE.toml")]
    model: Option<PathBuf>,
    #[command(subcommand)]
    show: Option<Show>,
}

/// What else is done with a model.
#[derive(Clone, Debug, clap::Subcommand)]
enum Show {
    /// Say in words what a model has learnt
    Show {
        /// The model
        file: PathBuf,
    },
}

/// Runs the command.
///
/// # Errors
/// A voyage or the model cannot be read, or the model not written.
pub fn run(args: &LearnArgs) -> anyhow::Result<()> {
    if let Some(Show::Show { file }) = &args.show {
        print(&read(file)?)?;
        return Ok(());
    }
    let Some(file) = &args.model else {
        return Err(BadInput("--model: which file is the model to be in?".to_owned()).into());
    };
    let mut model = if file.exists() { Some(read(file)?) } else { None };
    let bar = progress_bar(args.voyages.len() as u64)?;
    for voyage in &args.voyages {
        let told = Progress { bar: &bar, name: voyage.display().to_string(), count: 0 };
        model = Some(if voyage.join("voyage.toml").exists() || !is_recording(voyage) {
            sail(voyage, model, told)?
        } else {
            replay(voyage, model, told)?
        });
        bar.inc(1);
    }
    bar.finish_and_clear();
    let Some(model) = model else { return Ok(()) };
    learning::keep(file, &model)
        .with_context(|| format!("{}: cannot be written", file.display()))?;
    print(&model)
}

/// Reads a model.
///
/// # Errors
/// [`BadInput`] with file and reason.
pub(super) fn read(file: &Path) -> anyhow::Result<KeptModel> {
    let bad = |fault: &dyn std::fmt::Display| BadInput(format!("{}: {fault}", file.display()));
    let text = fs::read_to_string(file).map_err(|fault| bad(&fault))?;
    KeptModel::parse(&text).map_err(|fault| bad(&fault).into())
}

/// Sails a voyage, and returns what is known after it.
fn sail(
    dir: &Path,
    before: Option<KeptModel>,
    mut told: Progress<'_>,
) -> anyhow::Result<KeptModel> {
    let mut reader = VoyageReader::open(dir)?;
    let mut temperature = TemperatureReader::open(dir)?;
    let config = EngineConfig {
        learning: true,
        learnt: before,
        ..EngineConfig::for_voyage(reader.header(), 1.0)
    };
    let mut engine = Engine::new(config);
    for received in &mut reader {
        let received = received?;
        told.go_on(received.receipt);
        feel(&mut engine, temperature.as_mut(), received.receipt)?;
        engine.handle(&received);
        while engine.poll_output().is_some() {}
    }
    engine.learnt().context("nothing is learnt of this voyage")
}

/// Sails all runs of a raw recording, each with the configuration that it had, and returns what is known after them.
fn replay(
    path: &Path,
    before: Option<KeptModel>,
    mut told: Progress<'_>,
) -> anyhow::Result<KeptModel> {
    let (mut model, mut run, mut runs) = (before, 1, 1);
    while run <= runs {
        let mut raw = RawRun::open(path, None, run)?;
        let engine = EngineConfig { learning: true, learnt: model.clone(), ..raw.config.engine() };
        let mut pipeline = Pipeline::new(raw.config.plan_with(engine), raw.config.clone());
        runs = raw.walk(|item| {
            // what is wrong with a recording is told by `insd replay`
            let Ok(arrival) = item else { return Ok(()) };
            told.go_on(arrival.stamp.monotonic);
            if !is_of_another_run(&arrival) {
                pipeline.handle(&arrival, |_| {});
            }
            Ok(())
        })?;
        model = pipeline.engine().learnt();
        run += 1;
    }
    model.context("nothing is learnt of this recording")
}

/// What the run before has left: here it is gone on from the model that is made.
fn is_of_another_run(arrival: &Arrival) -> bool {
    matches!(
        arrival.input,
        Input::Order(Order::LearntModel(_) | Order::Checkpoint { .. } | Order::UseLearnt(_))
    )
}

/// Tells how far a voyage is.
struct Progress<'a> {
    bar: &'a ProgressBar,
    name: String,
    count: u32,
}

impl Progress<'_> {
    fn go_on(&mut self, now: Time) {
        self.count += 1;
        if self.count.is_multiple_of(STRIDE) {
            self.bar.set_message(format!("{}: {:.1} h", self.name, now.as_seconds() / 3600.0));
        }
    }
}

fn progress_bar(length: u64) -> anyhow::Result<ProgressBar> {
    let style = "{wide_bar:.cyan/blue} {pos}/{len} voyages, {msg}, {elapsed} gone";
    Ok(ProgressBar::new(length).with_style(ProgressStyle::with_template(style)?))
}

/// Tells an engine the newest temperature of its IMU, if there is a newer one.
pub(super) fn feel(
    engine: &mut Engine,
    temperature: Option<&mut TemperatureReader>,
    now: Time,
) -> anyhow::Result<()> {
    let newer = temperature.map(|own| own.until(now)).transpose()?.flatten();
    if let Some((time, celsius)) = newer {
        engine.feel(time, celsius);
    }
    Ok(())
}

fn print(model: &KeptModel) -> anyhow::Result<()> {
    Ok(crate::terminal::print(&(words(model).join("\n") + "\n"))?)
}
