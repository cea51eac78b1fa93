//! `insd demo`: a simulated ship sails in real time through the very engine that the daemon runs.
//!
//! One thread makes the voyage, feeds its messages to the engine when they are due and writes NMEA
//! to a pseudo terminal; the main thread shows the [`board::Board`] that it publishes. Everything
//! but the pace is free of clocks: [`ship::DemoShip`] advances to whatever time it is told.

pub mod alongside;
pub mod board;
pub mod onlooker;
pub mod pace;
pub mod plain;
pub mod rejections;
pub mod scenario;
pub mod screen;
pub mod sensors;
pub mod ship;
pub mod trail;
pub mod truth;
pub mod view;

use std::io::IsTerminal;
use std::net::SocketAddr;
use std::sync::Arc;
use std::time::Duration;

use anyhow::Context;
use insd_config::Config;
use insd_drivers::ports::Clock;

use onlooker::Onlooker;
use pace::{DemoPace, Worker};
use scenario::DemoVoyage;

use crate::pty::PseudoTerminal;

/// Options of `insd demo`.
#[derive(Clone, Debug, clap::Args)]
pub struct DemoArgs {
    /// How many times faster than real time the ship sails
    #[arg(long, value_name = "N", default_value_t = 1.0, value_parser = speed)]
    pub speed: f64,

    /// A shipped scenario by number or name, or a scenario file
    #[arg(long, value_name = "NAME|NUMBER|FILE", default_value = "06")]
    pub scenario: String,

    /// Which voyage of the scenario: other seeds, other waves and sensor errors
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,

    /// One line of text a second in place of the full screen; so too when output is no terminal
    #[arg(long)]
    pub plain: bool,

    /// Serve the status page of the ship, too; with --scenario berthing its docking view
    #[arg(long, value_name = "ADDRESS", num_args = 0..=1, default_missing_value = "127.0.0.1:8470")]
    pub page: Option<SocketAddr>,

    /// End by itself after so many seconds on the wall clock
    #[arg(long, value_name = "S", value_parser = seconds)]
    pub duration: Option<Duration>,
}

/// Runs the demo until its voyage, its duration or the user's patience ends. `open` opens the page of a ship of such a configuration,
/// with its text.
///
/// # Errors
/// A scenario that cannot be found or read, no page, no pseudo terminal, or a terminal that fails.
pub fn run(
    args: DemoArgs,
    clock: Arc<dyn Clock>,
    open: impl FnOnce(&Config, &str) -> anyhow::Result<Box<dyn Onlooker>>,
) -> anyhow::Result<()> {
    let DemoArgs { speed, scenario, seed, plain, page, duration } = args;
    let choice = DemoVoyage::find(&scenario, seed)?;
    let (mut config, text) = choice.configuration()?;
    let onlooker = page.map(|address| {
        config.web.listen = address;
        open(&config, &text)
    });
    let onlooker = onlooker.transpose()?;
    let pty =
        PseudoTerminal::open().context("cannot open a pseudo terminal for the NMEA sentences")?;
    let plain = plain || !std::io::stdout().is_terminal();
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_all()
        .build()
        .context("cannot start the event loop")?;
    let worker = Worker::start((choice, config), pty, DemoPace { speed }, clock, onlooker);
    let shown = runtime.block_on(async {
        if plain {
            plain::show(&worker, duration).await
        } else {
            screen::show(&worker, duration).await
        }
    });
    worker.stop()?;
    shown
}

fn speed(text: &str) -> Result<f64, String> {
    let speed: f64 = text.parse().map_err(|_| "not a number".to_owned())?;
    let sensible = (0.01..=1000.0).contains(&speed);
    sensible.then_some(speed).ok_or_else(|| "must lie between 0.01 and 1000".to_owned())
}

fn seconds(text: &str) -> Result<Duration, String> {
    let seconds: f64 = text.parse().map_err(|_| "not a number".to_owned())?;
    let length = Duration::try_from_secs_f64(seconds).ok();
    length.ok_or_else(|| "must be a number of seconds, zero or more".to_owned())
}
