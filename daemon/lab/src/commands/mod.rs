//! One command, one file.

pub mod alignment;
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
