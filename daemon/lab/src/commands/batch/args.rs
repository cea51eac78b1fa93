//! What a batch is asked for.

use std::path::PathBuf;

use clap::ValueEnum as _;

use super::super::alignment::AlignmentArgs;
use super::super::{rate, seconds};
use crate::evaluation::AlertLimit;
use crate::parts::PartsArgs;
use crate::ranges::GnssUse;

/// Options of `insd batch`.
///
/// Folders are searched for voyage directories and for folders with raw recordings. What cannot be replayed is told in its line, and the
/// others go on. A recording that spans several runs of the program is replayed run by run.
#[derive(Clone, Debug, clap::Args)]
pub struct BatchArgs {
    /// Folders with recordings below them, voyage directories, raw recordings
    #[arg(value_name = "ARCHIVE", required_unless_present = "merge", conflicts_with = "merge")]
    pub(super) archives: Vec<PathBuf>,
    /// Solutions per second
    #[arg(long, value_name = "HZ", default_value_t = 1.0, value_parser = rate)]
    pub(super) rate: f64,
    /// For raw recordings: another configuration than those they were made with
    #[arg(long, value_name = "FILE")]
    pub(super) config: Option<PathBuf>,
    /// For voyages: what raw GNSS is made of [default: tight where raw GNSS is there]
    #[arg(long, value_enum)]
    pub(super) gnss: Option<GnssUse>,
    #[command(flatten)]
    pub(super) alignment: AlignmentArgs,
    /// Alert limit of the horizontal error, m, or its name as in `insd integrity`
    #[arg(long, value_name = "M|NAME", default_value = "harbour")]
    pub(super) alert_limit: AlertLimit,
    /// Where truth is known, leave out what is before this time, s
    #[arg(long, value_name = "T", value_parser = seconds)]
    pub(super) from: Option<f64>,
    /// Print JSON instead of a table
    #[arg(long)]
    pub(super) json: bool,
    #[command(flatten)]
    pub(super) parts: PartsArgs,
}

impl BatchArgs {
    /// The options of a replay, as they are written on its command line.
    pub(super) fn words(&self) -> Vec<String> {
        let mut words = vec!["--rate".to_owned(), self.rate.to_string()];
        let config = self.config.iter().map(|file| file.display().to_string());
        words.extend(config.flat_map(|file| ["--config".to_owned(), file]));
        let gnss = self.gnss.and_then(|gnss| gnss.to_possible_value());
        words.extend(gnss.iter().flat_map(|own| ["--gnss".to_owned(), own.get_name().to_owned()]));
        words.extend(self.alignment.words().split(' ').map(str::to_owned));
        words
    }
}
