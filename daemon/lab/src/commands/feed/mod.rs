//! `insd feed`: the sensors of a simulated ship in real time, each on a pseudo terminal of its own, in the
//! formats of real ones. The daemon reads them as it reads serial lines.

mod lines;
mod sensors;
mod voyage;

use std::path::PathBuf;
use std::thread::sleep;
use std::time::Duration;

use insd_base::{Span, Time, UtcTime};
use insd_drivers::ports::Clock;
use insd_simulator::Override;
use insd_simulator::feed::{Calendar, FeedConfig, feed, film};

use lines::Lines;
use sensors::Sensor;
use voyage::Found;

/// Time of the voyage that is put into bytes at once.
const WINDOW: Span = Span::from_nanos(10_000_000_000);
const SECOND: i64 = 1_000_000_000;

/// Options of `insd feed`.
#[derive(Clone, Debug, clap::Args)]
pub struct FeedArgs {
    /// Name or number of a shipped scenario, a scenario file, or a voyage directory
    #[arg(value_name = "VOYAGE", default_value = "02")]
    voyage: String,
    /// Where the links to the terminals are made
    #[arg(long, value_name = "DIR", default_value = "/tmp/insd-sensors")]
    folder: PathBuf,
    /// A sensor by the name of its link and the kind that a configuration calls it; may be repeated.
    /// Without: imu=sbg, gnss=ubx, log=nmea_log, camera=camera, as far as the voyage has them
    #[arg(long = "sensor", value_name = "NAME=KIND")]
    sensors: Vec<Sensor>,
    /// Seed of all random streams of a scenario
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Set a key of the scenario to another value, as sea.state=5; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE")]
    sets: Vec<Override>,
    /// Begin so many seconds into the voyage
    #[arg(long, value_name = "S", default_value_t = 0.0, value_parser = super::seconds)]
    from: f64,
    /// Stop after so many seconds
    #[arg(long, value_name = "S", value_parser = super::seconds)]
    seconds: Option<f64>,
}

/// Runs the command until the voyage ends.
///
/// # Errors
/// The voyage cannot be had, or the terminals cannot be made.
pub fn run(args: &FeedArgs, clock: &dyn Clock) -> anyhow::Result<()> {
    let is_filmed = sensors::may_see(&args.sensors);
    let found = voyage::find(&args.voyage, args.seed, &args.sets, is_filmed)?;
    let sensors = sensors::chosen(&args.sensors, &found);
    let mut lines = Lines::open(&args.folder, sensors.iter().map(|sensor| sensor.name.as_str()))?;
    for sensor in &sensors {
        let path = args.folder.join(&sensor.name);
        crate::terminal::print(&format!("{} {}\n", path.display(), sensor.word))?;
    }
    sail(args, clock, &found, &sensors, &mut lines);
    Ok(())
}

/// Sends everything when it is due. The voyage begins with a second of the system clock, and the sensors
/// tell that clock's UTC.
fn sail(args: &FeedArgs, clock: &dyn Clock, found: &Found, sensors: &[Sensor], lines: &mut Lines) {
    let started = clock.now();
    let second = (started.system.as_nanos() / SECOND + 1) * SECOND;
    let wait = Span::from_nanos(second - started.system.as_nanos());
    // the instants of the voyage and of the clock that belong together
    let first = Time::from_seconds(args.from.floor());
    let offset = started.monotonic + wait - first;
    let start = UtcTime::from_nanos(second).plus(Time::START - first);
    let encodings: Vec<_> = sensors.iter().map(|sensor| sensor.encoding).collect();
    let feeds = FeedConfig::starting(&Calendar::from(start), &encodings);
    let end = args
        .seconds
        .map_or(voyage::end(&found.voyage), |seconds| first + Span::from_seconds(seconds));
    let mut from = first;
    while from < end {
        let to = (from + WINDOW).min(end);
        let mut sendings = feed(&voyage::window(&found.voyage, from, to), &feeds);
        sendings.extend(film(voyage::images(&found.frames, from, to), &feeds));
        sendings.sort_by_key(|sending| sending.at);
        for sending in sendings {
            wait_for(clock, sending.at + offset);
            lines.send(&sending);
        }
        wait_for(clock, to + offset);
        from = to;
    }
}

fn wait_for(clock: &dyn Clock, due: Time) {
    let wait = (due - clock.now().monotonic).as_nanos();
    if let Ok(wait @ 1..) = u64::try_from(wait) {
        sleep(Duration::from_nanos(wait));
    }
}
