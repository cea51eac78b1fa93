//! A walk through a garden with a MEMS IMU and a receiver: fixes against ranges, with all satellites and with three, two and one.
//!
//! ```text
//! INSD_RAW_GNSS=... cargo run --release -p insd-tests --example walk -- target/release/insd docs/satellites.md
//! ```
//!
//! The folder holds *walk-imu*. Both ways have the same measurements: the fixes are single points and velocities that `insd` makes of each epoch by itself. The
//! reference is the receiver's own position with corrections of a base that was not surveyed, so that only displacements are judged. The voyage stays in
//! `target/walk`. Without a page the table is printed.

mod log;
mod voyage;

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::Command;

use insd_tests::pages;
use insd_tests::programs::run;

use log::Instants;

const HEAD: &str = "| | fixes, m | ranges, m |\n|---|---|---|\n";
/// Where satellites are taken away, seconds of the voyage: from where both know their heading until the walk ends.
const WINDOWS: [[f64; 2]; 4] = [[55.0, 75.0], [70.0, 90.0], [85.0, 105.0], [95.0, 115.0]];
/// The whole of the walk that is judged with all satellites.
const WALK: [f64; 2] = [55.0, 115.0];

fn main() -> Result<(), Box<dyn Error>> {
    let folder =
        std::env::var_os("INSD_RAW_GNSS").ok_or("INSD_RAW_GNSS: the folder of the sets")?;
    let folder = PathBuf::from(folder).join("walk-imu");
    let mut arguments = std::env::args().skip(1);
    let program = arguments.next().ok_or("which insd? target/release/insd")?;
    let dir = PathBuf::from("target/walk");
    voyage::make(&folder, &dir)?;
    let walk = Walk { program, dir, reference: log::reference(&folder)? };
    let table = HEAD.to_owned() + &walk.rows()?;
    Ok(pages::put(arguments.next(), "walk", &table)?)
}

struct Walk {
    program: String,
    dir: PathBuf,
    reference: Instants,
}

impl Walk {
    fn rows(&self) -> Result<String, Box<dyn Error>> {
        let mut table = String::new();
        let whole = self.both(&[], &[WALK], spread)?;
        table += &row("all satellites, scatter about the mean", whole);
        let windows = self.both(&[], &WINDOWS, since_start)?;
        table += &row("all satellites, since the begin of 20 s", windows);
        for left in [3, 2, 1, 0] {
            let mut told = [Vec::new(), Vec::new()];
            for window in WINDOWS {
                let mask = format!("{}..{}:{left}", window[0], window[1]);
                let one = self.both(&["--mask", &mask], &[window], since_start)?;
                told.iter_mut().zip(one).for_each(|(all, one)| all.extend(one));
            }
            table += &row(&format!("{left} left, since the begin of 20 s"), told);
        }
        Ok(table)
    }

    /// What is made of fixes and of ranges, judged in each window.
    fn both(
        &self,
        options: &[&str],
        windows: &[[f64; 2]],
        judge: fn(&[[f64; 2]]) -> f64,
    ) -> Result<[Vec<Option<f64>>; 2], Box<dyn Error>> {
        let mut both = [Vec::new(), Vec::new()];
        for (told, way) in both.iter_mut().zip(["loose", "tight"]) {
            let off = self.replay(&[&["--gnss", way], options].concat())?;
            let within = |[from, to]: &[f64; 2]| {
                let errors = off.iter().filter(|(time, _)| (*from..*to).contains(time));
                let errors: Vec<[f64; 2]> = errors.map(|(_, error)| *error).collect();
                let reached = self.reference.iter().filter(|(time, _)| (*from..*to).contains(time));
                (errors.len() == reached.count()).then(|| judge(&errors))
            };
            told.extend(windows.iter().map(within));
        }
        Ok(both)
    }

    /// Errors north and east, m, but for a constant, at the times of the reference.
    fn replay(&self, options: &[&str]) -> Result<Instants, Box<dyn Error>> {
        let out = self.dir.join("nav.csv");
        let mut command = Command::new(&self.program);
        command.arg("replay").arg(&self.dir).arg("--out").arg(&out).args(["--rate", "20"]);
        run(command.args(options))?;
        let track = track(&out)?;
        let at = |time: f64| track.iter().find(|(own, _)| (own - time).abs() < 1e-3);
        let Some((_, first)) = track.first() else { return Ok(Vec::new()) };
        let error = |(time, truth): &(f64, [f64; 2])| {
            let [north, east] = log::metres(*first, at(*time)?.1);
            Some((*time, [north - truth[0], east - truth[1]]))
        };
        Ok(self.reference.iter().filter_map(error).collect())
    }
}

/// Times and places, degrees, of a solution that knows its heading.
fn track(path: &Path) -> Result<Instants, Box<dyn Error>> {
    let mut reader = csv::Reader::from_path(path)?;
    let head = reader.headers()?.clone();
    let column = |name: &str| head.iter().position(|own| own == name).ok_or(name.to_owned());
    let [time, latitude, longitude, mode] =
        [column("t_s")?, column("lat_deg")?, column("lon_deg")?, column("mode")?];
    let mut track = Vec::new();
    for row in reader.records() {
        let row = row?;
        if !row[mode].ends_with("alignment") {
            track.push((row[time].parse()?, [row[latitude].parse()?, row[longitude].parse()?]));
        }
    }
    Ok(track)
}

/// RMS of errors about their mean, m.
fn spread(errors: &[[f64; 2]]) -> f64 {
    let count = errors.len() as f64;
    let mean = |axis: usize| errors.iter().map(|error| error[axis]).sum::<f64>() / count;
    root_mean_square(errors, [mean(0), mean(1)])
}

/// RMS of errors since the first one, m.
fn since_start(errors: &[[f64; 2]]) -> f64 {
    root_mean_square(errors, errors.first().copied().unwrap_or_default())
}

fn root_mean_square(errors: &[[f64; 2]], from: [f64; 2]) -> f64 {
    let squares =
        errors.iter().map(|[north, east]| (north - from[0]).powi(2) + (east - from[1]).powi(2));
    (squares.sum::<f64>() / errors.len() as f64).sqrt()
}

fn row(label: &str, both: [Vec<Option<f64>>; 2]) -> String {
    let cell = |values: Vec<Option<f64>>| {
        let text =
            |value: Option<f64>| value.map_or("none".to_owned(), |value| format!("{value:.2}"));
        values.into_iter().map(text).collect::<Vec<_>>().join(" ")
    };
    let [loose, tight] = both.map(cell);
    format!("| {label} | {loose} | {tight} |\n")
}
