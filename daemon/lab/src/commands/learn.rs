//! `insd learn`: what repeats of the errors of log and gyros, learnt from voyages that were recorded.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::Context;
use insd_base::Time;
use insd_base::units::{DEG, DEG_PER_HOUR};
use insd_config::{BadInput, output_file};
use insd_drivers::recording::{TemperatureReader, VoyageReader};
use insd_engine::{Engine, EngineConfig};
use insd_learning::thermal::MIDDLE;
use insd_learning::{KeptGyros, KeptLog, KeptModel, ShadowScore};

/// Knots in a metre per second.
const KNOTS: f64 = 3600.0 / 1852.0;
/// Speeds that the curve of a log is told at, knots.
const SPEEDS: [f64; 4] = [6.0, 9.0, 12.0, 18.0];

/// Options of `insd learn`.
#[derive(Clone, Debug, clap::Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub struct LearnArgs {
    /// Voyage directories, in the order in which they were made
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
        crate::terminal::print(&words(&read(file)?))?;
        return Ok(());
    }
    let Some(file) = &args.model else {
        return Err(BadInput("--model: which file is the model to be in?".to_owned()).into());
    };
    let mut model = if file.exists() { Some(read(file)?) } else { None };
    for (i, voyage) in args.voyages.iter().enumerate() {
        eprintln!("{} of {}: {}", i + 1, args.voyages.len(), voyage.display());
        model = Some(sail(voyage, model)?);
    }
    let Some(model) = model else { return Ok(()) };
    keep_the_one_before(file)?;
    output_file::replace(file, &model.text())
        .with_context(|| format!("{}: cannot be written", file.display()))?;
    crate::terminal::print(&words(&model))?;
    Ok(())
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

/// The generation before stays beside it, as FILE.1.
fn keep_the_one_before(file: &Path) -> anyhow::Result<()> {
    if !file.exists() {
        return Ok(());
    }
    let mut name = file.as_os_str().to_owned();
    name.push(".1");
    // copied, not moved: whoever is stopped here leaves the file in its place
    fs::copy(file, &name).with_context(|| format!("{}: cannot be copied", file.display()))?;
    Ok(())
}

/// Sails a voyage, and returns what is known after it.
fn sail(dir: &Path, before: Option<KeptModel>) -> anyhow::Result<KeptModel> {
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
        feel(&mut engine, temperature.as_mut(), received.receipt)?;
        engine.handle(&received);
        while engine.poll_output().is_some() {}
    }
    engine.learnt().context("nothing is learnt of this voyage")
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

/// A model in words.
fn words(model: &KeptModel) -> String {
    let mut text = String::new();
    let hours = f64::from(model.log.labels) / 120.0;
    let (voyages, generation) = (model.voyages, model.generation);
    let _ =
        writeln!(text, "learnt from {hours:.1} h of {voyages} voyages, generation {generation}");
    of_log(&mut text, &model.log);
    if let Some(gyros) = &model.gyros {
        of_gyros(&mut text, gyros);
    }
    text
}

fn of_log(text: &mut String, log: &KeptLog) {
    for knots in SPEEDS {
        let speed = knots / KNOTS;
        let off = 100.0 * (log.scale + log.scale_by_speed_s_m * speed);
        let which = if off < 0.0 { "low" } else { "high" };
        let _ = writeln!(text, "at {knots:.0} kn the log reads {:.1} % {which}", off.abs());
    }
    let _ = writeln!(text, "it is turned by {:.2} deg", log.turn_rad / DEG);
    let slide = log.slide_m * DEG;
    let _ =
        writeln!(text, "it reads {slide:.3} m/s to starboard for each deg/s of turn to starboard");
    let (std, time) = (log.current_std_mps, log.current_time_s / 3600.0);
    let _ = writeln!(text, "currents of {std:.2} m/s that go on for {time:.1} h");
    let shadow = ShadowScore::after(log);
    match shadow.quantiles() {
        Some([without, with]) => {
            let use_ = if shadow.proves(false) { "used" } else { "not used" };
            let _ = writeln!(
                text,
                "if GNSS failed: {:.0} m in 5 min, without learning {:.0} (95 %: {:.0} and {:.0}): {use_}",
                with[0], without[0], with[1], without[1]
            );
        }
        None => text.push_str("not proven yet: not used\n"),
    }
}

fn of_gyros(text: &mut String, gyros: &KeptGyros) {
    let [least, most] = gyros.range_c;
    let _ =
        writeln!(text, "gyros from {least:.0} to {most:.0} degrees Celsius, against {MIDDLE:.0}:");
    let [cold, warm] = [least, most].map(|celsius| gyros.against_middle(celsius) / DEG_PER_HOUR);
    for (i, axis) in ["forward", "starboard", "down"].iter().enumerate() {
        let (cold, warm) = (cold[i], warm[i]);
        let _ = writeln!(text, "  {axis}: {cold:+.1} deg/h cold, {warm:+.1} deg/h warm");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_model_is_told_in_words() {
        let log = KeptLog {
            labels: 4920,
            scale: 0.02,
            scale_by_speed_s_m: -0.001,
            slide_m: -5.0,
            current_std_mps: 0.1,
            current_time_s: 20_000.0,
            shadow_without_m: vec![25.0; 8],
            shadow_with_m: vec![12.0; 8],
            ..KeptLog::default()
        };
        let told = words(&KeptModel::new(log, None));
        assert!(told.contains("learnt from 41.0 h of 1 voyages"), "{told}");
        assert!(told.contains("at 12 kn the log reads 1.4 % high"), "{told}");
        assert!(told.contains("12 m in 5 min, without learning 25"), "{told}");
    }
}
