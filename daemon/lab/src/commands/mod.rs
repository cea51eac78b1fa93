//! One command, one file.

pub mod alignment;
pub mod batch;
mod camera;
pub mod campaign;
pub mod convert;
pub mod evaluate;
pub mod feed;
pub mod integrity;
pub mod learn;
pub mod limit;
mod outage;
mod raw_gnss;
pub mod replay;
pub mod report;
pub mod simulate;
pub mod smooth;
mod stored_start;
mod summary;

pub use outage::SensorOutage;

use std::path::PathBuf;

use insd_config::BadInput;

/// The options of a command out of words as they stand on its command line.
///
/// # Errors
/// What the command line would say.
pub fn options<A: clap::Args>(words: &[String]) -> Result<A, BadInput> {
    let command = clap::Command::new("insd").no_binary_name(true).disable_help_flag(true);
    let told = |fault: clap::Error| {
        let text = fault.to_string();
        let first = text.split("\n\n").next().unwrap_or_default();
        BadInput(first.trim_start_matches("error: ").trim().to_owned())
    };
    let matches = A::augment_args(command).try_get_matches_from(words).map_err(told)?;
    A::from_arg_matches(&matches).map_err(told)
}

/// The rate that a command line may ask for, Hz.
fn rate(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(rate) if (0.01..=1000.0).contains(&rate) => Ok(rate),
        _ => Err("expected a number from 0.01 to 1000 Hz".to_owned()),
    }
}

/// A time on the command line, s.
///
/// # Errors
/// It is none.
pub fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if seconds.abs() <= 1e9 => Ok(seconds),
        _ => Err("expected a number of seconds".to_owned()),
    }
}

/// A file to draw to.
fn picture(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let extension = path.extension().map(std::ffi::OsStr::to_ascii_lowercase);
    match extension.as_ref().and_then(|extension| extension.to_str()) {
        Some("png" | "svg") => Ok(path),
        _ => Err("expected a file ending in .png or .svg".to_owned()),
    }
}
