//! What a conversion is asked for.

use std::path::PathBuf;

use crate::export::Format;

/// Options of `insd convert`.
#[derive(Clone, Debug, clap::Args)]
pub struct ConvertArgs {
    /// Raw recording: one of its files, or its folder; for --to also a voyage directory or a nav.csv
    pub recording: PathBuf,
    /// Voyage directory to make, with `raw/` if a receiver sent raw messages; with --to the file to write
    #[arg(long, value_name = "DIR|FILE", required_unless_present = "rinex")]
    pub out: Option<PathBuf>,
    /// Write the solution in the format of other programs, replaying what is no nav.csv
    #[arg(long, value_enum, requires = "out", conflicts_with = "rinex")]
    pub to: Option<Format>,
    /// With --to mcap or ros2bag: also each sample of the IMU, forward, left, up
    #[arg(long, requires = "to")]
    pub imu: bool,
    /// With --to: UTC of t_s = 0, where it is not that of the voyage or recording
    #[arg(long, value_name = "RFC 3339", requires = "to")]
    pub start_utc: Option<String>,
    /// Folder for RINEX 3.05: of each receiver that sent raw messages NAME.obs, what it measured, and NAME.nav, what the satellites broadcast
    #[arg(long, value_name = "DIR")]
    pub rinex: Option<PathBuf>,
    /// Another configuration than the one it was made with
    #[arg(long, value_name = "FILE")]
    pub config: Option<PathBuf>,
    /// Of a recording that spans restarts of the program: which run, from 1
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub run: u32,
}
